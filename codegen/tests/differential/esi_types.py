"""Reads numbers, names, data types and values of ETG.2000.

Text that a function cannot interpret is kept after a question mark.
"""

import re
import struct

from reading import real, text, xpath

BASIC = {
    "BOOL": "bool", "BIT": "bool", "SINT": "i8", "INT": "i16", "DINT": "i32", "LINT": "i64",
    "USINT": "u8", "BYTE": "u8", "UINT": "u16", "WORD": "u16", "UDINT": "u32", "DWORD": "u32", "ULINT": "u64",
    "INT24": "i24", "INT40": "i40", "INT48": "i48", "INT56": "i56",
    "UINT24": "u24", "UINT40": "u40", "UINT48": "u48", "UINT56": "u56",
    "REAL": "f32", "LREAL": "f64", "STRING": "str", "OCTET_STRING": "octets", "UNICODE_STRING": "wide",
    "WSTRING": "wide", "TIME_OF_DAY": "time of day", "TIME_DIFFERENCE": "time difference", "DOMAIN": "domain",
    "GUID": "octets(16)",
}
LANGUAGES = {"1031": "de-DE", "1033": "en-US", "1036": "fr-FR", "2052": "zh-CN"}
MAX_DEPTH = 12


def number(text):
    """Returns a HexDecValue of ETG.2000 as a decimal number."""
    if re.fullmatch(r"[+-]?[0-9]+", text):
        return str(int(text))
    if re.fullmatch(r"#x[0-9A-Fa-f]+", text):
        return str(int(text[2:], 16))
    return text and "?" + text


def nonzero(text):
    """Returns a number. Returns an empty text for 0, which means that there is no value."""
    found = number(text)
    return "" if found == "0" else found


def flag(text):
    return {"": "", "0": "", "false": "", "1": "yes", "true": "yes"}.get(text, "?" + text)


def bit(text, position):
    """Returns whether a bit of a number is set."""
    found = number(text)
    return "yes" if found.isdigit() and int(found) >> position & 1 else ""


def name(element, path="Name"):
    """Returns the English name. If there is none, returns the name without a language, otherwise the first name."""
    for found in (f"{path}[@LcId='1033'][normalize-space()]", f"{path}[not(@LcId)][normalize-space()]", path):
        if xpath(found)(element):
            return text(element, found)
    return ""


def names(element, path="Name", fact="name"):
    """Returns the name of an element and its translations."""
    texts = [node for node in xpath(path)(element) if text(node)]
    wanted = [node for lcid in ("1033", "") for node in texts if text(node, "@LcId") == lcid] + texts
    others = {f"{fact} {language(node)}": text(node) for node in texts if node is not wanted[0]}
    return {fact: text(wanted[0]) if wanted else "", **others}


def language(element):
    """Returns the BCP 47 tag for the Windows LcId of a text. A text without an LcId is English."""
    lcid = text(element, "@LcId") or "1033"
    return LANGUAGES.get(lcid, f"lcid:{lcid}")


def basic(name):
    """Returns the type that a type name of ETG.1000.6 denotes."""
    if name in BASIC:
        return BASIC[name]
    if found := re.fullmatch(r"BITARR(8|16|32)", name) or re.fullmatch(r"BIT([1-9]|1[0-6])", name):
        return f"u{found[1]}"
    if found := re.fullmatch(r"(STRING|OCTET_STRING|WSTRING|UNICODE_STRING)\((\d+)\)", name):
        return f"{BASIC[found[1]]}({found[2]})"
    if found := re.fullmatch(r"ARRAY \[(\d+)\.\.(\d+)\] OF (\w+)", name):
        count = int(found[2]) - int(found[1]) + 1
        element = BASIC.get(found[3], "?")
        return f"octets({count})" if found[3] == "BYTE" else f"{element}[{count}]"
    return "?" + name


