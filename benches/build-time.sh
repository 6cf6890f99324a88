#!/usr/bin/env bash
# Measures the build time that a code generator, such as the Lexibus compiler, adds to a crate as a build dependency. Runs a cold
# `cargo build` in the dev profile for a crate whose build script uses the generator.
#
#     benches/build-time.sh                 # Lexibus, with EDS and tables, with EDS alone, prost-build, svd2rust
#     benches/build-time.sh lexibus         # only Lexibus
#     COMMIT=main~20 benches/build-time.sh lexibus
#
# Prints processor seconds and wall-clock seconds. Run the script on an idle machine. The script downloads dependencies
# before the measurement.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
work=$(mktemp -d)
trap 'git -C "$root" worktree remove --force "$work/source" 2>/dev/null || true; rm -rf "$work"' EXIT

if [[ -n ${COMMIT:-} ]]; then
    git worktree add --quiet --detach "$work/source" "$COMMIT"
    root=$work/source
fi

# Creates the crate $1 with the build dependency $2 and the build script $3.
crate() {
    mkdir -p "$work/$1/src"
    printf '[package]\nname = "driver"\nversion = "0.1.0"\nedition = "2021"\n[build-dependencies]\n%s\n[workspace]\n' "$2" >"$work/$1/Cargo.toml"
    printf '%s\n' "$3" >"$work/$1/build.rs"
    printf '#![no_std]\n' >"$work/$1/src/lib.rs"
}

measure() {
    local manifest=$work/$1/Cargo.toml
    cargo fetch --quiet --manifest-path "$manifest"
    TIMEFORMAT='%U %S %R'
    local times
    times=$({ time cargo build --quiet --offline --manifest-path "$manifest" --target-dir "$work/$1/target" >/dev/null 2>&1; } 2>&1)
    # shellcheck disable=SC2086
    set -- "$1" $times
    awk -v name="$1" -v user="$2" -v sys="$3" -v real="$4" \
        'BEGIN { printf "%-24s %6.1f s of processor %6.1f s of the clock\n", name, user + sys, real }'
}

lexibus() {
    crate lexibus "lexibus-codegen = { path = \"$root/codegen\" }" \
        "fn main() { lexibus_codegen::Builder::new().compile(\"$root/dictionaries/demo-drive.eds\").unwrap() }"
    measure lexibus
}
# Measures the build time of the Lexibus compiler with only the features $2. Prints the time next to the label $1.
lexibus-with() {
    crate "$1" "lexibus-codegen = { path = \"$root/codegen\", default-features = false, features = [$2] }" \
        "fn main() { lexibus_codegen::Builder::new().compile(\"$root/dictionaries/demo-drive.eds\").unwrap() }"
    measure "$1"
}
# Measures the build time of the compiler with the features for EDS and register tables.
lexibus-eds-table() { lexibus-with lexibus-eds-table '"eds", "table"'; }
# Measures the build time of the compiler with only the feature for EDS.
lexibus-eds() { lexibus-with lexibus-eds '"eds"'; }
prost-build() {
    crate prost-build 'prost-build = "0.14"' 'fn main() { let _ = prost_build::Config::new(); }'
    measure prost-build
}
svd2rust() {
    crate svd2rust 'svd2rust = { version = "0.37", default-features = false }' \
        'fn main() { let _ = svd2rust::config::Config::default(); }'
    measure svd2rust
}

for name in "${@:-}"; do
    case $name in
        "") lexibus && lexibus-eds-table && lexibus-eds && prost-build && svd2rust ;;
        lexibus | lexibus-eds-table | lexibus-eds | prost-build | svd2rust) "$name" ;;
        *) echo "there is no measurement $name" >&2 && exit 2 ;;
    esac
done
