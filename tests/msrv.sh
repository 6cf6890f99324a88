#!/usr/bin/env bash
# Checks that the runtime compiles with its minimum Rust versions and each feature alone. Also checks that the crate `generated`
# compiles with the minimum version of the runtime. Skips a version with a message if its toolchain is not installed. Install a
# toolchain with `rustup toolchain install 1.81.0 --profile minimal`.
#
#     tests/msrv.sh
#
# The workspace cannot be loaded by old toolchains, so the script checks a copy of the runtime. The dependencies of the copy are the
# newest that the minimum version supports.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${CARGO_TARGET_DIR:-$PWD/target}/msrv

# Minimum version, and the features that need it. The feature `macros` compiles the compiler, whose minimum version is 1.88.
requirements=(
    "1.81.0 none std canopen socketcan socketcan-tokio serial serde defmt"
    "1.85.0 ethercat modbus"
)

failed=0
for requirement in "${requirements[@]}"; do
    read -r version features <<<"$requirement"
    if ! rustup run "$version" rustc --version >/dev/null 2>&1; then
        echo "skipped: Rust $version is not installed ($features)"
        continue
    fi
    copy=$folder/$version
    mkdir -p "$copy"
    rm -rf "$copy/src"
    cp -r src README.md "$copy"
    python3 - "$version" "$copy/Cargo.toml" <<'PYTHON'
import json
import sys
import tomllib

version, path = sys.argv[1:]
with open("Cargo.toml", "rb") as file:
    manifest = tomllib.load(file)


def inline(value):
    """Returns a TOML value."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {inline(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(inline, value)) + "]"
    return json.dumps(value)


def section(name, table):
    return f"[{name}]\n" + "".join(f"{json.dumps(key)} = {inline(value)}\n" for key, value in table.items())


dependencies = {name: value for name, value in manifest["dependencies"].items() if name != "lexibus-macros"}
# Keep the feature `macros`, but drop its dependency `lexibus-macros`, because `lexibus-codegen` requires Rust 1.88.
features = {**manifest["features"], "macros": []}
text = section("package", {"name": "lexibus", "version": "0.1.0", "edition": "2021", "rust-version": version.removesuffix(".0")})
text += "[workspace]\n" + section("features", features) + section("dependencies", dependencies)
for target, tables in manifest["target"].items():
    if "dependencies" in tables:
        text += section(f"target.{json.dumps(target)}.dependencies", tables["dependencies"])
with open(path, "w") as file:
    file.write(text)
PYTHON
    # The crate `generated` and the runtime have the same minimum version.
    if [[ $version == 1.81.0 ]]; then
        rm -rf "$copy/generated"
        mkdir "$copy/generated"
        cp -r generated/src generated/README.md "$copy/generated"
        sed -e '/workspace = true/d' -e '/^\[lints\]/d' -e 's/^rust-version/version = "0.1.0"\nedition = "2021"\nrust-version/' \
            generated/Cargo.toml >"$copy/generated/Cargo.toml"
        echo '[workspace]' >>"$copy/generated/Cargo.toml"
        echo "Rust $version, crate: generated"
        CARGO_RESOLVER_INCOMPATIBLE_RUST_VERSIONS=fallback cargo generate-lockfile --quiet --manifest-path "$copy/generated/Cargo.toml"
        CARGO_TARGET_DIR=$folder/build cargo "+$version" check --quiet --locked --all-features \
            --manifest-path "$copy/generated/Cargo.toml" || failed=1
    fi
    rm -f "$copy/Cargo.lock"
    CARGO_RESOLVER_INCOMPATIBLE_RUST_VERSIONS=fallback cargo generate-lockfile --quiet --manifest-path "$copy/Cargo.toml"
    for feature in $features; do
        echo "Rust $version, feature: $feature"
        CARGO_TARGET_DIR=$folder/build cargo "+$version" check --quiet --locked --manifest-path "$copy/Cargo.toml" \
            --no-default-features --features "${feature#none}" || failed=1
    done
done
exit $failed
