#!/usr/bin/env bash
# Measures how long rustc needs per entry of generated bindings: benches/compile-time.sh [DESCRIPTION [RUNS]]
#
# If no description is given, the script creates an EDS with 9,999 entries. The script then prints the median time of
# RUNS runs of `rustc --emit=metadata`, minus the time for an empty crate. The script measures bindings with handles
# only, with handles and accessors, and with handles, accessors and PDO structs.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
input=${1:-}
runs=${2:-7}
target=${CARGO_TARGET_DIR:-target}
cargo build --quiet --release -p lexibus-cli
# Ask Cargo for the path of the runtime, because the target folder also contains the runtime built for the command line, which has
# more features.
runtime=$(cargo check --quiet --release -p lexibus --message-format json | grep -o '"[^"]*/liblexibus-[^"]*\.rmeta"' | tail -n 1 | tr -d '"')
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [[ -z $input ]]; then
    printf '#[allow(dead_code)] #[path = "%s/codegen/benches/inputs/eds.rs"] mod inputs;\n' "$root" > "$work/eds.rs"
    echo 'fn main() { print!("{}", inputs::eds(1111)) }' >> "$work/eds.rs"
    rustc --edition 2021 -O -o "$work/eds" "$work/eds.rs"
    input=$work/bench.eds
    "$work/eds" > "$input"
fi

median_ms() { # SOURCE
    for _ in $(seq "$runs"); do
        local start=$(date +%s%N)
        rustc --edition 2021 --crate-type lib --emit=metadata -o "$work/out.rmeta" --extern lexibus="$runtime" "$1" || return
        echo $((($(date +%s%N) - start) / 1000))
    done | sort -n | sed -n "$(((runs + 1) / 2))p"
}

entries=$("$target/release/lexibus" info --format json "$input" | grep -o '"entries":[0-9]*' | head -n 1 | cut -d: -f2)
echo '#![no_std] extern crate lexibus;' > "$work/empty.rs"
empty=$(median_ms "$work/empty.rs")
for kind in handles accessors everything; do
    options=()
    case $kind in
        handles) options=(--no-accessors --no-pdos) ;;
        accessors) options=(--no-pdos) ;;
    esac
    "$target/release/lexibus" generate "$input" -A warnings ${options[@]+"${options[@]}"} --out "$work/bindings.rs"
    printf '#![no_std]\npub mod device { include!("%s"); }\n' "$work/bindings.rs" > "$work/crate.rs"
    all=$(median_ms "$work/crate.rs")
    awk -v kind="$kind" -v all="$all" -v empty="$empty" -v entries="$entries" \
        'BEGIN { printf "%-10s %6d entries %8.1f ms  %.3f ms an entry\n", kind, entries, (all - empty) / 1000, (all - empty) / 1000 / entries }'
done
