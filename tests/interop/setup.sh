#!/usr/bin/env bash
# Puts the Python that the tests in this folder talk to into target/python, with the libraries of requirements.txt in
# the versions that are pinned there. Does nothing where all of them are there already.
set -euo pipefail
cd "$(dirname "$0")/../.."
python=target/python/bin/python
requirements=tests/interop/requirements.txt

complete() {
    [[ -x $python ]] && "$python" - "$requirements" <<'PYTHON'
import re
import sys
from importlib.metadata import PackageNotFoundError, version

try:
    for name, wanted in re.findall(r"^([\w-]+)==(\S+)", open(sys.argv[1]).read(), re.MULTILINE):
        if version(name) != wanted:
            sys.exit(1)
except PackageNotFoundError:
    sys.exit(1)
PYTHON
}

complete && exit
mkdir -p target
python3 -m venv target/python
"$python" -m pip install --quiet --disable-pip-version-check --requirement "$requirements"
complete
