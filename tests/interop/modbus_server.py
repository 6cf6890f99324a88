"""Runs a server of `pymodbus`: python modbus_server.py tcp, or python modbus_server.py rtu TTY.

The handwritten table PLACES describes the registers again. The tests compare it with the bindings that are generated from
`registers.toml`. `pymodbus` converts numbers to registers for the commands of the test (talk.py).
"""

import asyncio
import logging
import sys
import threading

from pymodbus.client.mixin import ModbusClientMixin
from pymodbus.server import ModbusSerialServer, ModbusTcpServer
from pymodbus.simulator import DataType, SimData, SimDevice

from talk import serve

logging.disable(logging.WARNING)

TIMEOUT = 30
DEVICE = 1

TYPES = ModbusClientMixin.DATATYPE

# Function codes for reading and writing each table.
HOLDING = (3, 16)
INPUT = (4, 4)
COIL = (1, 15)
DISCRETE = (2, 2)

# Registers by name: table, wire address, type, number of registers or bits, word order, and whether the bytes are swapped.
PLACES = {
    "high_u16": (HOLDING, 0, TYPES.UINT16, 1, "big", False),
    "high_i16": (HOLDING, 1, TYPES.INT16, 1, "big", False),
    "high_u32": (HOLDING, 2, TYPES.UINT32, 2, "big", False),
    "high_i32": (HOLDING, 4, TYPES.INT32, 2, "big", False),
    "high_f32": (HOLDING, 6, TYPES.FLOAT32, 2, "big", False),
    "high_u64": (HOLDING, 8, TYPES.UINT64, 4, "big", False),
    "high_i64": (HOLDING, 12, TYPES.INT64, 4, "big", False),
    "high_f64": (HOLDING, 16, TYPES.FLOAT64, 4, "big", False),
    "high_text": (HOLDING, 20, TYPES.STRING, 10, "big", False),
    "low_u16": (HOLDING, 100, TYPES.UINT16, 1, "little", False),
    "low_i16": (HOLDING, 101, TYPES.INT16, 1, "little", False),
    "low_u32": (HOLDING, 102, TYPES.UINT32, 2, "little", False),
    "low_i32": (HOLDING, 104, TYPES.INT32, 2, "little", False),
    "low_f32": (HOLDING, 106, TYPES.FLOAT32, 2, "little", False),
    "low_u64": (HOLDING, 108, TYPES.UINT64, 4, "little", False),
    "low_i64": (HOLDING, 112, TYPES.INT64, 4, "little", False),
    "low_f64": (HOLDING, 116, TYPES.FLOAT64, 4, "little", False),
    # The word order applies only to numbers. A text always starts in its first register.
    "low_text": (HOLDING, 120, TYPES.STRING, 10, "big", False),
    "swapped_u16": (HOLDING, 200, TYPES.UINT16, 1, "big", True),
    "swapped_u32": (HOLDING, 202, TYPES.UINT32, 2, "big", True),
    "swapped_low_i32": (HOLDING, 204, TYPES.INT32, 2, "little", True),
    "swapped_low_f64": (HOLDING, 216, TYPES.FLOAT64, 4, "little", True),
    "swapped_text": (HOLDING, 220, TYPES.STRING, 10, "big", True),
    "word_300": (HOLDING, 300, TYPES.UINT16, 1, "big", False),
    "word_301": (HOLDING, 301, TYPES.UINT16, 1, "big", False),
    "mode": (HOLDING, 302, TYPES.UINT16, 1, "big", False),
    "status": (HOLDING, 303, TYPES.UINT16, 1, "big", False),
    "temperature": (HOLDING, 304, TYPES.INT16, 1, "big", False),
    # The accessor for `words_305` writes only the first three words. The test checks that the last word is unchanged.
    "words_305": (HOLDING, 305, TYPES.UINT64, 4, "big", False),
    "input_i16": (INPUT, 0, TYPES.INT16, 1, "big", False),
    "input_u32": (INPUT, 1, TYPES.UINT32, 2, "big", False),
    "input_low_f32": (INPUT, 3, TYPES.FLOAT32, 2, "little", False),
    "input_text": (INPUT, 10, TYPES.STRING, 10, "big", False),
    "coils": (COIL, 0, None, 40, None, False),
    "discretes": (DISCRETE, 0, None, 40, None, False),
}

# Addresses of the registers that exist. Register 349 is read-only, and register 398 is the last one before a gap.
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


def swapped(registers, swap):
    return [(word << 8 | word >> 8) & 0xFFFF for word in registers] if swap else registers


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
