"""Runs a client of the library `canopen`: python canopen_client.py TTY NODE-ID.

The CAN bus is a serial line with python-can's `slcan` interface. The test simulates the node at the other end.
"""

import logging
import sys

import canopen
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


def main():
    tty, node_id = sys.argv[1:]
    client = Client(tty, int(node_id))
    serve({"upload": client.upload, "download": client.download})
    client.network.disconnect()


main()
