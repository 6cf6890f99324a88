"""Reads the objects of an ETG.2000 dictionary."""

from esi_types import Types, flag, language, name, names, number, values
from reading import text, xpath


def flags(node, above, sub):
    """Returns the flags of a sub-item, such as access and mapping. Flags that the sub-item does not have come from its object."""
    mapping = text((node or above or [None])[0], "PdoMapping") if node or (above and sub) else ""
    nearest = lambda path: next((found for flags in (node, above) if flags and (found := text(flags[0], path))), "")
    letters = mapping.upper()
    return {
        "access": nearest("Access"),
        "mapping": letters if letters in ("R", "T", "RT", "TR", "") else "?" + mapping,
        "backup": flag(nearest("Backup")),
        "setting": flag(nearest("Setting")),
        "safety": nearest("SafetyMapping").lower(),
        "readable in": nearest("Access/@ReadRestrictions").replace("_", " "),
        "writable in": nearest("Access/@WriteRestrictions").replace("_", " "),
    }


def display(element, path, called):
    """Returns the display names that differ from the name `called`, by language."""
    texts = [node for node in xpath(path)(element) if text(node) and text(node) != called]
    return {f"name {language(node)}": text(node) for node in texts}


def entries(types, fields):
    """Returns the entries of a record: sub-index, type, field, and the number of the array element if the field is an array."""
    following = 0
    for field in fields:
        name = text(field, "Type")
        declared = number(text(field, "SubIdx"))
        array = types.array(name)
        if array and not declared:
            first = max(array[0], following)
            for at in range(array[1]):
                yield first + at, types.resolve(array[2]), field, at + 1
            following = first + array[1]
        else:
            following = int(declared) if declared.isdigit() else following
            yield following, types.resolve(name), field, None
            following += 1


def items(types, thing, fields):
    """Returns the sub-indices of an object with their facts, which come from the object and from its type."""
    subs = xpath("Info/SubItem")(thing)
    found = list(entries(types, fields))
    above = xpath("Flags")(thing)
    free = list(subs)
    for at, (sub_index, ty, field, element) in enumerate(found):
        field_name = text(field, "Name")
        if len(subs) == len(found):
            sub = subs[at]
        else:
            sub = next((sub for sub in free if text(sub, "Name") == field_name and element in (None, 1)), None)
        if sub is not None and sub in free:
            free.remove(sub)
        called = (text(sub, "Name") if sub is not None else "") or (f"{field_name} {element}" if element else field_name)
        infos = ([] if sub is None else xpath("Info")(sub) or [sub]) + [field]
        facts = {"name": called, "type": ty, **flags(xpath("Flags")(field), above, sub_index)}
        if sub is not None:
            facts |= display(sub, "DisplayName | Info/DisplayName", called)
        facts |= display(field, "DisplayName", called)
        yield sub_index, facts | names(field, "Comment", "comment") | values(infos, ty)


def data_types(found, owner, dictionaries, types):
    """Adds the data types of the dictionaries in file order."""
    for at, node in enumerate(node for one in dictionaries for node in xpath("DataTypes/DataType")(one)):
        facts = {"name": text(node, "Name"), "bits": number(text(node, "BitSize")), **names(node, "Comment", "comment")}
        if xpath("ArrayInfo")(node) and types.by_name.get(facts["name"]) is node:
            facts["array"] = types.resolve(facts["name"])
        for value in xpath("EnumInfo")(node):
            facts |= names(value, "Text", "value " + number(text(value, "Enum")))
        found[f"{owner} type {at}"] = facts
        for place, field in enumerate(xpath("SubItem")(node)):
            found[f"{owner} type {at} field {place}"] = {
                "name": text(field, "Name"),
                "sub-index": number(text(field, "SubIdx")),
                "bits": number(text(field, "BitSize")),
                "offset": number(text(field, "BitOffs")),
            }


def objects(found, owner, dictionaries):
    types = Types(dictionaries[0]) if dictionaries else None
    for other in dictionaries[1:]:
        types.add(Types(other))
    data_types(found, owner, dictionaries, types)
    for thing in (thing for node in dictionaries for thing in xpath("Objects/Object")(node)):
        index = number(text(thing, "Index"))
        index = f"{int(index):04X}" if index.isdigit() else index
        key = f"{owner} object {index}"
        if key in found:
            found[f"{key} again"] = {"name": name(thing)}
            continue
        found[key] = {
            **names(thing),
            **names(thing, "Comment", "comment"),
            "category": text(thing, "Flags/Category").lower(),
            "by slot": flag(text(thing, "Index/@DependOnSlot")),
        }
        fields = types.record(text(thing, "Type"))
        if fields is None:
            ty = types.resolve(text(thing, "Type"))
            access = flags(xpath("Flags")(thing), None, 0)
            called = display(thing, "Info/DisplayName", name(thing))
            called = {"name": name(thing), **called} if called else names(thing)
            facts = {**called, "type": ty, "bits": number(text(thing, "BitSize")), **access}
            found[f"{key}:00"] = facts | values(xpath("Info")(thing), ty)
            continue
        for sub, facts in items(types, thing, fields):
            where = f"{key}:{sub:02X}"
            found[where if where not in found else f"{where} again"] = facts
    return types
