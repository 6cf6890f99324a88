"""Reads GSDML files with XPath and prints the facts of each file as one line of JSON.

The arguments are file names. `elements` maps the name of an element (`device 0`, `submodule 3 record 0 ref 1`) to its facts, and each
fact has a name. Missing facts are left out. Text that the script cannot interpret is kept after a question mark. `errors` lists the
reasons why the file is not well-formed.
"""

import json
import sys

from lxml import etree

import gsdml_data as data
import gsdml_types as types
from reading import parse, text, nonempty, xpath

SUBMODULES = "VirtualSubmoduleItem", "InterfaceSubmoduleItem", "PortSubmoduleItem", "SubmoduleItem"
PROCESS = "//ApplicationProcess"


class Texts:
    """The text list of a file in all its languages."""

    def __init__(self, root):
        self.languages = {}
        for node in xpath("//ExternalTextList/PrimaryLanguage | //ExternalTextList/Language")(root):
            language = "" if node.tag == "PrimaryLanguage" else " " + text(node, "@*[local-name()='lang']")
            for entry in xpath("Text")(node):
                by_id = self.languages.setdefault(language, {})
                by_id.setdefault(text(entry, "@TextId"), entry.get("Value", ""))

    def names(self, element, path="@TextId", fact="name"):
        """Returns the name of an element in each language of the text list."""
        id = text(element, path)
        return {fact + language: by_id[id] for language, by_id in self.languages.items() if id in by_id}


def info(element, texts):
    """Returns the facts in the ModuleInfo of an element."""
    return {
        **texts.names(element, "ModuleInfo/Name/@TextId"),
        **texts.names(element, "ModuleInfo/InfoText/@TextId", "info"),
        "order number": text(element, "ModuleInfo/OrderNumber/@Value"),
    }


