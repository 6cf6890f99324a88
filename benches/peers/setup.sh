#!/usr/bin/env bash
# Installs the measured Python and the libraries of requirements.txt into target/python of this folder.
set -euo pipefail
cd "$(dirname "$0")"
mkdir -p target
python3 -m venv target/python
target/python/bin/python -m pip install --quiet --disable-pip-version-check --requirement requirements.txt
