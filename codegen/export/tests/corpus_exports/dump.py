"""Loads EDS files with the library `canopen` and prints what it made of each: one JSON object a line.

Called with the names of files. `error` is why a file wasn't loaded; `entries` are [index, sub-index, data type, access,
default] in the order of the addresses.
"""

import json
import logging
import sys

import canopen
from canopen.objectdictionary import ODVariable

logging.disable(logging.CRITICAL)


def entry(variable):
    default = variable.default
    if isinstance(default, (bytes, bytearray)):
        default = default.hex()
    # JSON has no infinity; a number is told by its digits.
    default = None if default is None else str(default)
    return [variable.index, variable.subindex, variable.data_type, variable.access_type, default]


def entries(dictionary):
    for thing in dictionary.values():
        if isinstance(thing, ODVariable):
            yield entry(thing)
        else:
            for variable in thing.values():
                yield entry(variable)


for path in sys.argv[1:]:
    try:
        loaded = sorted(entries(canopen.import_od(path, node_id=5)), key=lambda entry: entry[:2])
        print(json.dumps({"entries": loaded}))
    except Exception as error:  # Whatever goes wrong within the library is its answer.
        print(json.dumps({"error": f"{type(error).__name__}: {error}"}))
