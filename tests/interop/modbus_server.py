"""Runs a server of `pymodbus`: python modbus_server.py tcp, or python modbus_server.py rtu TTY.

`modbus_places.py` describes the registers. `pymodbus` converts numbers to registers for the commands of the test (talk.py).
"""

import asyncio
import logging
import sys
import threading

from pymodbus.client.mixin import ModbusClientMixin
from pymodbus.server import ModbusSerialServer, ModbusTcpServer
from pymodbus.simulator import DataType, SimData, SimDevice

from modbus_places import PLACES, swapped
from talk import serve

logging.disable(logging.WARNING)

TIMEOUT = 30
DEVICE = 1

# Coils, discrete inputs, holding registers and input registers that exist. Holding register 349 is read-only, and
# holding register 398 is the last one.
MEMORY = (
    [SimData(0, values=[False] * 64, datatype=DataType.BITS)],
    [SimData(0, values=[False] * 64, datatype=DataType.BITS)],
    [
        SimData(0, count=349, datatype=DataType.REGISTERS),
        SimData(349, datatype=DataType.REGISTERS, readonly=True),
        SimData(350, count=49, datatype=DataType.REGISTERS),
    ],
    [SimData(0, count=40, datatype=DataType.REGISTERS)],
)


class Server:
    """The server, which runs in a separate thread, with methods for the commands that the test sends."""

    def __init__(self, bus, *tty):
        self.requests = []
        self.loop = asyncio.new_event_loop()
        threading.Thread(target=self.loop.run_forever, daemon=True).start()
        self.server = self.wait(self.start(bus, *tty))

    def wait(self, work):
        return asyncio.run_coroutine_threadsafe(work, self.loop).result(TIMEOUT)

    async def start(self, bus, *tty):
        device = SimDevice(DEVICE, simdata=MEMORY)
        if bus == "tcp":
            server = ModbusTcpServer(device, address=("127.0.0.1", 0), trace_pdu=self.trace, broadcast_enable=True)
        else:
            server = ModbusSerialServer(
                device, port=tty[0], baudrate=115_200, trace_pdu=self.trace, broadcast_enable=True
            )
        await server.serve_forever(background=True)
        return server

    def port(self):
        sockets = getattr(self.server.transport, "sockets", None)
        return sockets[0].getsockname()[1] if sockets else None

    def trace(self, is_sent, pdu):
        if not is_sent:
            self.requests.append(pdu.function_code)
        return pdu

    # The following methods are the commands that the test can send.

    def get(self, name):
        """Returns the value with a given name. For coils and discrete inputs, returns the numbers of the bits that are set."""
        (reading, _), address, data_type, count, order, swap = PLACES[name]
        held = self.wait(self.server.async_getValues(DEVICE, reading, address, count))
        if data_type is None:
            return [number for number, is_set in enumerate(held) if is_set]
        words = swapped(held, swap)
        return ModbusClientMixin.convert_from_registers(words, data_type, word_order=order)

    def set(self, name, value):
        (_, setting), address, data_type, count, order, swap = PLACES[name]
        if data_type is None:
            held = [number in value for number in range(count)]
        else:
            words = ModbusClientMixin.convert_to_registers(value, data_type, word_order=order)
            held = swapped(words + [0] * (count - len(words)), swap)
        self.wait(self.server.async_setValues(DEVICE, setting, address, held))

    def functions(self):
        """Returns the function codes of the requests since the last call."""
        requests, self.requests = self.requests, []
        return requests


def main():
    server = Server(*sys.argv[1:])
    commands = ["get", "set", "functions"]
    serve({name: getattr(server, name) for name in commands}, ready=server.port())


main()
