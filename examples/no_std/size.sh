#!/usr/bin/env bash
# How large a program is that uses three of a drive's 585 registers, and the same written by hand: sizes in bytes.
set -euo pipefail
cd "$(dirname "$0")"
cargo build --quiet --release
size "${CARGO_TARGET_DIR:-target}"/release/{generated,by_hand}
