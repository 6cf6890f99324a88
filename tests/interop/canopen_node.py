"""Runs a node of the library `canopen` with an EDS: python canopen_node.py TTY EDS NODE-ID.

The CAN bus is a serial line with python-can's `slcan` interface. The library's own encoders and decoders convert the values of the
test's commands (talk.py).
"""

import logging
import queue
import sys
from datetime import datetime, timedelta

import canopen
from canopen import timestamp
from canopen.objectdictionary import NUMBER_TYPES, ODVariable, datatypes
from canopen.profiles.p402 import State402
from canopen.sdo import SdoAbortedError

from talk import serve

logging.disable(logging.WARNING)

TIMEOUT = 10
EPOCH = datetime(1970, 1, 1) + timedelta(seconds=timestamp.OFFSET)

NO_OBJECT = 0x06020000
NOT_MAPPABLE = 0x06040041
PDO_LENGTH = 0x06040042
TOO_HIGH = 0x06090031
TOO_LOW = 0x06090032
DEVICE_STATE = 0x08000022

INVALID = 1 << 31

SYNC = 0x80

CONTROLWORD = 0x6040
STATUSWORD = 0x6041


def to_json(variable, value):
    """Converts a value of the library to JSON. Decodes times and byte strings, because the library does not."""
    if variable.data_type == datatypes.TIME_OF_DAY:
        milliseconds, days = timestamp.TIME_OF_DAY_STRUCT.unpack(value)
        return (EPOCH + timedelta(days=days, milliseconds=milliseconds)).isoformat(timespec="milliseconds")
    if variable.data_type == datatypes.TIME_DIFFERENCE:
        milliseconds, days = timestamp.TIME_OF_DAY_STRUCT.unpack(value)
        return timedelta(days=days, milliseconds=milliseconds) // timedelta(milliseconds=1)
    return value.hex() if isinstance(value, (bytes, bytearray)) else value


