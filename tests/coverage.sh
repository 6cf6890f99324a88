#!/usr/bin/env bash
# Measures line coverage: tests/coverage.sh [DETAILS.json]. Requires `cargo llvm-cov` and the LLVM tools of the toolchain
# (`rustup component add llvm-tools`, or LLVM_COV and LLVM_PROFDATA). Takes about an hour. tests/COVERAGE.md contains the
# latest result.
set -euo pipefail
cd "$(dirname "$0")/.."
export CARGO_INCREMENTAL=0 LEXIBUS_LANE=full
# All programs that the tests start share four profile files. With one profile file per process, the programs would write
# thousands of files.
export LLVM_PROFILE_FILE_NAME='lexibus-%4m.profraw'
python=${LEXIBUS_PYTHON:-$PWD/target/python/bin/python}
if "$python" -c 'import canopen, lxml' 2>/dev/null; then export LEXIBUS_PYTHON=$python; fi

# Skip tests that compile other crates or that measure size, instructions or messages. Coverage counters would change the
# results of such tests.
cargo llvm-cov test --no-report --workspace --all-features --no-fail-fast -- \
    --skip compile_fail --skip generated_code_costs --skip what_is_not_used --skip both_programs

# Exclude generated crates, because they are output of the compiler.
crates=(lexibus lexibus-codegen lexibus-export lexibus-import lexibus-site lexibus-device lexibus-cli lexibus-macros)
printf '%-18s %8s %8s %8s\n' crate lines missed covered
for crate in "${crates[@]}"; do
    read -r lines missed covered < <(cargo llvm-cov report -p "$crate" --summary-only 2>/dev/null | awk '$1 == "TOTAL" { print $8, $9, $10 }')
    printf '%-18s %8s %8s %8s\n' "$crate" "$lines" "$missed" "$covered"
done
if [[ -n ${1:-} ]]; then cargo llvm-cov report $(printf -- '-p %s ' "${crates[@]}") --json --output-path "$1"; fi
