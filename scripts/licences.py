#!/usr/bin/env python3
"""Lists the licences of all that the program and its crates depend on, and holds them to deny.toml.

    scripts/licences.py            prints the list
    scripts/licences.py --check    ends with an error where docs/licences.md is another list, a licence is not allowed, a crate does not come
                                   from crates.io, or there are two versions of one that deny.toml does not name

The same is asked by `cargo deny`, which takes minutes to install; this asks `cargo metadata`, and reads the same file.
"""

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).parent.parent
HEAD = """# Licences

What is built into the program, its libraries and its tests, each with its licence as the crate states it. Made by `scripts/licences.py`.

| crate | version | licence |
|---|---|---|
"""


def allowed(expression, allow):
    """Returns whether a licence expression (SPDX, or the old form with slashes) can be met by licences that are allowed."""
    tokens = re.findall(r"\(|\)|[^\s()/]+|/", expression or "")

    def either():
        met = both()
        while tokens and tokens[0] in ("OR", "/"):
            tokens.pop(0)
            met |= both()
        return met

    def both():
        met = one()
        while tokens and tokens[0] == "AND":
            tokens.pop(0)
            met &= one()
        return met

    def one():
        if not tokens:
            return False
        token = tokens.pop(0)
        if token == "(":
            met = either()
            tokens.pop(0)
            return met
        if tokens and tokens[0] == "WITH":
            token = " ".join([token, tokens.pop(0), tokens.pop(0)])
        return token in allow

    return either() and not tokens


def main():
    rules = tomllib.loads((ROOT / "deny.toml").read_text())
    words = ["cargo", "metadata", "--format-version", "1", "--all-features", "--locked"]
    metadata = json.loads(subprocess.run(words, cwd=ROOT, capture_output=True, check=True, text=True).stdout)
    others = sorted((p for p in metadata["packages"] if p["source"]), key=lambda p: (p["name"], p["version"]))
    wrong = []
    for package in others:
        name = f"{package['name']} {package['version']}"
        if not allowed(package["license"], rules["licenses"]["allow"]):
            wrong.append(f"{name}: the licence {package['license']} is not allowed")
        if "crates.io" not in package["source"] and "sparse+" not in package["source"]:
            wrong.append(f"{name} comes from {package['source']}")
    skipped = {entry["crate"] for entry in rules["bans"]["skip"]}
    names = [package["name"] for package in others]
    twice = {name for name in names if names.count(name) > 1}
    wrong += [f"there are several versions of {name}" for name in sorted(twice - skipped)]
    wrong += [f"deny.toml allows several versions of {name}, and there are none" for name in sorted(skipped - twice)]
    text = HEAD + "".join(f"| {p['name']} | {p['version']} | {p['license']} |\n" for p in others)
    if "--check" not in sys.argv:
        print(text, end="")
        return
    if (ROOT / "docs/licences.md").read_text() != text:
        wrong.append("docs/licences.md is out of date: scripts/licences.py > docs/licences.md")
    print("\n".join(wrong) or f"{len(others)} crates, all licences allowed")
    sys.exit(bool(wrong))


main()
