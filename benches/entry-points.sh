#!/usr/bin/env bash
# Measures the compile time of generated code for different numbers of entries: benches/entry-points.sh [RUNS]
#
# Creates a crate for each entry point (`dictionary!` and `build.rs`) and builds it with EDS files of 36, 990 and 9,999
# entries. Prints the median time of RUNS runs of `cargo check` and `cargo build --release`. The times include generating the
# code, but not compiling the dependencies. The first line is the time for an empty crate.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
runs=${1:-5}
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$root/target}/entry-points CARGO_INCREMENTAL=0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Create the EDS with the same generator as the benchmarks in codegen/benches.
printf '#[allow(dead_code)] #[path = "%s/codegen/benches/inputs/eds.rs"] mod inputs;\n' "$root" > "$work/eds.rs"
echo 'fn main() { print!("{}", inputs::eds(std::env::args().nth(1).unwrap().parse().unwrap())) }' >> "$work/eds.rs"
rustc --edition 2021 -O -o "$work/eds" "$work/eds.rs"

new_crate() { # NAME
    mkdir -p "$work/$1/src"
    printf '[package]\nname = "%s"\nversion = "0.0.0"\nedition = "2021"\n\n[workspace]\n\n[dependencies]\n' "$1" > "$work/$1/Cargo.toml"
    echo '#![no_std]' > "$work/$1/src/lib.rs"
}

new_crate empty
echo "lexibus = { path = \"$root\" }" >> "$work/empty/Cargo.toml"
new_crate macro
echo "lexibus = { path = \"$root\", features = [\"macros\"] }" >> "$work/macro/Cargo.toml"
echo 'lexibus::dictionary! { pub mod bench = "bench.eds"; }' >> "$work/macro/src/lib.rs"
new_crate build-script
printf 'lexibus = { path = "%s" }\n\n[build-dependencies]\nlexibus-codegen = { path = "%s/codegen" }\n' "$root" "$root" \
    >> "$work/build-script/Cargo.toml"
echo 'pub mod bench { include!(concat!(env!("OUT_DIR"), "/bench.rs")); }' >> "$work/build-script/src/lib.rs"
echo 'fn main() -> Result<(), lexibus_codegen::BuildError> { lexibus_codegen::Builder::new().compile("bench.eds") }' \
    > "$work/build-script/build.rs"

median_ms() { # CRATE CARGO-ARGUMENT...
    local folder=$work/$1 start
    shift
    cargo "$@" --quiet --manifest-path "$folder/Cargo.toml" 2>"$work/errors" || { cat "$work/errors" >&2; exit 1; }
    for _ in $(seq "$runs"); do
        touch "$folder/src/lib.rs"
        if [[ -e $folder/bench.eds ]]; then touch "$folder/bench.eds"; fi
        start=$(date +%s%N)
        cargo "$@" --quiet --manifest-path "$folder/Cargo.toml" 2>/dev/null
        echo $((($(date +%s%N) - start) / 1000000))
    done | sort -n | sed -n "$(((runs + 1) / 2))p"
}

row() { # CRATE ENTRIES
    printf '%-14s %6d entries %8d ms check %8d ms release\n' "$1" "$2" "$(median_ms "$1" check)" "$(median_ms "$1" build --release)"
}

row empty 0
for records in 4 110 1111; do
    for entry in macro build-script; do
        "$work/eds" "$records" > "$work/$entry/bench.eds"
        row "$entry" $((records * 9))
    done
done
