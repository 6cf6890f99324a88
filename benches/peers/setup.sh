#!/usr/bin/env bash
# Creates a Python environment in the folder target/python next to this script. Installs the libraries that requirements.txt lists
# in this environment. The benchmark measures these libraries.
set -euo pipefail
cd "$(dirname "$0")"
mkdir -p target
python3 -m venv target/python
target/python/bin/python -m pip install --quiet --disable-pip-version-check --requirement requirements.txt
