#!/usr/bin/env bash
# Creates a virtual environment in target/python for the Python scripts of these tests. requirements.txt lists the
# libraries and their versions. If the libraries are already installed, the script does nothing.
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
