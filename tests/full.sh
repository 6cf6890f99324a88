#!/usr/bin/env bash
# Runs the full lane: all tests with the whole corpus. Continues after a failure. At the end, prints a table with the result and
# the duration of each part.
#
#     tests/full.sh                   # all parts
#     tests/full.sh clippy browser    # only the given parts
#     tests/full.sh --list            # print the names of the parts
#     tests/full.sh coverage          # not part of a full run: takes an hour
#
# Logs are written to target/full. Parts that need the corpus are skipped with a message if ../shared is absent.
set -uo pipefail
cd "$(dirname "$0")/.."
export CARGO_TERM_COLOR=never CARGO_INCREMENTAL=0 LEXIBUS_LANE=full
target=${CARGO_TARGET_DIR:-target}
logs=$target/full

parts=(programs format clippy features outside packages api msrv dependencies rustdoc build sample bindings units doctests ui corpus generated packing \
    differential arbitrary mutations nested site browser book pages rest examples)

# Names of test programs for `cargo test --test`. Each test program of the workspace belongs to one part. The part `rest` runs the
# programs that are not listed.
ui=(ui)
corpus=(corpus corpus_exports frozen)
generated=(rust)
packing=(packing)
differential=(differential dcfgen dbc)
arbitrary=(arbitrary)
mutations=(corpus_mutations exports)
nested=(compile_fail drive_crate instructions new_crate new_front_end no_std_size)
site=(docs)
pages=(html drives)
browser=(browser)
book=(book)

tests() {
    local names=() name
    for name in "$@"; do names+=(--test "$name"); done
    cargo test --no-fail-fast --all-features "${names[@]}"
}