def from_json(variable, value):
    """Converts a JSON value to a value of the library."""
    if variable.data_type == datatypes.TIME_OF_DAY:
        value = datetime.fromisoformat(value) - EPOCH
    elif variable.data_type == datatypes.TIME_DIFFERENCE:
        value = timedelta(milliseconds=value)
    elif variable.data_type in (datatypes.OCTET_STRING, datatypes.DOMAIN):
        return bytes.fromhex(value)
    if isinstance(value, timedelta):
        rest = value - timedelta(days=value.days)
        return timestamp.TIME_OF_DAY_STRUCT.pack(rest // timedelta(milliseconds=1), value.days)
    return value


class Node:
    """The node, with methods for the commands that the test sends."""

    def __init__(self, tty, eds, node_id):
        self.network = canopen.Network()
        self.network.connect(interface="slcan", channel=tty, bitrate=500_000, sleep_after_open=0)
        self.node = self.network.create_node(node_id, eds)
        self.node.add_write_callback(self.check_limits)
        self.node.add_write_callback(self.check_pdo)
        self.node.add_write_callback(self.control)
        self.received = {}
        self.network.subscribe(SYNC, self.on_sync)
        self.node.nmt.state = "INITIALISING"
        self.node.nmt.state = "PRE-OPERATIONAL"

    # The following methods refuse writes according to CiA 301, because the library does not check writes itself.

    def check_limits(self, od, data, **_):
        """Checks the limits of integers. The library reads the limits of 8, 16, 32 and 64-bit integers from the EDS."""
        if od.data_type not in NUMBER_TYPES:
            return
        value = od.decode_raw(data)
        if od.max is not None and value > od.max:
            raise SdoAbortedError(TOO_HIGH)
        if od.min is not None and value < od.min:
            raise SdoAbortedError(TOO_LOW)

    def check_pdo(self, index, subindex, od, data, **_):
        """Checks the order of PDO configuration (CiA 301 7.5.2.36): disable, clear, map, count, enable.

        Communication parameters are set while the PDO is disabled."""
        is_communication = 0x1400 <= index < 0x1600 or 0x1800 <= index < 0x1A00
        is_mapping = 0x1600 <= index < 0x1800 or 0x1A00 <= index < 0x1C00
        if is_communication and subindex == 2 and not self.number(index, 1) & INVALID:
            raise SdoAbortedError(DEVICE_STATE)
        if is_communication and subindex == 1:
            old, new = self.number(index, 1), od.decode_raw(data)
            if not (old | new) & INVALID and old != new:
                raise SdoAbortedError(DEVICE_STATE)
        elif is_mapping:
            if not self.number(index - 0x200, 1) & INVALID:
                raise SdoAbortedError(DEVICE_STATE)
            if subindex == 0:
                self.check_mapping(index, od.decode_raw(data))
            elif self.number(index, 0) != 0:
                raise SdoAbortedError(DEVICE_STATE)

    def check_mapping(self, index, count):
        length = 0
        for number in range(1, count + 1):
            entry = self.number(index, number)
            variable = self.variable(entry >> 16, entry >> 8 & 0xFF)
            goes = variable.writable if index < 0x1800 else variable.readable
            if not variable.pdo_mappable or not goes:
                raise SdoAbortedError(NOT_MAPPABLE)
            length += entry & 0xFF
        if length > 64:
            raise SdoAbortedError(PDO_LENGTH)

    def control(self, index, od, data, **_):
        """Executes the state machine of a drive, using the library's tables."""
        if index != CONTROLWORD:
            return
        command = od.decode_raw(data) & 0x8F
        states = self.states(self.number(STATUSWORD, 0))
        for (before, after), code in State402.TRANSITIONTABLE.items():
            if before in states and code == command:
                self.drive(after)
                return

    @staticmethod
    def states(statusword):
        return {name for name, (mask, value) in State402.SW_MASK.items() if statusword & mask == value}

    def variable(self, index, subindex):
        try:
            entry = self.node.object_dictionary[index]
            return entry if isinstance(entry, ODVariable) else entry[subindex]
        except KeyError:
            raise SdoAbortedError(NO_OBJECT) from None

    def number(self, index, subindex):
        """Returns the value of an object as a number."""
        return self.variable(index, subindex).decode_raw(self.node.get_data(index, subindex))

    # The following methods are the commands that the test can send.

    def get(self, index, sub=0):
        """Returns the value of an object."""
        variable = self.variable(index, sub)
        return to_json(variable, variable.decode_raw(self.node.get_data(index, sub)))

    def set(self, index, value, sub=0):
        """Sets the value of an object, regardless of its access rights."""
        variable = self.variable(index, sub)
        self.node.set_data(index, sub, variable.encode_raw(from_json(variable, value)))

    def drive(self, state):
        """Sets the state of the drive. All other bits of the statusword become 1."""
        mask, value = State402.SW_MASK[state]
        self.set(STATUSWORD, 0xFFFF & ~mask | value)

    def limits(self, index, sub=0):
        variable = self.variable(index, sub)
        return [variable.min, variable.max]

    def pdo(self, direction, number):
        """Applies the PDO configuration in the node's objects and returns the parameters of the PDO."""
        pdo = {"rx": self.node.rpdo, "tx": self.node.tpdo}[direction][number]
        pdo.read()
        if direction == "rx" and number not in self.received:
            self.received[number] = queue.Queue()
            pdo.add_callback(lambda pdo: self.received[number].put([to_json(entry.od, entry.raw) for entry in pdo]))
        return {
            "cob_id": pdo.cob_id,
            "enabled": pdo.enabled,
            "type": pdo.trans_type,
            "bits": pdo.length,
            "entries": [[entry.index, entry.subindex, entry.length] for entry in pdo],
        }

    def timing(self, number):
        """Returns the communication parameters of a TPDO, as the library reads them from the node's objects."""
        pdo = self.node.tpdo[number]
        pdo.read()
        return [pdo.enabled, pdo.rtr_allowed, pdo.trans_type]

    def receive(self, number):
        """Returns the values of the next RPDO. Waits for it if none is pending."""
        return self.received[number].get(timeout=TIMEOUT)

    def load(self, number, values):
        """Sets the values of a TPDO."""
        for entry, value in zip(self.node.tpdo[number], values, strict=True):
            entry.raw = from_json(entry.od, value)

    def transmit(self, number):
        """Sends a TPDO."""
        self.node.tpdo[number].transmit()

    def on_sync(self, *_):
        """Sends the TPDOs that are triggered by every SYNC."""
        for pdo in self.node.tpdo.values():
            if pdo.enabled and pdo.trans_type == 1:
                pdo.transmit()

    def state(self):
        return self.node.nmt.state

    def emergency(self, code, register, data):
        self.node.emcy.send(code, register, bytes.fromhex(data))


def main():
    tty, eds, node_id = sys.argv[1:]
    node = Node(tty, eds, int(node_id))
    commands = ["get", "set", "limits", "pdo", "timing", "receive", "load", "transmit", "state", "emergency", "drive"]
    serve({name: getattr(node, name) for name in commands})
    node.network.disconnect()


main()
