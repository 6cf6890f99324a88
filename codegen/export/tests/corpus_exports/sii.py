"""Reads EEPROM images of EtherCAT slaves, and compares them with the ESI files from which they were made.

Standard input contains one line of JSON for each device: `esi` (a path), `device` (the position of the device in the file), `image`
(a path) and `notes` (the names of the notes of the export). The program prints one line of JSON for each device: a list of
differences. This program and the exporter share no code.
"""

import json
import re
import sys
from xml.etree import ElementTree

TYPES = {
    "BOOL": 1, "SINT": 2, "INT": 3, "DINT": 4, "USINT": 5, "UINT": 6, "UDINT": 7, "REAL": 8, "INT24": 0x10, "LREAL": 0x11,
    "LINT": 0x15, "UINT24": 0x16, "ULINT": 0x1B, "BIT1": 0x30, "BIT2": 0x31, "BIT3": 0x32, "BIT4": 0x33, "BIT5": 0x34,
    "BIT6": 0x35, "BIT7": 0x36, "BIT8": 5,
}
FMMUS = {"": 0, "Outputs": 1, "Inputs": 2, "MBoxState": 3}
MANAGERS = {"MBoxOut": 1, "MBoxIn": 2, "Outputs": 3, "Inputs": 4}


def number(text, default=0):
    text = (text or "").strip()
    if not text:
        return default
    if text[:2] in ("#x", "0x"):
        return int(text[2:], 16)
    try:
        return int(text)
    except ValueError:
        return int(text, 16)


def flag(text):
    return (text or "").strip().lower() in ("true", "1")


def octets(element):
    return bytes.fromhex("".join((element.text or "").split())) if element is not None else b""


def encoded(text):
    return " ".join((text or "").split()).encode("latin-1", "replace")[:255].decode("latin-1")


def names(element):
    return {encoded(name.text) for name in element.findall("Name")} or {""}


def word(data, at):
    return data[at] | data[at + 1] << 8


def double(data, at):
    return word(data, at) | word(data, at + 2) << 16


def signed(value, bits):
    return value - (1 << bits) if value >> (bits - 1) else value


def crc(data):
    value = 0xFF
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = (value << 1 ^ 0x107) if value & 0x80 else value << 1
    return value


class Image:
    """The content of an EEPROM."""

    def __init__(self, data):
        self.data = data
        self.categories = []
        at = 128
        while word(data, at) != 0xFFFF:
            kind, length = word(data, at), 2 * word(data, at + 2)
            assert at + 4 + length <= len(data), "a category ends after the EEPROM"
            self.categories.append((kind, data[at + 4 : at + 4 + length]))
            at += 4 + length
        assert set(data[at:]) == {0xFF}, "unused bytes are not 0xFF"
        content = self.category(10)
        self.texts, at = [""], 1
        for _ in range(content[0]):
            length = content[at]
            self.texts.append(" ".join(content[at + 1 : at + 1 + length].decode("latin-1").split()))
            at += 1 + length
        assert len(content) - at in (0, 1), "the texts do not fill their category"

    def category(self, kind):
        found = [content for number, content in self.categories if number == kind]
        assert len(found) < 2, f"category {kind} exists twice"
        return found[0] if found else b""

    def text(self, at):
        return self.texts[at]

    def pdos(self, kind):
        data, at, all = self.category(kind), 0, []
        while at < len(data):
            entries = []
            for entry in range(data[at + 2]):
                start = at + 8 + 8 * entry
                assert word(data, start + 6) == 0, "reserved flags of an entry are set"
                entries.append((word(data, start), data[start + 2], self.text(data[start + 3]), data[start + 4], data[start + 5]))
            assert data[at + 4] == 0, "a PDO has a clock"
            all.append((word(data, at), data[at + 3], self.text(data[at + 5]), word(data, at + 6), entries))
            at += 8 + 8 * data[at + 2]
        return all


