"""Runs a node of the library `canopen` with an EDS and adds deviations to the node: python deviations.py TTY EDS NODE-ID.

The CAN bus is a serial line with python-can's `slcan` interface.
"""

import logging
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "tests" / "interop"))

import canopen
from canopen.objectdictionary import ODVariable, datatypes
from canopen.sdo import SdoAbortedError

from talk import serve

logging.disable(logging.WARNING)

WRITE_ONLY = 0x06010001
DEVICE_STATE = 0x08000022
GENERAL = 0x08000000

# Delay of a slow reply in seconds. It is longer than the timeout of the test.
SLOW = 0.8


class Node:
    def __init__(self, tty, eds, node_id):
        self.network = canopen.Network()
        self.network.connect(interface="slcan", channel=tty, bitrate=500_000, sleep_after_open=0)
        self.node = self.network.create_node(node_id, eds)
        self.dictionary = self.node.object_dictionary
        self.aborts = {}
        self.slow = set()
        self.node.add_read_callback(self.read)
        self.fill()

    def read(self, index, subindex, **_):
        if (index, subindex) in self.aborts:
            raise SdoAbortedError(self.aborts[index, subindex])
        if (index, subindex) in self.slow:
            time.sleep(SLOW)

    def variables(self):
        for entry in self.dictionary.values():
            yield from [entry] if isinstance(entry, ODVariable) else entry.values()

    def fill(self):
        """Sets the variables without a value and a default value: to zeros, or to an empty text or domain."""
        for variable in self.variables():
            if variable.default is None and variable.value is None:
                text = variable.data_type in (datatypes.VISIBLE_STRING, datatypes.DOMAIN)
                length = 0 if text else len(variable) // 8
                self.bytes(variable.index, bytes(length), variable.subindex)

    def bytes(self, index, data, subindex=0):
        self.node.data_store.setdefault(index, {})[subindex] = data

    def number(self, index, value, length, subindex=0):
        self.bytes(index, value.to_bytes(length, "little", signed=value < 0), subindex)

    def add(self, index, subindex=0):
        """Adds an object or a sub-index that the EDS does not describe."""
        variable = ODVariable(f"Added {index:X}", index, subindex)
        variable.data_type = datatypes.UNSIGNED32
        variable.access_type = "rw"
        variable.default = 0
        if subindex == 0:
            self.dictionary.add_object(variable)
        else:
            self.dictionary[index].add_member(variable)

    def deviate(self):
        """Puts the deviations into the node. Returns kind and address of each."""
        deviations = []

        def missing(index, subindex=None):
            if subindex is None:
                del self.dictionary[index]
            else:
                del self.dictionary[index][subindex]
            deviations.append(("missing", f"0x{index:04X}:{subindex or 0:02X}"))

        def extra(index, subindex=0):
            self.add(index, subindex)
            deviations.append(("extra", f"0x{index:04X}:{subindex:02X}"))

        def different(index, value, length, subindex=0):
            self.number(index, value, length, subindex)
            deviations.append(("different", f"0x{index:04X}:{subindex:02X}"))

        def refused(kind, index, code, subindex=0):
            self.aborts[index, subindex] = code
            deviations.append((kind, f"0x{index:04X}:{subindex:02X}"))

        # Objects and sub-indices that do not exist.
        missing(0x6081)
        missing(0x1401, 2)
        missing(0x2010)
        # Objects and sub-indices that the EDS does not describe.
        extra(0x1012)
        extra(0x1402)
        extra(0x1400, 3)
        self.number(0x1400, 3, 1)
        # Device type and identity.
        different(0x1000, 0x00030191, 4)
        different(0x1018, 0x539, 4, 1)
        different(0x1018, 0x4022, 4, 2)
        different(0x1018, 0x20000, 4, 3)
        # Lengths.
        different(0x6083, 10, 2)
        different(0x1001, 0, 2)
        # Access rights.
        refused("different", 0x6064, WRITE_ONLY)
        self.dictionary[0x2002].access_type = "rw"
        self.bytes(0x2002, b"firmware")
        deviations.append(("different", "0x2002:00"))
        # Reads that fail.
        refused("unreadable", 0x2000, DEVICE_STATE)
        refused("unreadable", 0x2020, GENERAL)
        self.slow.add((0x6061, 0))
        deviations.append(("unreadable", "0x6061:00"))
        # Mappings with a wrong length, too few entries, or a wrong object.
        self.number(0x1A01, 0x60640010, 4, 2)
        deviations.append(("different", "0x1A01:00"))
        self.number(0x1601, 1, 1)
        deviations.append(("different", "0x1601:00"))
        self.number(0x1A00, 0x20200018, 4, 1)
        deviations.append(("different", "0x1A00:00"))
        # Wrong values: outside the limits, not the constant of the EDS, not a valid text, a wrong number of entries.
        different(0x607A, 2_000_000, 4)
        self.bytes(0x1008, b"Other Drive")
        deviations.append(("different", "0x1008:00"))
        self.bytes(0x100A, b"\xff\xfe")
        deviations.append(("different", "0x100A:00"))
        different(0x1801, 1, 1)
        return deviations


def main():
    node = Node(sys.argv[1], sys.argv[2], int(sys.argv[3]))
    serve({"deviate": node.deviate})
    node.network.disconnect()


main()
