#!/usr/bin/env bash
# How long the search of a site takes for a key stroke: benches/search.sh DESCRIPTION...
# LEXIBUS names the program that writes the site; else it is built. cli/tests/browser/README.md says what is needed.
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
# Descriptions with errors are left out.
"$LEXIBUS" docs "$@" --out "$site" 2>/dev/null || true
node benches/search.mjs "$site"
