"""Runs a client of the library `canopen`: python canopen_client.py TTY NODE-ID.

The CAN bus is a serial line with python-can's `slcan` interface. The test simulates the node at the other end.
"""

import logging
import sys

import canopen
from canopen import lss
from canopen.objectdictionary import ObjectDictionary
from canopen.sdo import SdoAbortedError

from talk import serve

logging.disable(logging.WARNING)

TIMEOUT = 10


class Client:
    """The client, with methods for the commands that the test sends."""

    def __init__(self, tty, node_id):
        self.network = canopen.Network()
        self.network.connect(interface="slcan", channel=tty, bitrate=500_000, sleep_after_open=0)
        self.sdo = self.network.add_node(canopen.RemoteNode(node_id, ObjectDictionary())).sdo
        self.sdo.RESPONSE_TIMEOUT = TIMEOUT

    def upload(self, index, sub, block, crc=True):
        """Reads an object and returns its bytes."""
        with self.sdo.open(index, sub, "rb", block_transfer=block, request_crc_support=crc) as stream:
            return stream.read().hex()

    def download(self, index, sub, data, block, crc=True):
        """Writes an object. Returns the abort code if the node refuses the value."""
        data = bytes.fromhex(data)
        try:
            with self.sdo.open(
                index, sub, "wb", size=len(data), block_transfer=block, request_crc_support=crc
            ) as stream:
                stream.write(data)
        except SdoAbortedError as error:
            return error.code
        return None

    def fast_scan(self):
        """Finds a node without node-ID and returns its LSS address, or null. The node is in Configuration after that."""
        # The library waits for the response timeout at each bit of the LSS address that is 1.
        self.network.lss.RESPONSE_TIMEOUT = 0.4
        is_found, address = self.network.lss.fast_scan()
        self.network.lss.RESPONSE_TIMEOUT = TIMEOUT
        return address if is_found else None

    def select(self, address):
        """Switches the node with this LSS address to Configuration."""
        return self.network.lss.send_switch_state_selective(*address)

    def inquire(self):
        """Returns the LSS address and the node-ID of the node in Configuration."""
        commands = range(lss.CS_INQUIRE_VENDOR_ID, lss.CS_INQUIRE_VENDOR_ID + 4)
        return [self.network.lss.inquire_lss_address(command) for command in commands] + [self.network.lss.inquire_node_id()]

    def configure(self, node_id, bit_timing):
        """Sets and stores the node-ID and the bit timing of the node in Configuration. Returns the error if it refuses."""
        try:
            self.network.lss.configure_node_id(node_id)
            self.network.lss.configure_bit_timing(bit_timing)
            self.network.lss.store_configuration()
        except lss.LssError as error:
            return str(error)
        return None

    def wait(self):
        """Switches all nodes to Waiting."""
        self.network.lss.send_switch_state_global(self.network.lss.WAITING_STATE)


def main():
    tty, node_id = sys.argv[1:]
    client = Client(tty, int(node_id))
    names = ["upload", "download", "fast_scan", "select", "inquire", "configure", "wait"]
    serve({name: getattr(client, name) for name in names})
    client.network.disconnect()


main()
