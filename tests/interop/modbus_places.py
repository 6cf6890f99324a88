"""The registers of the tests. This handwritten table describes the registers again. The tests compare it with the bindings that are
generated from `registers.toml`."""

from pymodbus.client.mixin import ModbusClientMixin

TYPES = ModbusClientMixin.DATATYPE

# Function codes with which the server selects each table: for getting values, and for setting values.
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


def swapped(registers, swap):
    return [(word << 8 | word >> 8) & 0xFFFF for word in registers] if swap else registers
