#!/usr/bin/env bash
# Compares the public API of the runtime, with all features, with the snapshot tests/api/lexibus.txt. Needs `cargo-public-api` and the
# nightly toolchain, which writes rustdoc JSON. Without them, the check is skipped with a message. To install them:
#
#     cargo install --locked cargo-public-api
#     rustup toolchain install nightly --profile minimal
#
#     tests/api.sh            # compare
#     tests/api.sh --bless    # write the snapshot after an intended change
set -euo pipefail
cd "$(dirname "$0")/.."
snapshot=tests/api/lexibus.txt
new=${CARGO_TARGET_DIR:-$PWD/target}/api.txt
if ! cargo public-api --version >/dev/null 2>&1 || ! cargo +nightly --version >/dev/null 2>&1; then
    echo "skipped: cargo-public-api or the nightly toolchain is not installed"
    exit
fi
cargo +nightly public-api -p lexibus --all-features -sss >"$new"
# If the list has at most 1000 lines, the tool does not understand the format of the rustdoc JSON.
(($(wc -l <"$new") > 1000)) || { echo "cargo-public-api printed only $(wc -l <"$new") lines"; exit 1; }
if [[ ${1:-} == --bless ]]; then
    cp "$new" "$snapshot"
elif ! diff -u "$snapshot" "$new"; then
    echo "the public API of the runtime differs: review the difference, and run tests/api.sh --bless if it is intended"
    exit 1
fi
