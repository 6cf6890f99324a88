"""Reads GSDML files with XPath and prints the facts that they have: one JSON object a line.

Called with the names of files. `elements` are facts by name, by element: `device 0`, `submodule 3 record 0 ref 1`. What a
file doesn't say is no fact. What this plain reading makes nothing of is kept as it is, behind a question mark. `errors`
are why the file isn't well-formed.
"""

import json
import sys

from lxml import etree

import gsdml_data as data
import gsdml_types as types
from reading import parse, text, told, xpath

SUBMODULES = "VirtualSubmoduleItem", "InterfaceSubmoduleItem", "PortSubmoduleItem", "SubmoduleItem"
PROCESS = "//ApplicationProcess"


class Texts:
    """The text list."""

    def __init__(self, root):
        self.languages = {}
        for own in xpath("//ExternalTextList/PrimaryLanguage | //ExternalTextList/Language")(root):
            language = "" if own.tag == "PrimaryLanguage" else " " + text(own, "@*[local-name()='lang']")
            for entry in xpath("Text")(own):
                by_id = self.languages.setdefault(language, {})
                by_id.setdefault(text(entry, "@TextId"), entry.get("Value", ""))

    def names(self, element, path="@TextId", fact="name"):
        """The name that an element refers to, in each language."""
        id = text(element, path)
        return {fact + language: by_id[id] for language, by_id in self.languages.items() if id in by_id}


def info(element, texts):
    """ModuleInfo."""
    return {
        **texts.names(element, "ModuleInfo/Name/@TextId"),
        **texts.names(element, "ModuleInfo/InfoText/@TextId", "info"),
        "order number": text(element, "ModuleInfo/OrderNumber/@Value"),
    }


def held(found, owner, element, order, texts):
    """Submodules that are built in, and those that can be plugged in."""
    usual = {"VirtualSubmoduleItem": 1, "InterfaceSubmoduleItem": 0x8000, "PortSubmoduleItem": 0x8001}
    for own in xpath("VirtualSubmoduleList/* | SystemDefinedSubmoduleList/*")(element):
        subslots = types.numbers(text(own, "@FixedInSubslots")), types.number(text(own, "@SubslotNumber"))
        subslots = " ".join(filter(None, subslots)) or str(usual.get(own.tag, "?"))
        found[f"{owner} holds {order[own]}"] = {"fixed": subslots}
    targets = {}
    for own in xpath(f"{PROCESS}/SubmoduleList/*")(element):
        targets.setdefault(text(own, "@ID"), order[own])
    for own in xpath("UseableSubmodules/SubmoduleItemRef")(element):
        target = text(own, "@SubmoduleItemTarget")
        found[f"{owner} holds {targets.get(target, '?' + target)}"] = places(own, "Subslots")
    for own in xpath("SubslotList/SubslotItem")(element):
        found[f"{owner} subslot {text(own, '@SubslotNumber')}"] = texts.names(own)


def places(element, what):
    return {
        "allowed": types.numbers(text(element, f"@AllowedIn{what}")),
        "fixed": types.numbers(text(element, f"@FixedIn{what}")),
        "used": types.numbers(text(element, f"@UsedIn{what}")),
    }


