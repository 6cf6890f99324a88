"""Reads ESI files with XPath and prints the facts of each file as one line of JSON.

The arguments are file names. `elements` maps the name of an element (`device 0`, `device 0 object 1018:01`) to its facts, and each
fact has a name. Missing facts are left out. Text that the script cannot interpret according to ETG.2000 is kept after a question
mark. `errors` lists the reasons why the file is not well-formed.
"""

import json
import re
import sys

from lxml import etree

from esi_objects import objects
from esi_types import basic, bit, flag, name, names, nonzero, number
from reading import parse, text, nonempty, xpath


def pdos(found, owner, parent, types):
    for kind in "RxPdo", "TxPdo":
        for at, pdo in enumerate(xpath(kind)(parent)):
            key = f"{owner} {kind} {at}"
            found[key] = {
                "index": nonzero(text(pdo, "Index")),
                **names(pdo),
                "Sm": number(text(pdo, "@Sm")),
                "Su": number(text(pdo, "@Su")),
                "fixed": flag(text(pdo, "@Fixed")),
                "mandatory": flag(text(pdo, "@Mandatory")),
                "virtual": flag(text(pdo, "@Virtual")),
                "by slot": flag(text(pdo, "Index/@DependOnSlot")),
                "excludes": " ".join(number(text(other)) for other in xpath("Exclude")(pdo)),
                "excluded Sms": " ".join(number(text(other)) for other in xpath("ExcludedSm")(pdo)),
            }
            for place, entry in enumerate(xpath("Entry")(pdo)):
                called = text(entry, "DataType")
                found[f"{key} entry {place}"] = {
                    "index": nonzero(text(entry, "Index")),
                    "sub-index": nonzero(text(entry, "SubIndex")),
                    "bits": number(text(entry, "BitLen")),
                    **names(entry),
                    "type": called and (types.resolve(called) if types else basic(called)),
                    "fixed": flag(text(entry, "@Fixed")),
                    "by slot": flag(text(entry, "Index/@DependOnSlot")),
                }


def commands(found, owner, parent):
    for at, command in enumerate(xpath("Mailbox/CoE/InitCmd")(parent)):
        found[f"{owner} command {at}"] = {
            "transitions": " ".join(text(one) for one in xpath("Transition")(command)),
            "index": number(text(command, "Index")),
            "sub-index": nonzero(text(command, "SubIndex")),
            "data": re.sub(r"\s", "", text(command, "Data")).lower(),
            "complete": flag(text(command, "@CompleteAccess")),
            "fixed": flag(text(command, "@Fixed")),
            "by slot": flag(text(command, "Index/@DependOnSlot")),
            "comment": text(command, "Comment"),
        }


def clocks(found, owner, parent):
    for at, mode in enumerate(xpath("Dc/OpMode")(parent)):
        facts = {
            "name": text(mode, "Name"),
            "description": text(mode, "Desc"),
            "assign": nonzero(text(mode, "AssignActivate")),
        }
        for time in "CycleTimeSync0", "ShiftTimeSync0", "CycleTimeSync1", "ShiftTimeSync1":
            facts[time] = nonzero(text(mode, time))
            facts[f"{time} factor"] = number(text(mode, f"{time}/@Factor"))
        found[f"{owner} mode {at}"] = facts


def slots(found, owner, parent):
    increments = "SlotIndexIncrement", "SlotPdoIncrement", "SlotGroupIndexIncrement", "SlotGroupPdoIncrement"
    for slots in xpath("Slots")(parent):
        found[f"{owner} slots"] = {
            "most": number(text(slots, "@MaxSlotCount")),
            "groups": number(text(slots, "@MaxSlotGroupCount")),
            "download": flag(text(slots, "@DownloadModuleIdentList")),
        }
    for at, slot in enumerate(xpath("Slots/Slot")(parent)):
        least = number(text(slot, "@MinInstances")) or "0"
        facts = {
            **names(slot),
            "least": least,
            "most": number(text(slot, "@MaxInstances")) or str(max(int(least), 1)),
            "group": number(text(slot, "@SlotGroup")),
            "idents": " ".join(number(text(ident)) for ident in xpath("ModuleIdent")(slot)),
            "classes": " / ".join(text(one) for one in xpath("ModuleClass/Class")(slot)),
        }
        for increment in increments:
            facts[increment] = number(text(slot, f"@{increment}")) or number(text(slot, f"../@{increment}")) or "0"
        found[f"{owner} slot {at}"] = facts


