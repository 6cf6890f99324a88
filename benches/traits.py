#!/usr/bin/env python3
"""Measures how many instructions of rustc each trait of generated types takes: benches/traits.py DESCRIPTION...

For each trait, the script removes all implementations of the trait from the generated bindings, and counts the instructions of
`rustc --emit=metadata` with valgrind. The script needs `target/release/lexibus` and the runtime, as `benches/compile-time.sh` builds
them.
"""
import collections
import glob
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TARGET = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
IMPLEMENTATION = re.compile(r"^ *impl(?:<[^>]*>)? (?P<name>[\w:]+)(?:<.*>)? for ")
DERIVE = re.compile(r"#\[derive\((?P<names>[^)]*)\)\]")


def blocks(lines):
    """Returns the trait of each implementation, with the numbers of its first and last line."""
    for start, line in enumerate(lines):
        found = IMPLEMENTATION.match(line)
        if not found:
            continue
        indent = line[: len(line) - len(line.lstrip())]
        closes = line.rstrip().endswith("{}")
        end = start if closes else next(at for at in range(start, len(lines)) if lines[at] == indent + "}")
        yield found["name"].split("::")[-1], start, end


def without(lines, trait):
    """Returns the bindings without the implementations of a trait."""
    removed = set()
    for name, start, end in blocks(lines):
        if name == trait:
            removed.update(range(start, end + 1))
            while lines[start - 1].lstrip().startswith("#["):
                start -= 1
                removed.add(start)
    kept = [line for at, line in enumerate(lines) if at not in removed]
    others = lambda found: ", ".join(name for name in found["names"].split(", ") if name != trait)
    return [DERIVE.sub(lambda found: f"#[derive({others(found)})]", line) for line in kept]


def instructions(lines, folder):
    """Returns the number of instructions of rustc, or `None` if the bindings do not compile."""
    (folder / "bindings.rs").write_text("\n".join(lines))
    crate = folder / "crate.rs"
    crate.write_text('#![no_std]\npub mod device { include!("bindings.rs"); }\n')
    runtime = max(glob.glob(str(TARGET / "release/deps/liblexibus-*.rmeta")), key=os.path.getmtime)
    rustc = subprocess.run(["rustc", "--print", "sysroot"], capture_output=True, text=True, check=True).stdout.strip()
    command = [f"{rustc}/bin/rustc", "--edition", "2021", "--crate-type", "lib", "--emit=metadata", "--cap-lints", "allow",
               "-o", str(folder / "out.rmeta"), "--extern", f"lexibus={runtime}", str(crate)]
    if subprocess.run(command, capture_output=True).returncode:
        return None
    callgrind = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out", *command]
    report = subprocess.run(callgrind, capture_output=True, text=True, check=True).stderr
    return int(re.search(r"Collected : (\d+)", report)[1])


def main(descriptions):
    for description in descriptions:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            lexibus = [TARGET / "release/lexibus", "generate", description, "-A", "warnings", "--out", folder / "all.rs"]
            subprocess.run(lexibus, check=True, capture_output=True)
            lines = (folder / "all.rs").read_text().split("\n")
            counts = collections.Counter(name for name, _, _ in blocks(lines))
            counts.update(name for line in lines for found in DERIVE.finditer(line) for name in found["names"].split(", "))
            all_traits = instructions(lines, folder)
            print(f"{description}: {all_traits / 1e6:,.0f} million instructions")
            for trait, count in counts.most_common():
                rest = instructions(without(lines, trait), folder)
                cost = "necessary" if rest is None else f"{(all_traits - rest) / 1e6:8.1f} million, {(all_traits - rest) / all_traits:6.1%}"
                print(f"  {trait:12} {count:5} implementations  {cost}", flush=True)


main(sys.argv[1:])
