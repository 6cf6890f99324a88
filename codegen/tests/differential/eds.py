"""Reads EDS and DCF files with the library `canopen` and prints the facts that it has of each: one JSON object a line.

Called with the names of files. `elements` are facts by name, by element: `device`, `1018`, `1018:01`. What a file doesn't
say is no fact. `error` is why the library rejects a file; one whose bytes are no UTF-8 is then read as Windows-1252.
"""

import json
import logging
import sys

import canopen
from canopen.objectdictionary import ODArray, ODRecord, ODVariable, datatypes

logging.disable(logging.CRITICAL)

# The node-ID where the file gives the device none.
NODE_ID = 5


def value(value, data_type):
    """A value with its kind: a number, a 'text', or x'octets'."""
    if isinstance(value, (bytes, bytearray)):
        return f"x'{value.hex()}'" if value else None
    if isinstance(value, str):
        return f"'{value}'" if value else None
    if value is not None and data_type in datatypes.FLOAT_TYPES:
        mantissa, exponent = f"{float(value):.16e}".split("e")
        return f"{mantissa}e{int(exponent)}"
    return None if value is None else str(value)


def variable(own):
    return {
        "name": own.name,
        "type": str(own.data_type),
        "access": own.access_type,
        "mappable": "yes" if own.pdo_mappable else None,
        "default": value(own.default, own.data_type),
        "relative": "yes" if own.relative else None,
        "value": value(own.value, own.data_type),
        "low": value(own.min, own.data_type),
        "high": value(own.max, own.data_type),
        "unit": own.unit,
        "factor": None if own.factor == 1 else value(own.factor, datatypes.REAL64),
        "description": own.description,
        "storage": own.storage_location,
    }


def device(dictionary):
    own = dictionary.device_information
    number = lambda value: None if value is None else str(value)
    flag = lambda value: "yes" if value else None
    return {
        "vendor name": own.vendor_name,
        "vendor number": number(own.vendor_number),
        "product name": own.product_name,
        "product number": number(own.product_number),
        "revision number": number(own.revision_number),
        "order code": own.order_code,
        "boot-up master": flag(own.simple_boot_up_master),
        "boot-up slave": flag(own.simple_boot_up_slave),
        "granularity": number(None if own.granularity is None else int(own.granularity)),
        "dynamic channels": flag(own.dynamic_channels_supported),
        "group messaging": flag(own.group_messaging),
        "RPDOs": number(own.nr_of_RXPDO),
        "TPDOs": number(own.nr_of_TXPDO),
        "LSS": flag(own.LSS_supported),
        "bit rates": " ".join(str(rate // 1000) for rate in sorted(own.allowed_baudrates)),
        "bit rate": number(dictionary.bitrate and dictionary.bitrate // 1000),
        "comments": dictionary.comments.rstrip(),
    }


def elements(dictionary, node_id):
    facts = device(dictionary)
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
        # An object has a storage location of its own here, its value one above.
        found[f"{index:04X}"] = {"kind": kind, "name": thing.name, "storage": thing.storage_location}
        for sub, own in thing.subindices.items():
            found[f"{index:04X}:{sub:02X}"] = variable(own)
    facts["dummies"] = " ".join(dummies)
    return {name: {key: fact for key, fact in facts.items() if fact} for name, facts in found.items()}


def load(path, encoding=None):
    """The dictionary, and the node-ID that the file gives."""
    source = open(path, encoding=encoding) if encoding else path
    if b"DeviceComissioning" in open(path, "rb").read():
        dictionary = canopen.import_od(source)
        if dictionary.node_id is not None:
            return dictionary, dictionary.node_id
        source = open(path, encoding=encoding) if encoding else path
    return canopen.import_od(source, NODE_ID), None


for path in sys.argv[1:]:
    answer = {}
    try:
        answer["elements"] = elements(*load(path))
    except Exception as error:  # Whatever goes wrong within the library is its answer.
        answer["error"] = f"{type(error).__name__}: {error}".split("\n")[0].replace(path, "the file")
        if isinstance(error, UnicodeDecodeError):
            answer["elements"] = elements(*load(path, "cp1252"))
    print(json.dumps(answer))