def device(found, owner, element, order, texts):
    found[owner] = {
        "id": text(element, "@ID"),
        "ident": types.ident(text(element, "@ModuleIdentNumber")),
        "version": text(element, "@PNIO_Version"),
        "DNS name": text(element, "@DNS_CompatibleName"),
        "interval": types.number(text(element, "@MinDeviceInterval")),
        "record size": types.number(text(element, "@MaxSupportedRecordSize")) or "4068",
        "slots": types.numbers(text(element, "@PhysicalSlots")),
        **places(element, "Slots"),
        **info(element, texts),
        "most input": types.number(text(element, "IOConfigData/@MaxInputLength")),
        "most output": types.number(text(element, "IOConfigData/@MaxOutputLength")),
        "most data": types.number(text(element, "IOConfigData/@MaxDataLength")),
    }
    relations = "(SystemDefinedSubmoduleList/InterfaceSubmoduleItem/ApplicationRelations | ApplicationRelations)[1]"
    modes = [mode.strip() for mode in text(element, f"{relations}/@StartupMode").split(";")]
    found[owner] |= {
        "start-up": " ".join(filter(None, modes)) or "Legacy",
        "relations": types.number(text(element, f"{relations}/@NumberOfAR")) or "1",
        "clocks": types.numbers(text(element, f"{relations}/TimingProperties/@SendClock")) or "32",
        "ratios": types.numbers(text(element, f"{relations}/TimingProperties/@ReductionRatio")),
    }
    for own in xpath("UseableModules/ModuleItemRef")(element):
        found[f"{owner} takes {text(own, '@ModuleItemTarget')}"] = places(own, "Slots")
    for own in xpath("SlotList/SlotItem")(element):
        found[f"{owner} slot {text(own, '@SlotNumber')}"] = texts.names(own)
    for at, own in enumerate(xpath("ARVendorBlock/Request")(element)):
        key = f"{owner} request {at}"
        found[key] = {
            "index": types.number(text(own, "@APStructureIdentifier")),
            "api": types.number(text(own, "@API")) or "0",
            "length": types.number(text(own, "@Length")),
            **data.body(found, key, own, texts),
        }
    held(found, owner, element, order, texts)


def module(found, owner, element, order, texts):
    found[owner] = {
        "id": text(element, "@ID"),
        "ident": types.ident(text(element, "@ModuleIdentNumber")),
        "subslots": types.numbers(text(element, "@PhysicalSubslots")),
        "hardware": text(element, "ModuleInfo/HardwareRelease/@Value"),
        "software": text(element, "ModuleInfo/SoftwareRelease/@Value"),
        **info(element, texts),
    }
    held(found, owner, element, order, texts)


def submodule(found, owner, element, texts):
    found[owner] = {
        "id": text(element, "@ID"),
        "kind": element.tag,
        "ident": types.ident(text(element, "@SubmoduleIdentNumber")),
        "api": types.number(text(element, "@API")) or "0",
        "provider": types.number(text(element, "IOData/@IOPS_Length")) or "1",
        "consumer": types.number(text(element, "IOData/@IOCS_Length")) or "1",
        **texts.names(element),
        **info(element, texts),
    }
    data.io_data(found, owner, element, texts)
    data.records(found, owner, element, texts)
    data.menus(found, owner, element, texts)


def diagnosis(found, root, texts):
    kinds = (
        ("channel_diagnosis", "ChannelDiagList", "@ErrorType", "ExtChannelDiagList"),
        ("process_alarms", "ChannelProcessAlarmList", "@Reason", "ExtChannelProcessAlarmList"),
    )
    for table, path, code, extended in kinds:
        rows = xpath(f"{PROCESS}/{path}/*")(root)
        below = [own for row in rows for own in xpath(f"{extended}/*")(row)]
        for name, rows in (table, rows), (f"extended_{table}", below):
            for at, row in enumerate(rows):
                parent = row.getparent().getparent() if name != table else None
                found[f"{name} {at}"] = {
                    "code": types.number(text(row, code) or text(row, "@ErrorType")),
                    "of": "" if parent is None else types.number(text(parent, code) or text(parent, "@ErrorType")),
                    "state": text(row, "@MaintenanceAlarmState") or "D",
                    "api": types.number(text(row, "@API")) or "0",
                    **texts.names(row, "Name/@TextId"),
                    **texts.names(row, "Help/@TextId", "help"),
                }
    for at, own in enumerate(xpath(f"{PROCESS}/UnitDiagTypeList/*")(root)):
        key = f"unit {at}"
        found[key] = {
            "api": types.number(text(own, "@API")) or "0",
            "identifier": types.number(text(own, "@UserStructureIdentifier")),
            **texts.names(own, "Name/@TextId"),
            **texts.names(own, "Help/@TextId", "help"),
        }
        for place, ref in enumerate(xpath("Ref")(own)):
            ty, bits = types.of_element(ref)
            bit = types.number(text(ref, "@BitOffset")) if text(ref, "@DataType") in ("Bit", "BitArea") else ""
            offset = 8 * int(types.number(text(ref, "@ByteOffset")) or 0) + int(bit or 0)
            ty = "bool" if text(ref, "@DataType") == "Bit" else ty
            facts = {"type": ty, "offset": str(offset), "bits": str(bits), **texts.names(ref)}
            found[f"{key} field {place}"] = facts


