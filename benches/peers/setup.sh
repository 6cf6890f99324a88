#!/usr/bin/env bash
# Puts the Python that is measured into target/python of this folder, with the libraries of requirements.txt.
set -euo pipefail
cd "$(dirname "$0")"
mkdir -p target
python3 -m venv target/python
target/python/bin/python -m pip install --quiet --disable-pip-version-check --requirement requirements.txt
