"""Reads EDS and DCF files with the library `canopen` and prints the facts of each file as one line of JSON.

The arguments are file names. `elements` maps the name of an element (`device`, `1018`, `1018:01`) to its facts, and each fact has a
name. Missing facts are left out. `errors` lists the reasons why the library rejects the file. If the script knows the cause of an
error, it repairs the text and loads it again.
"""

import functools
import io
import json
import logging
import re
import sys
from configparser import DuplicateOptionError, DuplicateSectionError, RawConfigParser

import canopen
from canopen.objectdictionary import ODArray, ODRecord, ODVariable, datatypes, eds

logging.disable(logging.CRITICAL)

# Node-ID for files that do not contain one.
NODE_ID = 5


def value(value, data_type):
    """Formats a value as a number, a 'text', or x'octets'."""
    if isinstance(value, (bytes, bytearray)):
        return f"x'{value.hex()}'" if value else None
    if isinstance(value, str):
        return f"'{value}'" if value else None
    if value is not None and data_type in datatypes.FLOAT_TYPES:
        mantissa, exponent = f"{float(value):.16e}".split("e")
        return f"{mantissa}e{int(exponent)}"
    return None if value is None else str(value)


def variable(entry):
    return {
        "name": entry.name,
        "type": str(entry.data_type),
        "access": entry.access_type,
        "mappable": "yes" if entry.pdo_mappable else None,
        "default": value(entry.default, entry.data_type),
        "relative": "yes" if entry.relative else None,
        "value": value(entry.value, entry.data_type),
        "low": value(entry.min, entry.data_type),
        "high": value(entry.max, entry.data_type),
        "unit": entry.unit,
        "factor": None if entry.factor == 1 else value(entry.factor, datatypes.REAL64),
        "description": entry.description,
        "storage": entry.storage_location,
    }


def device(dictionary):
    entry = dictionary.device_information
    number = lambda value: None if value is None else str(value)
    flag = lambda value: "yes" if value else None
    return {
        "vendor name": entry.vendor_name,
        "vendor number": number(entry.vendor_number),
        "product name": entry.product_name,
        "product number": number(entry.product_number),
        "revision number": number(entry.revision_number),
        "order code": entry.order_code,
        "boot-up master": flag(entry.simple_boot_up_master),
        "boot-up slave": flag(entry.simple_boot_up_slave),
        "granularity": number(None if entry.granularity is None else int(entry.granularity)),
        "dynamic channels": flag(entry.dynamic_channels_supported),
        "group messaging": flag(entry.group_messaging),
        "RPDOs": number(entry.nr_of_RXPDO),
        "TPDOs": number(entry.nr_of_TXPDO),
        "LSS": flag(entry.LSS_supported),
        "bit rates": " ".join(str(rate // 1000) for rate in sorted(entry.allowed_baudrates)),
        "bit rate": number(dictionary.bitrate and dictionary.bitrate // 1000),
        "comments": dictionary.comments.rstrip(),
    }


# The keys that CiA 306 defines for [FileInfo].
FILE_INFO = (
    "FileName FileVersion FileRevision EDSVersion Description CreationTime CreationDate CreatedBy ModificationTime "
    "ModificationDate ModifiedBy LastEDS"
).split()


def elements(dictionary, node_id):
    facts = device(dictionary)
    header = getattr(dictionary, "__edsFileInfo", {})
    facts |= {key: header.get(key) for key in FILE_INFO}
    facts["node-ID"] = None if node_id is None else str(node_id)
    dummies = []
    found = {"device": facts}
    for index, thing in sorted(dictionary.indices.items()):
        if isinstance(thing, ODVariable):
            if thing.name == f"Dummy{index:04d}":
                dummies.append(str(index))
                continue
            found[f"{index:04X}"] = {"kind": "value", "name": thing.name}
            found[f"{index:04X}:00"] = variable(thing)
            continue
        kind = "array" if isinstance(thing, ODArray) else "record"
        assert kind == "array" or isinstance(thing, ODRecord)
        # An array or record has a separate storage location. For a single value, `variable` returns the storage location.
        found[f"{index:04X}"] = {"kind": kind, "name": thing.name, "storage": thing.storage_location}
        for sub, entry in thing.subindices.items():
            found[f"{index:04X}:{sub:02X}"] = variable(entry)
    facts["dummies"] = " ".join(dummies)
    return {name: {key: fact for key, fact in facts.items() if fact} for name, facts in found.items()}


def load(text, path, strict):
    """Returns the object dictionary, and the node-ID if the file contains one."""

    def source():
        file = io.StringIO(text)
        file.name = path
        return file

    eds.RawConfigParser = functools.partial(RawConfigParser, strict=strict)
    if "DeviceComissioning" in text:
        dictionary = canopen.import_od(source())
        if dictionary.node_id is not None:
            return dictionary, dictionary.node_id
    return canopen.import_od(source(), NODE_ID), None


def repaired(text, error):
    """Returns the text without the cause of an error. Returns the text unchanged if the cause is unknown."""
    message = str(error)
    if found := re.match(r"No option '((?:Dummy|Line)\d+)' in section: '(\w+)'", message):
        value = "0" if found[1].startswith("Dummy") else ""
        return text.replace(f"[{found[2]}]", f"[{found[2]}]\n{found[1]}={value}", 1)
    if not (found := re.match(r"invalid literal for int\(\) with base 0: '(.*)'", message)):
        return text
    if not found[1]:
        return re.sub(r"(?m)^(ObjectType|VendorNumber|ProductNumber|RevisionNumber)=[ \t]*$", "", text)
    if " #" in found[1]:
        return re.sub(r"(?m)^((?!ParameterName)\w+ *=[^#\n]*?)[ \t]+#.*$", r"\1", text)
    return re.sub(rf"(?m)=0+({found[1].lstrip('0')})$", r"=\1", text)


def answer(path):
    """Returns the errors and the facts of a file. Repairs the text of the file as long as this removes an error."""
    errors, text, strict = [], "", True
    try:
        if not path.lower().endswith((".eds", ".dcf")):
            canopen.import_od(path)
        text = open(path).read()
    except Exception as error:  # The library raises an exception if it rejects the file.
        errors.append(error)
        if not isinstance(error, UnicodeDecodeError):
            return errors, None
        text = open(path, encoding="cp1252").read()
    while True:
        try:
            return errors, elements(*load(text, path, strict))
        except Exception as error:
            duplicate = isinstance(error, (DuplicateOptionError, DuplicateSectionError))
            before, was_strict = text, strict
            text, strict = repaired(text, error), strict and not duplicate
            if not errors or str(errors[-1])[:30] != str(error)[:30]:
                errors.append(error)
            if (text, strict) == (before, was_strict):
                return errors, None


for path in sys.argv[1:]:
    errors, found = answer(path)
    errors = [f"{type(error).__name__}: {error}".split("\n")[0].replace(path, "the file") for error in errors]
    print(json.dumps({"errors": errors, "elements": found}))
