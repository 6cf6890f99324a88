#!/usr/bin/env bash
# Generates what is checked in: the bindings under generated/src, those whose instructions are counted, and the schema of
# register tables; with --check, compares them instead.
set -euo pipefail
cd "$(dirname "$0")/.."
cargo run --quiet -p lexibus-codegen --features cli -- generate dictionaries/demo-drive.eds --table feature=table \
    --out generated/src/demo_drive.rs "$@"
cargo run --quiet -p lexibus-codegen --features cli -- generate dictionaries/aec-vector-step.toml --table feature=table \
    --out generated/src/vector_step.rs "$@"
cargo run --quiet -p lexibus-codegen --features cli -- generate dictionaries/eco.toml --table feature=table \
    --out generated/src/eco.rs "$@"
cargo run --quiet -p lexibus-codegen --features cli -- generate benches/instructions/axis.esi.xml -A warnings \
    --out benches/instructions/src/axis.rs "$@"
cargo run --quiet -p lexibus-codegen --features cli -- generate tests/data/drive.gsdml.xml \
    --out benches/instructions/src/station.rs "$@"
cargo run --quiet -p lexibus-codegen --features cli -- schema --out dictionaries/table.schema.json "$@"
