#!/usr/bin/env python3
"""moreau beside MuJoCo, Rapier and Jolt on nine scenes with known answers: results.md, results.json and the tables of docs/fidelity.md.

    benches/fidelity/run.py [--work FOLDER] [--moreau PROGRAM] [--engines moreau MuJoCo] [--only slide disk] [--budget SECONDS]

Needs Rust, Python 3.11 with venv, Node with npm (for Jolt; without it its rows are left out), and the package registries of the three.
Makes an environment of its own in FOLDER (a temporary one where none is given; a given one is kept and used again). MOREAU in the
environment names the program too; where neither does, it is built. The machine should be quiet; some minutes and the building.
With --engines or --only, what was measured before stays in the results.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
ENGINES = ["moreau", "MuJoCo", "Rapier", "Jolt"]


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--work", type=Path, help="a folder for the environment and for files between the programs")
    words.add_argument("--moreau", default=os.environ.get("MOREAU"), help="the program")
    words.add_argument("--engines", nargs="+", default=ENGINES, choices=ENGINES)
    words.add_argument("--only", nargs="+", help="names of experiments")
    words.add_argument("--budget", type=float, default=25.0, help="seconds of a processor that one run may take; Linux only")
    words.add_argument("--results", type=Path, default=HERE, help="where results.md and results.json are")
    words.add_argument("--page", type=Path, default=ROOT / "docs/fidelity.md", help="the page whose tables are replaced")
    args = words.parse_args()
    if args.work is None:
        with tempfile.TemporaryDirectory() as folder:
            measure(args, Path(folder))
    else:
        args.work.mkdir(parents=True, exist_ok=True)
        measure(args, args.work.resolve())


def measure(args, work):
    """Prepares the engines and hands over to the table, which needs the packages of the environment."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    python = environment(work)
    moreau = args.moreau or (cargo(ROOT, target) if "moreau" in args.engines else None)
    # Kept between runs beside moreau's own, since it takes minutes.
    rapier = cargo(HERE / "rapier", target / "peers", "rapier-fidelity") if "Rapier" in args.engines else None
    jolt = node(work) if "Jolt" in args.engines else None
    words = [python, HERE / "table.py", "--work", work, "--budget", args.budget, "--results", args.results, "--page", args.page]
    words += ["--engines", *args.engines, *(["--only", *args.only] if args.only else [])]
    for name, place in (("--moreau", moreau), ("--rapier", rapier), ("--jolt", jolt)):
        words += [name, place] if place else []
    subprocess.run([*map(str, words)], check=True, env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"})


def environment(work):
    """Returns the Python of an environment with the packages of requirements.txt."""
    python = work / "venv/bin/python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", work / "venv"], check=True)
    subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r", HERE / "requirements.txt"], check=True)
    return python


def cargo(folder, target, name="moreau"):
    """Builds a program and returns its place."""
    subprocess.run(["cargo", "build", "--release", "--quiet"], cwd=folder, env=os.environ | {"CARGO_TARGET_DIR": str(target)}, check=True)
    return target / "release" / name


def node(work):
    """Returns a folder with Jolt's package, or nothing where there is no Node."""
    if shutil.which("node") is None or shutil.which("npm") is None:
        print("no Node here: Jolt is left out", file=sys.stderr)
        return None
    folder = work / "jolt"
    folder.mkdir(exist_ok=True)
    shutil.copy(HERE / "package.json", folder)
    subprocess.run(["npm", "install", "--silent", "--no-audit", "--no-fund"], cwd=folder, check=True)
    return folder


if __name__ == "__main__":
    main()
