#!/usr/bin/env bash
# Generates the bindings that are checked in under generated/src; with --check, compares them instead.
set -euo pipefail
cd "$(dirname "$0")/.."
cargo run --quiet -p lexibus-codegen --features cli -- generate dictionaries/demo-drive.eds --table feature=table \
    --out generated/src/demo_drive.rs "$@"
