"""Loads EDS files with the library `canopen` and prints the result for each file, as one line of JSON.

The arguments are file names. `error` is the reason why a file was not loaded. `entries` are [index, sub-index,
data type, access, default], sorted by address.
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
    # JSON has no infinity, so numbers are texts.
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
    except Exception as error:  # Any exception of the library is its result.
        print(json.dumps({"error": f"{type(error).__name__}: {error}"}))