def device(found, owner, parent, vendor):
    found[owner] = {
        **names(parent),
        **names(parent, "Comment", "comment"),
        "type": text(parent, "Type"),
        "product code": number(text(parent, "Type/@ProductCode")),
        "revision": number(text(parent, "Type/@RevisionNo")),
        "physics": text(parent, "@Physics"),
        "group": text(parent, "GroupType"),
        "EEPROM size": number(text(parent, "Eeprom/ByteSize")),
        "EEPROM configuration": re.sub(r"\s", "", text(parent, "Eeprom/ConfigData")).lower(),
        "EEPROM boot-strap": re.sub(r"\s", "", text(parent, "Eeprom/BootStrap")).lower(),
        "CoE": " ".join(
            key
            for key in ("SdoInfo", "PdoAssign", "PdoConfig", "PdoUpload", "CompleteAccess", "SegmentedSdo")
            if flag(text(parent, f"Mailbox/CoE/@{key}"))
        ),
        **vendor,
    }
    for at, fmmu in enumerate(xpath("Fmmu")(parent)):
        found[f"{owner} FMMU {at}"] = {
            "purpose": text(fmmu),
            "Sm": number(text(fmmu, "@Sm")),
            "Su": number(text(fmmu, "@Su")),
            "OP only": flag(text(fmmu, "@OpOnly")),
        }
    for at, sm in enumerate(xpath("Sm")(parent)):
        found[f"{owner} Sm {at}"] = {
            "purpose": text(sm),
            "address": nonzero(text(sm, "@StartAddress")),
            "size": number(text(sm, "@DefaultSize")),
            "least": number(text(sm, "@MinSize")),
            "most": number(text(sm, "@MaxSize")),
            "control": nonzero(text(sm, "@ControlByte")),
            "enable": nonzero(text(sm, "@Enable")),
            # Bit 2 (virtual) and bit 3 (OP only) of Enable have the same meaning as in the SII.
            "OP only": flag(text(sm, "@OpOnly")) or bit(text(sm, "@Enable"), 3),
            "virtual": flag(text(sm, "@Virtual")) or bit(text(sm, "@Enable"), 2),
        }
    types = objects(found, owner, xpath("Profile/Dictionary")(parent))
    pdos(found, owner, parent, types)
    commands(found, owner, parent)
    clocks(found, owner, parent)
    slots(found, owner, parent)


def module(found, owner, parent, vendor):
    found[owner] = {
        **names(parent),
        "type": text(parent, "Type"),
        "ident": number(text(parent, "Type/@ModuleIdent")),
        "class": text(parent, "Type/@ModuleClass"),
        **vendor,
    }
    types = objects(found, owner, xpath("Profile/Dictionary")(parent))
    pdos(found, owner, parent, types)
    commands(found, owner, parent)


def elements(root):
    found, devices, modules = {}, 0, 0
    for info in xpath("self::EtherCATInfo | self::EtherCATModule | EtherCATInfo")(root):
        vendor = {"vendor": name(info, "Vendor/Name"), "vendor number": number(text(info, "Vendor/Id"))}
        for node in xpath("Descriptions/Devices/Device | Devices/Device")(info):
            device(found, f"device {devices}", node, vendor)
            devices += 1
        for node in xpath("Descriptions/Modules/Module | Modules/Module")(info):
            module(found, f"module {modules}", node, vendor)
            modules += 1
    if root.tag == "EtherCATDict":
        found["device 0"] = {}
        objects(found, "device 0", xpath("Dictionary")(root))
    return nonempty(found)


for path in sys.argv[1:]:
    try:
        answer = {"elements": elements(parse(path))}
    except etree.XMLSyntaxError as error:
        # If the file is not well-formed, compare the part that libxml2 recovers from it.
        answer = {"errors": [str(error).split(" (<string>")[0]], "elements": elements(parse(path, recover=True))}
    print(json.dumps(answer))
