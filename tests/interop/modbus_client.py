"""Runs a client of `pymodbus`: python modbus_client.py PORT tcp, or python modbus_client.py PORT rtu.

The client connects to a simulated device on 127.0.0.1. With `rtu`, it sends RTU frames over TCP. `pymodbus` converts numbers to
registers for the commands of the test (talk.py).
"""

import logging
import sys

from pymodbus import FramerType
from pymodbus.client import ModbusTcpClient

from modbus_places import COIL, DISCRETE, HOLDING, INPUT, PLACES, swapped
from talk import serve

logging.disable(logging.ERROR)

TIMEOUT = 20
DEVICE = 1


class Client:
    """The client, with methods for the commands that the test sends."""

    def __init__(self, port, framing):
        framer = FramerType.RTU if framing == "rtu" else FramerType.SOCKET
        self.client = ModbusTcpClient("127.0.0.1", port=int(port), framer=framer, timeout=TIMEOUT, retries=0)
        if not self.client.connect():
            raise ConnectionError("no connection")

    def get(self, name):
        """Returns the value with a given name. For coils and discrete inputs, returns a list of bits."""
        table, address, data_type, count, order, swap = PLACES[name]
        method = {
            HOLDING: "read_holding_registers",
            INPUT: "read_input_registers",
            COIL: "read_coils",
            DISCRETE: "read_discrete_inputs",
        }[table]
        reply = self.request(method, address=address, count=count)
        if "exception" in reply or data_type is None:
            return reply
        words = swapped(reply["registers"], swap)
        return self.client.convert_from_registers(words, data_type, word_order=order)

    def set(self, name, value):
        """Writes a register with function 6, and several registers with function 16."""
        _, address, data_type, count, order, swap = PLACES[name]
        words = swapped(self.client.convert_to_registers(value, data_type, word_order=order), swap)
        words += [0] * (count - len(words))
        if count == 1:
            return self.request("write_register", address=address, value=words[0])
        return self.request("write_registers", address=address, values=words)

    def request(self, method, **arguments):
        reply = getattr(self.client, method)(**arguments, device_id=DEVICE)
        if reply.isError():
            return {"exception": reply.exception_code}
        if arguments.get("count") and reply.bits:
            return {"bits": reply.bits[: arguments["count"]]}
        return {"registers": reply.registers}


def main():
    client = Client(*sys.argv[1:])
    serve({name: getattr(client, name) for name in ["get", "set", "request"]})


main()
