#!/usr/bin/env bash
# Runs fuzz targets: codegen/fuzz/run.sh SECONDS [TARGET...]. Requires `cargo fuzz` (cargo install cargo-fuzz) and a nightly toolchain
# (rustup toolchain install nightly). Each failing input is written to a file in codegen/fuzz/artifacts. Inputs with new coverage are
# added to codegen/fuzz/corpus.
set -euo pipefail
cd "$(dirname "$0")"
seconds=${1:?usage: run.sh SECONDS [TARGET...]}
shift
targets=("$@")
if [[ ${#targets[@]} == 0 ]]; then targets=(eds xdd esi gsdml table overlay import macro_input messages pdo ir); fi
corpus=../../../shared/corpus

# Prints the paths of the seeds of a target: files of the repository, and real files if the corpus exists. Long files are left out,
# because a fuzzer that changes single bytes makes no progress in them.
seeds() {
    case $1 in
    eds) named "$corpus/eds" '*.eds' '*.dcf' ;;
    xdd)
        find seeds/xdd -type f
        named "$corpus/eds" '*.xdd' '*.xdc'
        ;;
    esi) named "$corpus/esi" '*esi*.xml' '*.xml' ;;
    gsdml) named "$corpus/gsdml" '*gsdml*.xml' '*GSDML*.xml' ;;
    table) named '' '*.toml' ;;
    overlay) overlays ;;
    import | macro_input) find "seeds/$1" -type f ;;
    messages) requests ;;
    pdo) process_data ;;
    ir) random ;;
    esac | while read -r file; do
        if [[ $(stat -c %s "$file") -le 65536 ]]; then echo "$file"; fi
    done
}

named() { # CORPUS PATTERN...
    local folder patterns=()
    for pattern in "${@:2}"; do patterns+=(-o -name "$pattern"); done
    for folder in ../../dictionaries ../tests ../../tests ../../benches ../../docs/examples "$1"; do
        if [[ -d $folder ]]; then find "$folder" -name target -prune -o -type f \( "${patterns[@]:1}" \) -print; fi
    done
}

# The length of an overlay selects one of three descriptions. Each overlay is therefore added to the seeds three times:
# with zero, one and two additional line feeds.
overlays() {
    local file lines name
    mkdir -p corpus/overlays
    find seeds/overlay ../../docs/examples/pump.overlay.toml -type f | while read -r file; do
        for lines in '' '\n' '\n\n'; do
            name=corpus/overlays/$(basename "$file")-${#lines}
            { cat "$file" && printf "$lines"; } >"$name"
            echo "$name"
        done
    done
}

# Creates one file for each request code: a request to node 1, followed by a reply of zeros. The crate `arbitrary` expects 01
# before each byte of a list, and 00 after the last byte.
requests() {
    local code number
    mkdir -p corpus/requests
    for number in {0..255}; do
        printf -v code '%02x' "$number"
        {
            printf '\\x01\\x01\\x01\\x%s' "$code"
            printf '\\x01\\x00%.0s' {1..12}
            printf '\\x00'
            printf '\\x01\\x00%.0s' {1..16}
        } | xargs -0 printf '%b' >"corpus/requests/$code"
    done
    find corpus/requests -type f
}

# Creates process data with 1 to 48 bytes, all zeros and all ones.
process_data() {
    local length
    mkdir -p corpus/process_data
    for length in {1..48}; do
        head -c "$length" /dev/zero >"corpus/process_data/zeros_$length"
        head -c "$length" /dev/zero | tr '\0' '\377' >"corpus/process_data/ones_$length"
    done
    find corpus/process_data -type f
}

# Creates files of random bytes. The fuzz target `ir` generates a catalog from each file.
random() {
    mkdir -p corpus/random
    for number in {1..64}; do
        if [[ ! -e corpus/random/$number ]]; then head -c 4000 /dev/urandom >"corpus/random/$number"; fi
    done
    find corpus/random -type f
}

dictionary() {
    case $1 in
    eds) echo dictionaries/eds.dict ;;
    xdd | esi | gsdml) echo dictionaries/xml.dict ;;
    table | overlay) echo dictionaries/table.dict ;;
    import) echo dictionaries/import.dict ;;
    macro_input) echo dictionaries/macro.dict ;;
    esac
}

failed=()
for target in "${targets[@]}"; do
    mkdir -p "corpus/$target"
    seeds "$target" | while read -r file; do cp "$file" "corpus/$target/$(sha1sum "$file" | cut -c1-16)"; done
    options=(-max_total_time="$seconds" -max_len=65536 -timeout=60 -rss_limit_mb=4096 -print_final_stats=1)
    # For targets that run most of the compiler, counting rare branches takes more time than it saves.
    case $target in overlay | ir) options+=(-entropic=0) ;; esac
    if [[ $target == ir ]]; then options+=(-len_control=0 -max_len=8192 -timeout=60); fi
    words=$(dictionary "$target")
    if [[ -n $words ]]; then options+=(-dict="$words"); fi
    echo "== $target"
    # Published crates contain no unsafe code, so no sanitizer is needed. Without the sanitizer, three times as many
    # inputs run in the same time.
    cargo +nightly fuzz run --sanitizer none "$target" -- "${options[@]}" || failed+=("$target")
done
if [[ ${#failed[@]} != 0 ]]; then
    echo "these targets found failing inputs: ${failed[*]}" >&2
    exit 1
fi
