#!/usr/bin/env python3
"""Prints random sentences of the texts in this repository, so that a person can judge the prose.

usage: docs/sample.py [--seed TEXT] [--count NUMBER] [AREA...]

The areas are book, tables, diagnostics, rustdoc, dictionaries, comments and networks. Without an area, the script samples all areas. The default
seed is the current commit, so that all readers get the same sentences. The output has the form `file:line: sentence`.
"""
import argparse
import pathlib
import random
import re
import subprocess
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Names of chapters that the area `book` leaves out: the chapters about buses, simulated devices, recipes and the documentation
# site, and the list of lints.
CLIENTS = {"buses", "canopen", "ethercat", "modbus", "profinet", "serial", "simulation", "recipes", "site", "lints"}
TEXT_KEYS = {"doc", "says", "chose", "why", "effects", "remedy", "cause", "note"}


def files(*patterns):
    listed = subprocess.run(["git", "ls-files", *patterns], cwd=ROOT, capture_output=True, text=True, check=True)
    return sorted(listed.stdout.split("\n")[:-1])


def read(path):
    return (ROOT / path).read_text(encoding="utf-8", errors="replace")


def sentences(text):
    text = re.sub(r"\s+", " ", text).strip()
    for sentence in re.split(r"(?<=[.!?])\s+(?=[A-Z`\"\[0-9])", text):
        if len(sentence.split()) >= 3:
            yield sentence.strip()


def markdown(path):
    """Yields the sentences of paragraphs, list items and table cells. Code blocks are left out."""
    paragraph, start, in_code = [], 0, False
    for number, line in enumerate([*read(path).splitlines(), ""], 1):
        if line.lstrip().startswith("```"):
            in_code = not in_code
            line = ""
        if in_code or line.startswith(("    ", "<", "#", "|---", ">", "!")):
            line = ""
        if line.startswith("|"):
            for cell in line.strip("|").split("|"):
                yield from ((path, number, sentence) for sentence in sentences(cell))
            line = ""
        is_item = re.match(r"\s*([-*]|\d+\.) ", line)
        if (not line.strip() or is_item) and paragraph:
            yield from ((path, start, sentence) for sentence in sentences(" ".join(paragraph)))
            paragraph = []
        if line.strip():
            start = start if paragraph else number
            paragraph.append(line[is_item.end():] if is_item else line)


def comments(path, mark):
    """Yields the sentences of comments whose lines begin with `mark`. Code blocks are left out."""
    block, start, in_code = [], 0, False
    for number, line in enumerate([*read(path).splitlines(), ""], 1):
        found = re.match(rf"\s*({mark})(?: (.*))?$", line)
        text = (found[2] or "") if found else ""
        is_fence = text.lstrip().startswith("```")
        in_code = bool(found) and in_code != is_fence
        if in_code or is_fence:
            text = ""
        if not text and block:
            yield from ((path, start, sentence) for sentence in sentences(" ".join(block)))
            block = []
        if text and not text.startswith(("|", "    ", "#")):
            start = start if block else number
            block.append(text)


def of_markdown(paths):
    return [found for path in paths for found in markdown(path)]


def of_comments(paths, mark):
    return [found for path in paths for found in comments(path, mark)]


def diagnostics():
    found = []
    for path in files("tests/ui/*/diagnostics"):
        for number, line in enumerate(read(path).splitlines(), 1):
            if message := re.match(r"(?:error|warning|note)\[\w+\]: (.*)|help: (.*)|\s+= note: (.*)", line):
                found.append((path, number, next(filter(None, message.groups()))))
    path = "codegen/src/diagnostics/codes.rs"
    for number, line in enumerate(read(path).splitlines(), 1):
        for text in re.findall(r'"((?:[^"\\]|\\.){20,})"', line):
            found.extend((path, number, sentence) for sentence in sentences(text.replace("\\n", " ")))
    return found


def texts(node, key=""):
    if isinstance(node, dict):
        for name, value in node.items():
            yield from texts(value, name)
    elif isinstance(node, list):
        for value in node:
            yield from texts(value, key)
    elif isinstance(node, str) and key in TEXT_KEYS:
        yield node


def dictionaries():
    found = []
    for path in files("dictionaries/*.toml", "dictionaries/profiles/*.toml"):
        found.extend((path, 0, text) for text in texts(tomllib.loads(read(path))))
    return found


AREAS = {
    "book": lambda: of_markdown(
        ["README.md", *(path for path in files("docs/src/*.md") if pathlib.Path(path).stem not in CLIENTS)]
    ),
    "tables": lambda: of_markdown(["dictionaries/README.md"]),
    "diagnostics": diagnostics,
    "rustdoc": lambda: of_comments(files("src/*.rs", "macros/src/*.rs", "generated/src/*.rs"), "///|//!"),
    "dictionaries": dictionaries,
    "comments": lambda: of_comments(files("codegen/*.rs", "cli/*.rs", "tests/*.rs", "benches/*.rs"), "///|//!|//")
    + of_comments(files("*.sh", "*.py", ".ci/run"), "#"),
    "networks": lambda: of_markdown(["docs/src/network.md", "docs/src/devices.md"])
    + of_comments(files("network/*.rs", "device/*.rs", "codegen/export/src/sii/*.rs"), "///|//!|//"),
}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed")
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("areas", nargs="*", metavar="AREA")
    arguments = parser.parse_args()
    head = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True)
    seed = arguments.seed or head.stdout.strip()
    for area in arguments.areas or AREAS:
        # A sentence that occurs in many places is sampled at most once.
        unique = sorted({sentence: (path, line) for path, line, sentence in reversed(AREAS[area]())}.items())
        print(f"# {area}: {min(arguments.count, len(unique))} of {len(unique)} sentences")
        for sentence, (path, line) in random.Random(f"{seed} {area}").sample(unique, min(arguments.count, len(unique))):
            print(f"{path}:{line}: {sentence}" if line else f"{path}: {sentence}")


main()
