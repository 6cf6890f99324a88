"""Reads data types, numbers, lists and values of GSDML.

Text that a function cannot interpret is kept after a question mark.
"""

import re

from reading import real, text

# Data types of fixed length: the kind of value and the length in bytes.
BASIC = {
    **{f"Unsigned{bits}": (f"u{bits}", bits // 8) for bits in (8, 16, 32, 64)},
    **{f"Integer{bits}": (f"i{bits}", bits // 8) for bits in (8, 16, 32, 64)},
    **{name: ("i16", 2) for name in ("N2", "E2", "X2")},
    **{name: ("i32", 4) for name in ("N4", "C4", "X4")},
    **{name: ("u16", 2) for name in ("V2", "L2", "T2", "D2", "R2", "Unipolar2.16")},
    "T4": ("u32", 4),
    "Float32": ("f32", 4),
    "Float64": ("f64", 8),
    "Boolean": ("bool", 1),
    "Date": ("Date", 7),
    "TimeOfDay with date indication": ("time of day", 6),
    "TimeDifference with date indication": ("time difference", 6),
    "TimeOfDay without date indication": ("TimeOfDay without date indication", 4),
    "TimeDifference without date indication": ("TimeDifference without date indication", 4),
    "NetworkTime": ("NetworkTime", 8),
    "NetworkTimeDifference": ("NetworkTimeDifference", 8),
    "TimeStamp": ("TimeStamp", 12),
    "TimeStampDifference": ("TimeStampDifference", 12),
    "TimeStampDifferenceShort": ("TimeStampDifferenceShort", 8),
    "F_MessageTrailer4Byte": ("octets(4)", 4),
    "F_MessageTrailer5Byte": ("octets(5)", 5),
}
PAIRS = {
    "Float32+Unsigned8": 5, "Float32+Status8": 5, "Unsigned8+Unsigned8": 2, "OctetString2+Unsigned8": 3,
    "Unsigned16_S": 3, "Integer16_S": 3, "Unsigned8_S": 2,
}
STRINGS = {
    "VisibleString": "str", "OctetString": "octets", "UnicodeString8": "octets", "61131_STRING": "octets",
    "61131_WSTRING": "octets", "OctetString_S": "octets",
}


def number(text):
    """Parses a decimal number and returns it without leading zeros."""
    return str(int(text)) if re.fullmatch(r"[+-]?\d+", text) else text and "?" + text


def ident(text):
    """Returns a hexadecimal ident number as a decimal number."""
    return str(int(text, 16)) if re.fullmatch(r"0[xX][0-9A-Fa-f]+", text) else text and "?" + text


def flag(text, default=False):
    return {"": "yes" if default else "", "0": "", "false": "", "1": "yes", "true": "yes"}.get(text, "?" + text)


def numbers(text):
    """Parses a list of numbers and ranges, such as `1..3 7`."""
    return " ".join("..".join(number(end) for end in part.split("..")) for part in text.split())


def of_element(element):
    """Returns the data type of an element and its length in bits."""
    name, length = text(element, "@DataType"), number(text(element, "@Length"))
    length = int(length) if length.isdigit() else 0
    if name == "Bit":
        return ("u1" if text(element, "@ValueItemTarget") else "bool"), 1
    if name == "BitArea":
        bits = number(text(element, "@BitLength")) or "1"
        return f"u{bits}", int(bits)
    if name in PAIRS:
        return "record", 8 * PAIRS[name]
    if name in STRINGS:
        return f"{STRINGS[name]}({length})", 8 * length
    ty, length = BASIC.get(name, ("?" + name, length))
    return ty, 8 * length


def default(raw, ty):
    """Parses the default of a parameter of type `ty`."""
    if ty.startswith("str"):
        return f"'{raw}'"
    if ty.startswith("octets"):
        parts = [part.strip() for part in raw.split(",")]
        if all(re.fullmatch(r"0[xX][0-9A-Fa-f]{1,2}", part) for part in parts):
            return f"x'{bytes(int(part, 16) for part in parts).hex()}'"
        return "?" + raw
    raw = raw.strip()
    if ty in ("f32", "f64"):
        try:
            return real(float(raw))
        except ValueError:
            return "?" + raw
    if ty == "bool":
        return {"false": "0", "true": "1"}.get(raw, number(raw))
    return number(raw) if re.fullmatch(r"[iu]\d+", ty) else "?" + raw


def allowed(raw, ty):
    """Parses the allowed values of a parameter of type `ty`. Returns a list of ranges."""
    if not re.fullmatch(r"[iuf]\d+|bool", ty):
        return ""
    read = (lambda end: real(float(end))) if ty[0] == "f" else number
    parts = []
    for part in raw.split():
        ends = part.split("..")
        parts.append(f"{read(ends[0])}..{read(ends[-1])}")
    return " ".join(parts)