def held(found, owner, element, order, texts):
    """Adds the built-in and pluggable submodules of a device access point or module."""
    usual = {"VirtualSubmoduleItem": 1, "InterfaceSubmoduleItem": 0x8000, "PortSubmoduleItem": 0x8001}
    for node in xpath("VirtualSubmoduleList/* | SystemDefinedSubmoduleList/*")(element):
        subslots = types.numbers(text(node, "@FixedInSubslots")), types.number(text(node, "@SubslotNumber"))
        subslots = " ".join(filter(None, subslots)) or str(usual.get(node.tag, "?"))
        found[f"{owner} holds {order[node]}"] = {"fixed": subslots}
    targets = {}
    for node in xpath(f"{PROCESS}/SubmoduleList/*")(element):
        targets.setdefault(text(node, "@ID"), order[node])
    for node in xpath("UseableSubmodules/SubmoduleItemRef")(element):
        target = text(node, "@SubmoduleItemTarget")
        found[f"{owner} holds {targets.get(target, '?' + target)}"] = places(node, "Subslots")
    for node in xpath("SubslotList/SubslotItem")(element):
        found[f"{owner} subslot {text(node, '@SubslotNumber')}"] = texts.names(node)


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
    for node in xpath("UseableModules/ModuleItemRef")(element):
        found[f"{owner} takes {text(node, '@ModuleItemTarget')}"] = places(node, "Slots")
    for node in xpath("SlotList/SlotItem")(element):
        found[f"{owner} slot {text(node, '@SlotNumber')}"] = texts.names(node)
    for at, node in enumerate(xpath("ARVendorBlock/Request")(element)):
        key = f"{owner} request {at}"
        found[key] = {
            "index": types.number(text(node, "@APStructureIdentifier")),
            "api": types.number(text(node, "@API")) or "0",
            "length": types.number(text(node, "@Length")),
            **data.body(found, key, node, texts),
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
        below = [node for row in rows for node in xpath(f"{extended}/*")(row)]
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
    for at, node in enumerate(xpath(f"{PROCESS}/UnitDiagTypeList/*")(root)):
        key = f"unit {at}"
        found[key] = {
            "api": types.number(text(node, "@API")) or "0",
            "identifier": types.number(text(node, "@UserStructureIdentifier")),
            **texts.names(node, "Name/@TextId"),
            **texts.names(node, "Help/@TextId", "help"),
        }
        for place, ref in enumerate(xpath("Ref")(node)):
            ty, bits = types.of_element(ref)
            bit = types.number(text(ref, "@BitOffset")) if text(ref, "@DataType") in ("Bit", "BitArea") else ""
            offset = 8 * int(types.number(text(ref, "@ByteOffset")) or 0) + int(bit or 0)
            ty = "bool" if text(ref, "@DataType") == "Bit" else ty
            facts = {"type": ty, "offset": str(offset), "bits": str(bits), **texts.names(ref)}
            found[f"{key} field {place}"] = facts


def log_book(found, root, texts):
    """Adds the log book entries. The code of an entry is a status whose last byte is the error code 2."""
    rows = xpath(f"{PROCESS}/LogBookEntryList/LogBookEntryItem/*[self::ErrorCode2Value or self::ErrorCode2List]")(root)
    entries = [node for row in rows for node in (xpath("ErrorCode2Item")(row) or [row])]
    for at, node in enumerate(entries):
        first = int(types.number(text(node, "ancestor::LogBookEntryItem/@Status"))) << 8
        whole = node.tag == "ErrorCode2Value"
        found[f"log_book {at}"] = {
            "code": str(first if whole else first + int(types.number(text(node, "@ErrorCode2")))),
            "last": str(first + 0xFF) if whole else "",
            **texts.names(node, "Name/@TextId"),
            **texts.names(node, "Help/@TextId", "help"),
        }


def lists(found, root, texts):
    for node in xpath(f"{PROCESS}/ValueList/ValueItem")(root):
        facts = found.setdefault(f"values {text(node, '@ID')}", {})
        for assign in xpath("Assignments/Assign")(node):
            content = types.numbers(text(assign, "@Content"))
            for fact, name in texts.names(assign).items():
                facts[f"{content}{fact[4:]}"] = name
    for node in xpath(f"{PROCESS}/CategoryList/CategoryItem")(root):
        found[f"category {text(node, '@ID')}"] = texts.names(node)
    for node in xpath(f"{PROCESS}/GraphicsList/GraphicItem")(root):
        found[f"graphic {text(node, '@ID')}"] = {"file": text(node, "@GraphicFile")}


def elements(root):
    for node in root.iter(etree.Element):
        node.tag = etree.QName(node).localname
    texts, found = Texts(root), {}
    identity = {
        "vendor number": types.ident(text(root, "//DeviceIdentity/@VendorID")),
        "device number": types.ident(text(root, "//DeviceIdentity/@DeviceID")),
        "vendor": text(root, "//DeviceIdentity/VendorName/@Value"),
        "main family": text(root, "//DeviceFunction/Family/@MainFamily"),
        "product family": text(root, "//DeviceFunction/Family/@ProductFamily"),
    }
    order = {node: at for at, node in enumerate(node for node in root.iter(*SUBMODULES))}
    for at, node in enumerate(xpath(f"{PROCESS}/DeviceAccessPointList/DeviceAccessPointItem")(root)):
        device(found, f"device {at}", node, order, texts)
        found[f"device {at}"] |= identity
    for at, node in enumerate(xpath(f"{PROCESS}/ModuleList/ModuleItem")(root)):
        module(found, f"module {at}", node, order, texts)
    for node, at in order.items():
        submodule(found, f"submodule {at}", node, texts)
    diagnosis(found, root, texts)
    log_book(found, root, texts)
    lists(found, root, texts)
    return nonempty(found)


for path in sys.argv[1:]:
    try:
        answer = {"elements": elements(parse(path))}
    except etree.XMLSyntaxError as error:
        answer = {"errors": [str(error).split(" (<string>")[0]]}
    print(json.dumps(answer))