class Types:
    """The data types of one device or module."""

    def __init__(self, owner):
        self.by_name = {}
        for element in xpath("DataTypes/DataType")(owner):
            self.by_name.setdefault(text(element, "Name"), element)

    def add(self, other):
        for name, element in other.by_name.items():
            self.by_name.setdefault(name, element)

    def record(self, name, depth=0):
        """Returns the sub-items of a type. Returns None if the type is not a record."""
        node = self.by_name.get(name)
        if node is None or depth > MAX_DEPTH:
            return None
        fields = xpath("SubItem")(node)
        base = text(node, "BaseType")
        return fields or (self.record(base, depth + 1) if base and base != name else None)

    def array(self, name):
        """Returns the lower bound, the number of elements and the element type of an array type. Returns None for other types."""
        node = self.by_name.get(name)
        bounds = xpath("ArrayInfo")(node) if node is not None else []
        if not bounds or xpath("SubItem")(node):
            return None
        low, count = number(text(bounds[0], "LBound")), 1
        for bound in bounds:
            elements = number(text(bound, "Elements"))
            count *= int(elements) if elements.isdigit() else 0
        return int(low) if low.isdigit() else 0, count, text(node, "BaseType")

    def resolve(self, name, depth=0):
        node = self.by_name.get(name)
        if node is None or depth > MAX_DEPTH:
            return basic(name)
        base = text(node, "BaseType")
        if xpath("SubItem")(node):
            return "record"
        if array := self.array(name):
            return f"{self.resolve(array[2], depth + 1)}[{array[1]}]"
        bits = text(node, "BitSize")
        if not base and xpath("EnumInfo")(node):
            return f"?enumeration of {bits} bits"
        found = self.resolve(base, depth + 1) if base and base != name else basic(name)
        if re.fullmatch(r"[iu][0-9]+", found) and bits.isdigit() and 0 < int(bits) <= 64:
            return found[0] + bits
        if found in ("str", "octets", "wide") and bits.isdigit() and int(bits) % 8 == 0 and bits != "0":
            found += f"({int(bits) // (16 if found == 'wide' else 8)})"
        return found


def data(raw, ty):
    """Converts hexadecimal digits in memory order to a value of type `ty`."""
    try:
        octets = bytes.fromhex(raw)
    except ValueError:
        return "?" + raw
    kind, bits = ty[0], ty[1:]
    if ty == "bool" and len(octets) == 1:
        return str(int(octets[0] != 0))
    if ty in ("f32", "f64") and len(octets) * 8 == int(bits):
        return real(struct.unpack("<f" if ty == "f32" else "<d", octets)[0])
    if kind in "iu" and bits.isdigit():
        if len(octets) != (int(bits) + 7) // 8:
            return "?" + raw
        return str(int.from_bytes(octets, "little", signed=kind == "i"))
    if re.fullmatch(r"str(\(\d+\))?", ty):
        octets = octets.rstrip(b"\0")
        try:
            return f"'{octets.decode()}'"
        except UnicodeDecodeError:
            return f"'{octets.decode('latin-1')}'"
    if re.fullmatch(r"wide(\(\d+\))?", ty):
        decoded = octets.decode("utf-16-le", "replace").rstrip("\0")
        return f"'{decoded}'"
    return "?" + raw if ty in ("bool", "f32", "f64") else f"x'{octets.hex()}'"


def value(info, what, ty):
    """Returns the default or a limit in an Info element, or in a sub-item of a type. `what` is Default, Min or Max."""
    if raw := text(info, f"{what}Data"):
        return data(raw, ty)
    if raw := text(info, f"{what}Value"):
        if ty in ("f32", "f64"):
            try:
                return real(float(raw))
            except ValueError:
                return "?" + raw
        return number(raw)
    if raw := text(info, f"{what}String"):
        return f"'{raw}'" if ty.startswith(("str", "wide")) else "?" + raw
    return ""


def values(infos, ty):
    """Returns the default and the limits. The facts of the object take precedence over those of the type."""
    facts = {}
    for key, what in ("default", "Default"), ("low", "Min"), ("high", "Max"):
        facts[key] = next((found for info in infos if (found := value(info, what, ty))), "")
    return facts
