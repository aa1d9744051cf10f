#!/usr/bin/env python3
"""Lists the licences of all that the program, its libraries and its tests are built from.

    scripts/licences.py            prints the list
    scripts/licences.py --check    ends with an error where docs/licences.md is another list

Whether these licences are allowed is asked by `cargo deny`, which reads deny.toml.
"""

import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent
HEAD = """# Licences

What is built into the program, its libraries and its tests, each with its licence as the crate states it. Made by `scripts/licences.py`.

| crate | version | licence |
|---|---|---|
"""


def main():
    words = ["cargo", "metadata", "--format-version", "1", "--all-features", "--locked"]
    metadata = json.loads(subprocess.run(words, cwd=ROOT, capture_output=True, check=True, text=True).stdout)
    others = sorted((p for p in metadata["packages"] if p["source"]), key=lambda p: (p["name"], p["version"]))
    text = HEAD + "".join(f"| {p['name']} | {p['version']} | {p['license']} |\n" for p in others)
    if "--check" not in sys.argv:
        print(text, end="")
    elif (ROOT / "docs/licences.md").read_text() != text:
        sys.exit("docs/licences.md is out of date: scripts/licences.py > docs/licences.md")


main()
