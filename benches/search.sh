#!/usr/bin/env bash
# Measures the time of a keystroke in the search of a site: benches/search.sh DESCRIPTION...
# LEXIBUS names the program that writes the site; by default, it is built. cli/tests/browser/README.md lists the requirements.
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
# Skips descriptions with errors.
"$LEXIBUS" docs "$@" --out "$site" 2>/dev/null || true
node benches/search.mjs "$site"
