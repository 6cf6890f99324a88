#!/usr/bin/env bash
# Measures the elapsed time and the processor time that the search of a site needs after a keystroke: benches/search.sh DESCRIPTION... Set LEXIBUS to
# the program that writes the site; otherwise, the script builds it. cli/tests/browser/README.md lists the requirements.
set -euo pipefail
cd "$(dirname "$0")/.."
if [[ $# == 0 ]]; then echo "benches/search.sh DESCRIPTION..." >&2; exit 2; fi

cli/tests/browser/setup.sh
site=target/browser/search
rm -rf "$site"
if [[ -z ${LEXIBUS:-} ]]; then
    cargo build --quiet --release -p lexibus-cli
    LEXIBUS=${CARGO_TARGET_DIR:-target}/release/lexibus
fi
# Ignore the exit code: descriptions with errors are left out of the site.
"$LEXIBUS" docs "$@" --out "$site" 2>/dev/null || true
node benches/search.mjs "$site"
node benches/speed.mjs "$site"