part_programs() { tests/programs.sh; }
part_format() { cargo fmt --all --check; }
part_clippy() { cargo clippy --quiet --workspace --all-targets --all-features -- -D warnings; }
# Each feature of the runtime must compile without the other features.
part_features() {
    local features failed=0
    for features in "" std canopen socketcan socketcan-tokio ethercat modbus serial macros serde,defmt; do
        echo "features: $features"
        cargo check --quiet -p lexibus --no-default-features --features "$features" || failed=1
    done
    # Each front end of the compiler must compile without the other front ends. The test `features` checks the errors for formats
    # whose front end is missing.
    for features in "" eds xdd esi gsdml table messages eds,table; do
        echo "front ends: $features"
        cargo check --quiet -p lexibus-codegen --no-default-features --features "$features" || failed=1
        cargo test --quiet -p lexibus-codegen --no-default-features --features "$features" --test features || failed=1
    done
    # Each bus must compile without the other buses, and the command line without any bus.
    for features in "" modbus slcan socketcan; do
        echo "buses: $features"
        cargo check --quiet -p lexibus-device --no-default-features --features "$features" || failed=1
    done
    cargo check --quiet -p lexibus-cli --no-default-features || failed=1
    return $failed
}
# Checks crates outside the workspace, which need a C++ compiler or the newest Rust. Tests the CANopen client with `zencan-node`.
part_outside() {
    local crate failed=0
    for crate in codegen/fuzz benches/packing benches/peers tests/zencan; do
        echo "crate: $crate"
        if ! { command -v c++ >/dev/null && cargo fetch --quiet --manifest-path "$crate/Cargo.toml"; }; then
            echo "skipped: its dependencies cannot be fetched, or there is no C++ compiler"
            continue
        fi
        cargo check --quiet --all-targets --manifest-path "$crate/Cargo.toml" --target-dir "$target/apart" || failed=1
        if [[ $crate == tests/* ]]; then
            cargo test --quiet --manifest-path "$crate/Cargo.toml" --target-dir "$target/apart" || failed=1
        fi
        # Detect outdated lock files, which Cargo rewrites.
        git diff --exit-code -- "$crate/Cargo.lock" || failed=1
    done
    return $failed
}
# Packages all crates as for crates.io, and builds crates that use the packages.
part_packages() { CARGO_TARGET_DIR=$(realpath "$target") tests/packages.sh; }
# Compares the public API of the runtime with its snapshot. `tests/api.sh --bless` writes the snapshot.
part_api() { CARGO_TARGET_DIR=$(realpath "$target") tests/api.sh; }
# Checks the minimum Rust versions of the runtime whose toolchains are installed.
part_msrv() { CARGO_TARGET_DIR=$(realpath "$target") tests/msrv.sh; }
# Checks the licenses of all dependencies, and that tests/duplicates.txt lists those that are compiled in several versions.
part_dependencies() { tests/dependencies.py; }
part_rustdoc() {
    RUSTDOCFLAGS='-D warnings' cargo doc --quiet --workspace --all-features --no-deps --lib --bins --examples
}
part_sample() { tests/corpus-sample.py "$target/debug/lexibus" --check; }
# The compiler must be compiled only once for macros, tests and programs.
part_build() {
    local builds
    builds=$(cargo test --all-features --no-run --message-format json | grep -c '"reason":"compiler-artifact".*"name":"lexibus_codegen".*"test":false')
    echo "the compiler is compiled $builds times"
    ((builds == 1))
}
part_bindings() { LEXIBUS=$target/debug/lexibus tests/bindings.sh --check; }
part_units() { cargo test --no-fail-fast --all-features --lib --bins; }
part_ui() { tests "${ui[@]}"; }
part_doctests() { cargo test --no-fail-fast --all-features --doc; }
part_corpus() { tests "${corpus[@]}"; }
part_generated() { tests "${generated[@]}"; }
part_packing() { tests "${packing[@]}"; }
part_differential() { tests "${differential[@]}"; }
part_arbitrary() { tests "${arbitrary[@]}"; }
part_mutations() { tests "${mutations[@]}"; }
part_nested() { tests "${nested[@]}"; }
part_site() { tests "${site[@]}"; }
part_browser() { tests "${browser[@]}"; }
part_book() { tests "${book[@]}"; }
# Checks the book after building it with mdBook.
part_pages() { cargo test --no-fail-fast -p lexibus-book-pages; }
# Runs all test programs that are not listed in another part.
part_rest() {
    local named=" ${ui[*]} ${corpus[*]} ${generated[*]} ${packing[*]} ${differential[*]} ${arbitrary[*]} ${mutations[*]} ${nested[*]} ${site[*]} ${browser[*]} ${book[*]} ${pages[*]} "
    local all rest=() name
    all=$(cargo metadata --no-deps --format-version 1 |
        python3 -c 'import json, sys; print("\n".join(sorted({target["name"] for package in json.load(sys.stdin)["packages"] for target in package["targets"] if "test" in target["kind"]})))')
    for name in $all; do [[ $named == *" $name "* ]] || rest+=("$name"); done
    tests "${rest[@]}"
}
# For each bus, runs an example with a simulated device.
part_examples() {
    local example failed=0
    cargo build --quiet --all-features --examples || return 1
    for example in canopen ethercat modbus profinet serial; do timeout 60 "$target/debug/examples/$example" || failed=1; done
    return $failed
}
part_coverage() { tests/coverage.sh; }

case ${1:-} in
--list) printf '%s\n' "${parts[@]}" coverage; exit ;;
-*) sed -n '2,9p' "$0"; exit 2 ;;
esac
chosen=("$@")
if ((${#chosen[@]} == 0)); then chosen=("${parts[@]}"); fi
for part in "${chosen[@]}"; do
    if ! declare -F "part_$part" >/dev/null; then echo "there is no part $part: tests/full.sh --list" >&2; exit 2; fi
done

mkdir -p "$logs"
table=() failed=0
for part in "${chosen[@]}"; do
    # shellcheck source=/dev/null
    if [[ -f $target/programs.env ]]; then source "$target/programs.env"; fi
    start=$SECONDS
    printf '== %s\n' "$part"
    if "part_$part" >"$logs/$part.log" 2>&1; then result=ok; else result=FAILED failed=1; fi
    passed=$(awk '/^test result:/ { sum += $4 } END { print sum + 0 }' "$logs/$part.log")
    grep -hE '^(test .* FAILED|error)' "$logs/$part.log" | head -n 20
    table+=("$(printf '%-14s %-7s %6d s %6d tests' "$part" "$result" $((SECONDS - start)) "$passed")")
done
printf '\n%-14s %-7s %8s %12s\n' part result time passed
printf '%s\n' "${table[@]}"
printf '%-14s %-7s %6d s\n' all "$( ((failed)) && echo FAILED || echo ok)" "$SECONDS"
exit $failed
