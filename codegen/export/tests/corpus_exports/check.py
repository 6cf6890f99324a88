"""Prints one line of JSON per file, which states whether dcf-tools accepts the file as the EDS of node 5. `strict` is the result
of `dcfchk -n 5`. `lenient` is the result without the list of known keys and sections."""

import json
import sys
import warnings

from dcf.device import Device
from dcf.lint import lint
from dcf.parse import parse_file

warnings.simplefilter("ignore")
for path in sys.argv[1:]:
    verdict = {"strict": False, "lenient": False, "error": ""}
    try:
        cfg = parse_file(path)
        is_known = lint(cfg)
    except Exception as error:  # The library raises an exception if it rejects the file.
        verdict["error"] = repr(error)
        is_known = False
    try:
        Device(parse_file(path), {"NODEID": 5})
        verdict["lenient"] = True
        verdict["strict"] = is_known
    except Exception as error:
        verdict["error"] = repr(error)
    print(json.dumps(verdict))
