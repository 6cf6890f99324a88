#!/usr/bin/env bash
# Measures the peak memory of `lexibus check` and `lexibus generate`. Subtracts the peak memory for a minimal description and
# prints the rest as a multiple of the input size. Each peak is the median of five runs, because the amount of the program's code in
# memory depends on the random address at which it is loaded.
#
#     benches/memory.sh [FILE...]
#
# If no files are given, measures the corpus files above 1 MB and the register tables. Set `LEXIBUS` to use another binary
# than target/release/lexibus.
set -euo pipefail
cd "$(dirname "$0")/.."
lexibus=${LEXIBUS:-target/release/lexibus}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Prints the peak memory of the command `lexibus $1 $2` in kilobytes.
peak() {
    local out=(--out "$work/out.rs")
    [[ $1 == check ]] && out=()
    for _ in 1 2 3 4 5; do
        /usr/bin/time -f %M -o "$work/peak" "$lexibus" "$1" "$2" "${out[@]}" >/dev/null 2>&1 || true
        tail -1 "$work/peak"
    done | sort -n | sed -n 3p
}

# Writes a minimal description with the extension of $1 and prints its path. For XML files of all formats, the description is an
# ESI. Compiling it takes only the memory that the compiler needs for every input, such as the memory for the profiles. Stops the
# script if the compiler rejects the description.
empty() {
    case $1 in
    *.toml) printf 'lexibus = 1\n[device]\nname = "a"\nvendor = "a"\n[spaces.register]\nmodbus = { table = "holding", first = 1 }\n[[chapters]]\n[chapters.registers]\na = { reg = 1, type = "u16", access = "rw" }\n' ;;
    *.[eE][dD][sS] | *.[dD][cC][fF]) printf '[FileInfo]\nFileName=a.eds\n[1000]\nParameterName=a\nDataType=7\nAccessType=ro\n' ;;
    *) printf '<EtherCATInfo><Vendor><Id>1</Id></Vendor><Descriptions><Devices><Device Physics="YY"><Type ProductCode="1">a</Type></Device></Devices></Descriptions></EtherCATInfo>' ;;
    esac >"$work/empty.${1##*.}"
    "$lexibus" check "$work/empty.${1##*.}" -A warnings >"$work/messages" 2>&1 || { cat "$work/messages" >&2; return 1; }
    echo "$work/empty.${1##*.}"
}

if [[ $# -eq 0 ]]; then
    mapfile -d '' files < <(find -L ../shared/corpus -type f -size +976k -print0 | sort -z)
    set -- "${files[@]}" dictionaries/*.toml
fi
printf '%-52s %8s %7s %9s\n' file kB check generate
for file in "$@"; do
    small=$(empty "$file")
    size=$(stat -Lc %s "$file")
    ratios=()
    for command in check generate; do
        ratios+=("$(awk -v a="$(peak $command "$file")" -v b="$(peak $command "$small")" -v size="$size" \
            'BEGIN { printf "%.1f", (a - b) * 1024 / size }')")
    done
    name=$(basename "$file")
    printf '%-52s %8d %7s %9s\n' "${name:0:52}" $((size / 1000)) "${ratios[@]}"
done
