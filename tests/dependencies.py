#!/usr/bin/env python3
"""Checks the dependencies of the workspace: their licenses, and that tests/duplicates.txt lists each crate that is compiled in
several versions, with the reason.

    tests/dependencies.py
"""

import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

# Licenses under which a dependency can be part of a program with the license MIT or Apache-2.0.
ALLOWED = {
    "0BSD", "Apache-2.0", "Apache-2.0 WITH LLVM-exception", "BSD-2-Clause", "BSD-3-Clause", "BSL-1.0", "CC0-1.0", "ISC", "MIT",
    "Unicode-3.0", "Unlicense", "Zlib",
}

# Dependencies with other licenses, and what uses them. The README names those that published crates use.
EXCEPTIONS = {
    "serialport": ("MPL-2.0", "tokio-modbus, in the feature `modbus`"),
    "mio-serial": ("MPL-2.0", "tokio-modbus, in the feature `modbus`"),
    "font-awesome-as-a-crate": ("CC-BY-4.0 AND MIT", "mdbook, in a test of the book"),
    **{
        f"mdbook-{part}": ("MPL-2.0", "a test of the book")
        for part in ("core", "driver", "html", "markdown", "preprocessor", "renderer", "summary")
    },
}


def cargo(*arguments):
    call = ["cargo", *arguments, "--all-features", "--locked"]
    return subprocess.run(call, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout


def parts(expression, operator):
    """Splits a license expression at an operator outside of parentheses."""
    found, depth = [""], 0
    for token in re.split(rf"(\(|\)|{operator})", expression):
        depth += (token == "(") - (token == ")")
        if depth == 0 and re.fullmatch(operator, token):
            found.append("")
        else:
            found[-1] += token
    return [part.strip() for part in found]


def is_allowed(expression):
    """Returns whether a license expression allows the use with allowed licenses only. AND binds stronger than OR. The slash is an old
    form of OR."""
    alternatives = parts(expression, r"\s+OR\s+|/")
    if len(alternatives) > 1:
        return any(map(is_allowed, alternatives))
    both = parts(expression, r"\s+AND\s+")
    if len(both) > 1:
        return all(map(is_allowed, both))
    if expression.startswith("(") and expression.endswith(")"):
        return is_allowed(expression[1:-1].strip())
    return expression in ALLOWED


def check_expressions():
    """Checks `is_allowed`."""
    allowed = ["MIT", "MIT/Apache-2.0", "MIT OR GPL-3.0", "(MIT OR GPL-3.0) AND Zlib", "(MIT)", "GPL-3.0 OR MIT AND ISC",
               "(MIT OR Apache-2.0) AND (Zlib OR GPL-3.0)", "Apache-2.0 WITH LLVM-exception OR GPL-3.0"]
    refused = ["", "GPL-3.0", "(MIT OR Apache-2.0) AND GPL-3.0", "MIT AND GPL-3.0", "GPL-3.0 AND (MIT OR Zlib)", "(GPL-3.0)",
               "MIT AND (GPL-3.0 OR MPL-2.0)"]
    for expressions, expected in ((allowed, True), (refused, False)):
        for expression in expressions:
            assert is_allowed(expression) == expected, expression


def licenses():
    """Returns the faults of the licenses."""
    for package in json.loads(cargo("metadata", "--format-version", "1"))["packages"]:
        name, expression = package["name"], package["license"] or ""
        is_private = package["source"] is None and package["publish"] == []
        is_known = EXCEPTIONS.get(name, ("",))[0] == expression
        if not (is_private or is_known or is_allowed(expression)):
            yield f"{name} {package['version']} has the license {expression or '(none)'!r}"


def compatible(version):
    """Returns the part of a version that differs between incompatible versions."""
    major, minor, *_ = version.split(".")
    return f"{major}.{minor}" if major == "0" else major


def duplicates():
    """Returns the differences between the duplicates and the list of known duplicates."""
    tree = cargo("tree", "--workspace", "--target", "all", "--duplicates", "--depth", "0", "--prefix", "none", "--format", "{p}")
    versions = {}
    for name, version in re.findall(r"^(\S+) v(\S+)", tree, re.MULTILINE):
        versions.setdefault(name, set()).add(compatible(version))
    found = {name: found for name, found in versions.items() if len(found) > 1}
    listed = {}
    for line in (ROOT / "tests/duplicates.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            name, numbers, _reason = line.split("|")
            listed[name.strip()] = set(numbers.split())
    for name in sorted(found.keys() | listed.keys()):
        if found.get(name) != listed.get(name):
            now, then = (" ".join(sorted(each.get(name, []))) or "one version" for each in (found, listed))
            yield f"{name}: {now}, but tests/duplicates.txt lists {then}"


check_expressions()
faults = [*licenses(), *duplicates()]
print("\n".join(faults) or "all licenses are compatible, and all duplicates are listed")
sys.exit(bool(faults))
