#!/usr/bin/env bash
# Installs the programs that tests use in addition to Cargo: Python with canopen, pymodbus, dcf-tools, cantools, jsonschema and lxml; valgrind; Chromium with
# playwright-core. Writes the environment variables of these programs to target/programs.env. Reports the programs that cannot be
# installed.
set -uo pipefail
cd "$(dirname "$0")/.."
mkdir -p target
: >target/programs.env

missing=()
command -v valgrind >/dev/null || missing+=(valgrind)
command -v chromium >/dev/null || missing+=(chromium)
command -v node >/dev/null && command -v npm >/dev/null || missing+=(nodejs npm)
if ((${#missing[@]})) && command -v apt-get >/dev/null; then
    { apt-get update --quiet && apt-get install --yes --quiet --no-install-recommends "${missing[@]}"; } >/dev/null 2>&1
fi
command -v valgrind >/dev/null || echo "no valgrind: the tests that count instructions are skipped"

if tests/interop/setup.sh >/dev/null; then
    echo "export LEXIBUS_PYTHON=$PWD/target/python/bin/python" >>target/programs.env
else
    echo "no Python with canopen, pymodbus, dcf-tools, cantools, jsonschema and lxml: the tests against them are skipped, and nothing is validated by schema"
fi
# If a browser is available, LEXIBUS_BROWSER makes a skipped browser test an error.
if cli/tests/browser/setup.sh >/dev/null; then
    echo "export LEXIBUS_BROWSER=required" >>target/programs.env
else
    echo "no Chromium, or no playwright-core: the site is not opened in a browser"
fi
