#!/usr/bin/env bash
# Packages all crates as for crates.io, then builds two crates with these packages. The two crates are the drive crate in
# tests/drive-crate, and the command line with `cargo install lexibus-cli`. Both builds use a local folder that contains all
# crates, including external ones.
#
#     tests/packages.sh
#
# The packages are written to target/packages.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${CARGO_TARGET_DIR:-$PWD/target}/packages
source=$folder/source
scratch=$folder/scratch
crates=(lexibus lexibus-codegen lexibus-macros lexibus-site lexibus-export lexibus-import lexibus-network lexibus-device lexibus-cli lexibus-drives)

# Cargo considers a crate from a directory source unchanged if its version is the same. Remove the fingerprints of our crates,
# so that Cargo compiles their new contents.
rm -rf "$source" "$scratch" "$folder/installed" "$folder"/build/debug/.fingerprint/lexibus*
mkdir -p "$source" "$scratch"

# Use --no-verify, because Cargo's verification would compile everything once more. The following builds replace the verification.
cargo package --quiet --allow-dirty --no-verify --target-dir "$folder" "${crates[@]/#/-p}" 2> >(grep -v "^warning: ignoring" >&2)

cargo vendor --quiet --locked "$source" >/dev/null
for crate in "${crates[@]}"; do
    package=$(ls "$folder/package/$crate"-[0-9]*.crate)
    tar -xzf "$package" -C "$source"
    unpacked=$source/$(basename "$package" .crate)
    for file in LICENSE-MIT LICENSE-APACHE README.md; do
        [[ -s $unpacked/$file ]] || { echo "the package of $crate has no $file"; exit 1; }
    done
    printf '{"files":{},"package":"%s"}' "$(sha256sum "$package" | cut -d' ' -f1)" >"$unpacked/.cargo-checksum.json"
done

# `cargo install` ignores the configuration in the current folder. Both commands therefore get the configuration as arguments.
packages=(--offline --config 'source.crates-io.replace-with = "packages"' --config "source.packages.directory = \"$source\"")

cp -r tests/drive-crate/{build.rs,pump.eds,src} "$scratch"
{
    sed -E 's/path = "[^"]*"/version = "0.1"/' tests/drive-crate/Cargo.toml
    echo "[workspace]"
} >"$scratch/Cargo.toml"
if grep -q "path =" "$scratch/Cargo.toml"; then
    echo "the scratch crate still depends on a folder"
    exit 1
fi

cd "$scratch"
export CARGO_TARGET_DIR=$folder/build
cargo test --quiet "${packages[@]}"
cargo install --quiet --debug "${packages[@]}" --root "$folder/installed" lexibus-cli
"$folder/installed/bin/lexibus" generate pump.eds --out pump.rs
grep -q "pub struct Pump" pump.rs
echo "${#crates[@]} packages: the drive crate passes its tests, and the installed command generates its bindings"