def log_book(found, root, texts):
    """Each entry with the status whose last byte is the error code."""
    rows = xpath(f"{PROCESS}/LogBookEntryList/LogBookEntryItem/*[self::ErrorCode2Value or self::ErrorCode2List]")(root)
    entries = [own for row in rows for own in (xpath("ErrorCode2Item")(row) or [row])]
    for at, own in enumerate(entries):
        first = int(types.number(text(own, "ancestor::LogBookEntryItem/@Status"))) << 8
        whole = own.tag == "ErrorCode2Value"
        found[f"log_book {at}"] = {
            "code": str(first if whole else first + int(types.number(text(own, "@ErrorCode2")))),
            "last": str(first + 0xFF) if whole else "",
            **texts.names(own, "Name/@TextId"),
            **texts.names(own, "Help/@TextId", "help"),
        }


def lists(found, root, texts):
    for own in xpath(f"{PROCESS}/ValueList/ValueItem")(root):
        facts = found.setdefault(f"values {text(own, '@ID')}", {})
        for assign in xpath("Assignments/Assign")(own):
            content = types.numbers(text(assign, "@Content"))
            for fact, name in texts.names(assign).items():
                facts[f"{content}{fact[4:]}"] = name
    for own in xpath(f"{PROCESS}/CategoryList/CategoryItem")(root):
        found[f"category {text(own, '@ID')}"] = texts.names(own)
    for own in xpath(f"{PROCESS}/GraphicsList/GraphicItem")(root):
        found[f"graphic {text(own, '@ID')}"] = {"file": text(own, "@GraphicFile")}


def elements(root):
    for own in root.iter(etree.Element):
        own.tag = etree.QName(own).localname
    texts, found = Texts(root), {}
    identity = {
        "vendor number": types.ident(text(root, "//DeviceIdentity/@VendorID")),
        "device number": types.ident(text(root, "//DeviceIdentity/@DeviceID")),
        "vendor": text(root, "//DeviceIdentity/VendorName/@Value"),
        "main family": text(root, "//DeviceFunction/Family/@MainFamily"),
        "product family": text(root, "//DeviceFunction/Family/@ProductFamily"),
    }
    order = {own: at for at, own in enumerate(own for own in root.iter(*SUBMODULES))}
    for at, own in enumerate(xpath(f"{PROCESS}/DeviceAccessPointList/DeviceAccessPointItem")(root)):
        device(found, f"device {at}", own, order, texts)
        found[f"device {at}"] |= identity
    for at, own in enumerate(xpath(f"{PROCESS}/ModuleList/ModuleItem")(root)):
        module(found, f"module {at}", own, order, texts)
    for own, at in order.items():
        submodule(found, f"submodule {at}", own, texts)
    diagnosis(found, root, texts)
    log_book(found, root, texts)
    lists(found, root, texts)
    return told(found)


for path in sys.argv[1:]:
    try:
        answer = {"elements": elements(parse(path))}
    except etree.XMLSyntaxError as error:
        answer = {"errors": [str(error).split(" (<string>")[0]]}
    print(json.dumps(answer))
