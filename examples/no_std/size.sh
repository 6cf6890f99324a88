#!/usr/bin/env bash
# Prints the sizes in bytes of two programs that use three of a drive's 585 registers. One program uses generated code, and the
# other program uses handwritten code.
set -euo pipefail
cd "$(dirname "$0")"
cargo build --quiet --release
size "${CARGO_TARGET_DIR:-target}"/release/{generated,by_hand}
