#!/usr/bin/env bash
# Updates the generated files in the repository: the bindings in generated/src and benches/instructions, the schema of register
# tables, the profiles in the compiler and in the runtime, and the book's catalog of diagnostics. With --check, only checks that the
# files other than the profiles are up to date. Set `$LEXIBUS` to use an existing compiler; the script then does not update the profiles.
set -euo pipefail
cd "$(dirname "$0")/.."
lexibus() {
    if [[ -n ${LEXIBUS:-} ]]; then "$LEXIBUS" "$@"; else cargo run --quiet -p lexibus-cli -- "$@"; fi
}
# Unit tests of the compiler write the files that are embedded in the compiler (the schema and the profiles), and the profiles in
# the runtime. The latter depend on the embedded profiles, so they are written by a second run.
if [[ ${1:-} != --check && -z ${LEXIBUS:-} ]]; then
    LEXIBUS_BLESS=1 cargo test --quiet -p lexibus-codegen --lib -- frontend::table::schema resolve::profiles::stored
    LEXIBUS_BLESS=1 cargo test --quiet -p lexibus-codegen --lib -- backend::rust::profiles
fi
lexibus generate dictionaries/demo-drive.eds --table feature=table \
    --out generated/src/demo_drive.rs "$@"
lexibus generate dictionaries/aec-vector-step.toml --table feature=table \
    --out generated/src/vector_step.rs "$@"
lexibus generate dictionaries/kollmorgen-akd.toml --table feature=table \
    --out generated/src/akd.rs "$@"
lexibus generate dictionaries/hsd-sm137-sm140.toml --table feature=table \
    --out generated/src/hsd.rs "$@"
lexibus generate dictionaries/eco.toml --table feature=table \
    --out generated/src/eco.rs "$@"
lexibus generate benches/instructions/axis.esi.xml -A warnings \
    --out benches/instructions/src/axis.rs "$@"
lexibus generate tests/data/drive.gsdml.xml \
    --out benches/instructions/src/station.rs "$@"
lexibus schema --out dictionaries/table.schema.json "$@"
catalog=$(lexibus explain --format markdown)
if [[ ${1:-} == --check ]]; then
    diff docs/src/lints.md <(echo "$catalog") || { echo "docs/src/lints.md is stale: run tests/bindings.sh"; exit 1; }
else
    echo "$catalog" >docs/src/lints.md
fi
