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

# Dependencies with other licenses, and who uses them. The README names those of published crates.
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


def is_allowed(expression):
    """Returns whether one alternative of a license expression consists of allowed licenses."""
    alternatives = re.split(r"\s+OR\s+|/", expression.replace("(", "").replace(")", ""))
    return any(all(part.strip() in ALLOWED for part in alternative.split(" AND ")) for alternative in alternatives)


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
    tree = cargo("tree", "--workspace", "--duplicates", "--depth", "0", "--prefix", "none", "--format", "{p}")
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


faults = [*licenses(), *duplicates()]
print("\n".join(faults) or "all licenses are compatible, and all duplicates are listed")
sys.exit(bool(faults))
