"""Loads EDS files with the library `canopen` and prints the result for each file, as one line of JSON.

The arguments are file names. `error` is the reason why a file was not loaded. Each of `entries` is a list: index, sub-index,
data type, access type and default value. The entries are sorted by address.
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
    # Defaults are written as texts, because JSON cannot express infinity.
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
    except Exception as error:  # The library raises an exception if it rejects the file.
        print(json.dumps({"error": f"{type(error).__name__}: {error}"}))