class Comparison:
    """The differences between a device and its image."""

    def __init__(self, device, vendor, image, notes):
        self.device, self.vendor, self.image, self.notes = device, vendor, image, set(notes)
        self.wrong = []

    def equal(self, what, found, expected):
        if found != expected:
            self.wrong.append(f"{what}: {found!r} instead of {expected!r}")

    def one_of(self, what, found, expected, note=None):
        if found not in expected and note not in self.notes:
            self.wrong.append(f"{what}: {found!r} instead of one of {sorted(expected)!r}")

    def run(self):
        self.area()
        self.general()
        self.managers()
        self.equal("FMMUs", *self.fmmus())
        if "pdos-left-out" not in self.notes:
            self.pdos("TxPdo", 50)
            self.pdos("RxPdo", 51)
        self.clocks()
        given = [(number(item.findtext("CatNo")), octets(item.find("Data"))) for item in self.device.findall("Eeprom/Category")]
        others = [pair for pair in self.image.categories if pair[0] not in (10, 30, 40, 41, 50, 51, 60)]
        self.equal("categories", others, [(kind, data + b"\0" * (len(data) % 2)) for kind, data in given])
        return self.wrong

    def area(self):
        data, device = self.image.data, self.device
        config = octets(device.find("Eeprom/ConfigData"))[:14]
        if config:
            self.equal("ConfigData", data[:14], config + b"\0" * (14 - len(config)))
        self.equal("checksum", (data[14], data[15]), (crc(data[:14]), 0))
        self.equal("checksum of all", crc(data[:15]), 0)
        type = device.find("Type")
        expected = [self.vendor] + [number(type.get(key)) for key in ("ProductCode", "RevisionNo", "SerialNo")]
        self.equal("identity", [double(data, at) for at in (16, 20, 24, 28)], expected)
        boot = octets(device.find("Eeprom/BootStrap"))[:8]
        self.equal("BootStrap", data[40:48], boot + b"\0" * (8 - len(boot)))
        mailbox = device.find("Mailbox")
        bits = [mailbox is not None and mailbox.find(name) is not None for name in ("AoE", "EoE", "CoE", "FoE", "SoE", "VoE")]
        self.equal("protocols", word(data, 56), sum(1 << bit for bit, is_set in enumerate(bits) if is_set))
        self.equal("version", word(data, 126), 1)
        self.equal("reserved words", set(data[32:40] + data[58:124]), {0})
        self.equal("size", 128 * (word(data, 124) + 1), len(data))
        size = number(device.findtext("Eeprom/ByteSize"), None)
        if "eeprom-size" not in self.notes:
            self.equal("ByteSize", len(data), size)

    def general(self):
        data, device, text = self.image.category(30), self.device, self.image.text
        self.equal("length of general", len(data), 32)
        self.one_of("name", text(data[3]), names(device), "character")
        self.equal("order code", text(data[2]), encoded(device.findtext("Type")))
        self.equal("group", text(data[0]), encoded(device.findtext("GroupType")))
        coe = device.find("Mailbox/CoE")
        keys = ("SdoInfo", "PdoAssign", "PdoConfig", "PdoUpload", "CompleteAccess")
        bits = [] if coe is None else [True] + [flag(coe.get(key)) for key in keys]
        self.equal("CoE", data[5], sum(1 << bit for bit, is_set in enumerate(bits) if is_set))
        exists = [device.find(f"Mailbox/{name}") is not None for name in ("FoE", "EoE")]
        self.equal("FoE, EoE", [bool(data[6]), bool(data[7])], exists)
        behavior, mailbox = device.find("Info/StateMachine/Behavior"), device.find("Mailbox")
        address = device.findtext("Info/IdentificationAdo")
        bits = [
            behavior is not None and flag(behavior.get("StartToSafeopNoSync")),
            flag(device.find("Type").get("UseLrdLwr")),
            mailbox is not None and flag(mailbox.get("DataLinkLayer")),
            flag(device.findtext("Info/IdentificationReg134")),
            address is not None,
        ]
        self.equal("flags", data[11], sum(1 << bit for bit, is_set in enumerate(bits) if is_set))
        self.equal("reserved bytes", set(data[1:2] + data[4:5] + data[8:11] + data[15:16] + data[20:]), {0})
        self.equal("group again", data[14], data[0])
        self.equal("E-bus current", signed(word(data, 12), 16), number(device.findtext("Info/Electrical/EBusCurrent")))
        self.equal("identification register", word(data, 18), number(address))
        ports = enumerate(device.get("Physics", ""))
        self.equal("ports", word(data, 16), sum({"Y": 1, "K": 3, "H": 4, " ": 0}[letter] << 4 * port for port, letter in ports))

    def fmmus(self):
        expected = [FMMUS[(item.text or "").strip()] for item in self.device.findall("Fmmu")]
        return list(self.image.category(40)), expected + [0] * (len(expected) % 2)

    def managers(self):
        data = self.image.category(41)
        elements = self.device.findall("Sm")
        self.equal("number of sync managers", len(data), 8 * len(elements))
        boxes = {}
        for at, item in enumerate(elements):
            found = data[8 * at : 8 * at + 8]
            size = number(item.get("DefaultSize"), None)
            kind = MANAGERS.get((item.text or "").strip())
            enable = number(item.get("Enable")) & 0x0D | flag(item.get("Virtual")) << 2 | flag(item.get("OpOnly")) << 3
            self.equal(f"start of Sm {at}", word(found, 0), number(item.get("StartAddress")))
            self.equal(f"status of Sm {at}", found[5], 0)
            self.equal(f"control of Sm {at}", found[4], number(item.get("ControlByte")))
            self.equal(f"enable of Sm {at}", found[6], enable)
            if size is not None:
                self.equal(f"size of Sm {at}", word(found, 2), size)
            if kind is not None:
                self.equal(f"purpose of Sm {at}", found[7], kind)
            boxes.setdefault(found[7], (word(found, 0), word(found, 2)))
        for kind, at in ((1, 48), (2, 52)):
            found = (word(self.image.data, at), word(self.image.data, at + 2))
            self.equal(f"mailbox {kind}", found, boxes.get(kind, (0, 0)))

    def pdos(self, tag, kind):
        found, elements = self.image.pdos(kind), self.device.findall(tag)
        if "pdo-entries" in self.notes:
            elements = [item for item in elements if len(item.findall("Entry")) < 256]
        self.equal(f"number of {tag}", len(found), len(elements))
        for (index, manager, name, flags, entries), item in zip(found, elements):
            what = f"{tag} {index:04X}"
            number_of = item.find("Index")
            bits = [
                (0x0001, flag(item.get("Mandatory"))), (0x0002, item.get("Sm") is not None), (0x0004, item.get("OSFac") is not None),
                (0x0010, flag(item.get("Fixed"))), (0x0020, flag(item.get("Virtual"))),
                (0x0200, flag(number_of.get("DependOnSlot"))), (0x0400, flag(number_of.get("DependOnSlotGroup"))),
                (0x0800, flag(item.get("OverwrittenByModule"))),
            ]
            self.equal(f"index of {what}", index, number(number_of.text))
            self.equal(f"Sm of {what}", manager, number(item.get("Sm"), 0xFF))
            self.equal(f"flags of {what}", flags & ~4, sum(bit for bit, is_set in bits if is_set) & ~4)
            self.one_of(f"name of {what}", name, names(item), "character")
            self.entries(what, entries, item.findall("Entry"))

    def entries(self, what, found, elements):
        if "split-entry" in self.notes:
            expected = sum(number(item.findtext("BitLen")) for item in elements)
            self.equal(f"length of {what}", sum(entry[4] for entry in found), expected)
            return
        self.equal(f"number of entries of {what}", len(found), len(elements))
        for (index, sub, name, kind, bits), item in zip(found, elements):
            where = f"{what} entry {index:04X}:{sub:02X}"
            place = (number(item.findtext("Index")), number(item.findtext("SubIndex")), number(item.findtext("BitLen")))
            self.equal(f"place of {where}", (index, sub, bits), place)
            if index and name and not self.notes & {"character", "long-text"}:
                self.one_of(f"name of {where}", name, names(item) | self.object_names(index))
            ty = (item.findtext("DataType") or "").strip()
            if index and ty in TYPES:
                self.one_of(f"type of {where}", kind, {TYPES[ty]} | self.object_types(index, bits))

    def object_names(self, index):
        """Returns the names of an object and its entries, which may replace the name of a PDO entry."""
        return {encoded(name.text) for item in self.objects(index) for name in item.iter("Name")} | {
            encoded(name.text) for ty in self.types(index) for name in ty.iter("Name")
        }

    def object_types(self, index, bits):
        """Returns the numbers of the basic types of an object, which take precedence over the type of a PDO entry."""
        named = [item.findtext("Type") for item in self.objects(index)]
        named += [part.text for ty in self.types(index) for part in list(ty.iter("Type")) + list(ty.iter("BaseType"))]
        numbers = {TYPES.get((name or "").strip(), 0) for name in named}
        # For an enumeration or array type, the image can contain the number of a basic type of the same length.
        return numbers | {0} | ({0x2F + bits} if bits <= 16 else set()) | {5 if bits == 8 else 6 if bits == 16 else 7 if bits == 32 else 0}

    def objects(self, index):
        all = self.device.iterfind("Profile/Dictionary/Objects/Object")
        return [item for item in all if number(item.findtext("Index")) == index]

    def types(self, index):
        wanted = {item.findtext("Type") for item in self.objects(index)}
        all = self.device.findall("Profile/Dictionary/DataTypes/DataType")
        found = [item for item in all if item.findtext("Name") in wanted]
        inner = {part.text for item in found for part in item.iter("Type")}
        return found + [item for item in all if item.findtext("Name") in inner]

    def clocks(self):
        data, modes = self.image.category(60), self.device.findall("Dc/OpMode")
        self.equal("number of modes", len(data), 24 * len(modes))
        for at, item in enumerate(modes):
            part = data[24 * at : 24 * at + 24]
            value = lambda name: number(item.findtext(name))
            factor = lambda name: number(item.find(name).get("Factor")) if item.find(name) is not None else 0
            found = [signed(double(part, start), 32) for start in (0, 4, 8)]
            found += [signed(word(part, 12), 16), word(part, 14), signed(word(part, 16), 16)]
            expected = [value("CycleTimeSync0"), value("ShiftTimeSync0"), value("ShiftTimeSync1")]
            expected += [factor("CycleTimeSync1"), value("AssignActivate"), factor("CycleTimeSync0")]
            self.equal(f"mode {at}", found, expected)
            self.equal(f"reserved bytes of mode {at}", part[20:], b"\0" * 4)
            self.one_of(f"name of mode {at}", self.image.text(part[18]), names(item))
            described = {encoded(text.text) for text in item.findall("Desc")} or {""}
            self.one_of(f"description of mode {at}", self.image.text(part[19]), described, "character")


def parsed(path):
    data = open(path, "rb").read()
    # Files with a second root element are cut after the first one.
    root = re.search(rb"<(EtherCAT\w+)", data)
    end = root and re.search(b"</" + root.group(1) + b">", data)
    try:
        return ElementTree.fromstring(data[: end.end()] if end else data)
    except ElementTree.ParseError:
        return None


files = {}
for line in sys.stdin:
    request = json.loads(line)
    root = files.setdefault(request["esi"], parsed(request["esi"]) if request["esi"] not in files else None)
    if root is None:
        print(json.dumps(None))
        continue
    infos = [root] if root.tag == "EtherCATInfo" else root.findall("EtherCATInfo")
    pairs = [(device, number(info.findtext("Vendor/Id"))) for info in infos for device in info.findall(".//Devices/Device")]
    device, vendor = pairs[request["device"]]
    try:
        image = Image(open(request["image"], "rb").read())
        wrong = Comparison(device, vendor, image, request["notes"]).run()
    except (AssertionError, IndexError) as error:
        wrong = [f"{type(error).__name__}: {error}"]
    print(json.dumps(wrong))
