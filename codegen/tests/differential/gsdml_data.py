"""Reads the data of a GSDML submodule: cyclic data, parameter records, F-parameters and menus."""

import gsdml_types as types
from reading import text, xpath

# Values that the schema defines for missing F-parameters: default, allowed values, changeable and visible.
F_SCHEMA = {
    "F_Check_iPar": ("NoCheck", "Check NoCheck", False, False),
    "F_SIL": ("SIL3", "SIL1 SIL2 SIL3 NoSIL", True, True),
    "F_CRC_Length": ("3-Byte-CRC", "3-Byte-CRC", False, False),
    "F_CRC_Seed": ("CRC-Seed24/32", "CRC-Seed24/32", False, True),
    "F_Passivation": ("Device/Module", "Device/Module", False, True),
    "F_Block_ID": ("0", "0..7", False, True),
    "F_Par_Version": ("1", "1", False, True),
    "F_Source_Add": ("1", "1..65534", True, True),
    "F_Dest_Add": ("1", "1..65534", True, True),
    "F_WD_Time": ("150", "1..65535", True, True),
    "F_Par_CRC": ("53356", "0..65535", True, True),
    "F_iPar_CRC": ("0", "0..4294967295", True, True),
}


def io_data(found, owner, submodule, texts):
    for direction in "Input", "Output":
        for data in xpath(f"IOData/{direction}")(submodule):
            key, at, trailer = f"{owner} {direction}", 0, 0
            for place, item in enumerate(xpath("DataItem")(data)):
                name, (ty, bits) = text(item, "@DataType"), types.of_element(item)
                named, subordinate = xpath("BitDataItem")(item), types.flag(text(item, "@Subordinate"))
                facts = {"offset": str(at), "bits": str(bits), "subordinate": subordinate, **texts.names(item)}
                is_trailer = name.startswith("F_MessageTrailer")
                trailer += bits // 8 if is_trailer else 0
                # For an item that becomes one field of the process image, the type of the field is compared. For any other
                # item, only the name of its type is compared.
                several = named or subordinate or is_trailer or name in types.PAIRS or name == "OctetString_S"
                facts |= {"spelled": name} if several else {"type": ty}
                found[f"{key} item {place}"] = facts
                for bit in named:
                    offset = int(types.number(text(bit, "@BitOffset")))
                    # Numbers are big-endian, so bit 0 is in the last byte.
                    where = (bits // 8 - 1 - offset // 8) * 8 + offset % 8 if ty[0] in "iu" else offset
                    found[f"{key} item {place} bit {at + where}"] = texts.names(bit)
                at += bits
            found[key] = {
                "length": str(at // 8),
                "trailer": str(trailer) if trailer else "",
                "consistent": "yes" if text(data, "@Consistency") == "All items consistency" else "",
            }


def body(found, key, record, texts):
    """Adds the parameters of a record or vendor block. Returns the facts of the whole record or block."""
    for place, ref in enumerate(xpath("Ref")(record)):
        ty, bits = types.of_element(ref)
        bit = types.number(text(ref, "@BitOffset")) if text(ref, "@DataType") in ("Bit", "BitArea") else ""
        offset = 8 * int(types.number(text(ref, "@ByteOffset")) or 0) + int(bit or 0)
        base = "bool" if text(ref, "@DataType") == "Bit" else ty
        raw = ref.get("DefaultValue")
        found[f"{key} ref {place}"] = {
            "type": ty,
            "offset": str(offset),
            "bits": str(bits),
            "default": "" if raw is None else types.default(raw, base),
            "allowed": types.allowed(text(ref, "@AllowedValues"), base),
            "changeable": types.flag(text(ref, "@Changeable"), True),
            "visible": types.flag(text(ref, "@Visible"), True),
            "values": text(ref, "@ValueItemTarget"),
            **texts.names(ref),
        }
    constants = []
    for constant in xpath("Const")(record):
        octets = types.default(text(constant, "@Data"), "octets")
        constants.append(f"{types.number(text(constant, '@ByteOffset')) or '0'}:{octets}")
    return {"constants": " ".join(constants), "name": "", **texts.names(record, "Name/@TextId")}


def records(found, owner, submodule, texts):
    order = lambda record: int(types.number(text(record, "@TransferSequence")) or 0) or 0x10000
    for place, record in enumerate(sorted(xpath("RecordDataList/ParameterRecordDataItem")(submodule), key=order)):
        key = f"{owner} record {place}"
        sequence = types.number(text(record, "@TransferSequence"))
        found[key] = {
            "index": types.number(text(record, "@Index")),
            "length": types.number(text(record, "@Length")),
            "sequence": "" if sequence == "0" else sequence,
            "bump": types.flag(text(record, "@ChangeableWithBump")),
            **body(found, key, record, texts),
        }
    for record in xpath("RecordDataList/F_ParameterRecordDataItem")(submodule):
        found[f"{owner} F"] = {
            "index": types.number(text(record, "@Index")),
            "CRC": types.number(text(record, "@F_ParamDescCRC")),
            "sequence": types.number(text(record, "@TransferSequence")).lstrip("0"),
        }
        for node in record:
            default, allowed, changeable, visible = F_SCHEMA.get(node.tag, ("", "", False, True))
            found[f"{owner} F {node.tag}"] = {
                "default": text(node, "@DefaultValue") or default,
                "allowed": text(node, "@AllowedValues") or allowed,
                "changeable": types.flag(text(node, "@Changeable"), changeable),
                "visible": types.flag(text(node, "@Visible"), visible),
            }


def menus(found, owner, submodule, texts):
    for place, menu in enumerate(xpath("RecordDataList/*/MenuList/MenuItem")(submodule)):
        targets = [text(node, "@ParameterTarget | @MenuTarget") for node in xpath("ParameterRef | MenuRef")(menu)]
        names = texts.names(menu, "Name/@TextId")
        found[f"{owner} menu {place}"] = {"id": text(menu, "@ID"), "targets": " ".join(targets), **names}
