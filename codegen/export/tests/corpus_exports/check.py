"""Prints, for each file that it is given, whether dcf-tools accepts it as the EDS of node 5: a line of JSON with the
verdict of `dcfchk -n 5` (strict), and of the same without its list of known keys and sections (lenient)."""

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
    except Exception as error:  # Whatever it is, the file isn't accepted.
        verdict["error"] = repr(error)
        is_known = False
    try:
        Device(parse_file(path), {"NODEID": 5})
        verdict["lenient"] = True
        verdict["strict"] = is_known
    except Exception as error:
        verdict["error"] = repr(error)
    print(json.dumps(verdict))
