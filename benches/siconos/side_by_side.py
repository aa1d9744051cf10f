#!/usr/bin/env python3
"""The best solver of moreau beside the best of Siconos, problem by problem, as a Markdown table.

    side_by_side.py --siconos siconos.json --moreau PROGRAM [--seconds S] FILE...

siconos.json comes from siconos_bench.py and says for each file at which tolerance it was solved. moreau solves the same files to
the same tolerance by both residuals (its criterion "strict" is the larger of the two), with each of its methods; of each the median
of eleven solves counts, and five of those that take more than a tenth of a second. On both sides `seconds` is the solve alone.
"""

import argparse
import json
import math
import platform
import subprocess
from pathlib import Path

METHODS = [("auto", "pdas"), ("nlgs", "pdas"), ("nlgs", "exact"), ("accelerated", "pdas"), ("accelerated", "exact"),
           ("active_set", "pdas"), ("admm", "pdas"), ("lemke", "pdas")]


def solve(program, path, tolerance, method, seconds, repeat):
    command = [program, "solve", str(path), "--json", "--criterion", "strict", "--tolerance", repr(tolerance),
               "--global", method[0], "--local", method[1], "--seconds", str(seconds), "--max-sweeps", "1000000000",
               "--repeat", str(repeat)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    rows = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
    return rows[0] if rows else None


def measured(program, path, tolerance, method, seconds):
    """The median of several solves, or None where it is not solved."""
    first = solve(program, path, tolerance, method, seconds, 1)
    if not first or first["status"] != "converged":
        return None
    return solve(program, path, tolerance, method, seconds, 11 if first["seconds"] < 0.1 else 5)


def machine():
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor()


def geometric_mean(values):
    return math.exp(sum(map(math.log, values)) / len(values)) if values else math.nan


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--siconos", required=True)
    parser.add_argument("--moreau", required=True)
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("files", nargs="+", type=Path)
    given = parser.parse_args()
    known = json.loads(Path(given.siconos).read_text())
    problems = {problem["file"]: problem for problem in known["problems"]}
    ratios, auto_ratios, large, lines = [], [], [], []
    for path in given.files:
        problem = problems[path.name]
        solved = [s for s in problem["solvers"] if s.get("solved")]
        theirs = min(solved, key=lambda s: min(s["seconds"], s["cpu"]), default=None)
        ours = {m: measured(given.moreau, path, problem["tolerance"], m, given.seconds) for m in METHODS}
        ours = {m: row for m, row in ours.items() if row and row["status"] == "converged"}
        best = min(ours, key=lambda m: ours[m]["seconds"], default=None)
        auto = ours.get(METHODS[0])
        name = lambda row: f"{row['seconds'] * 1e3:.4g}" if row else "not solved"
        ratio = auto_ratio = None
        if theirs and best:
            # The lesser of their two clocks: a driver's processor time leaves out what the machine did meanwhile.
            seconds = min(theirs["seconds"], theirs["cpu"])
            ratio = seconds / ours[best]["seconds"]
            ratios.append(ratio)
            if auto:
                auto_ratio = seconds / auto["seconds"]
                auto_ratios.append(auto_ratio)
            if problem["contacts"] >= 10:
                large.append(ratio)
        lines.append("| {} | {} | {} | {:.0e} | {} | {} | {} | {} | {} | {} |".format(
            path.stem, problem["dimension"], problem["contacts"], problem["tolerance"],
            theirs["solver"] if theirs else "none", f"{min(theirs['seconds'], theirs['cpu']) * 1e3:.4g}" if theirs else "not solved",
            "+".join(best) if best else "none", name(ours.get(best)), f"{ratio:.2f}" if ratio else "-",
            f"{auto_ratio:.2f}" if auto_ratio else "-"))
    print("# moreau beside Siconos\n")
    print(f"{machine()}, one thread each; Siconos {known['versions'].get('siconos', '?')} of Debian's python3-siconos. "
          "Times in milliseconds, of the solve alone. Both residuals, scaled and Siconos's own, are at most the tolerance. "
          f"At most {given.seconds:g} s a solve. Made by benches/siconos/run.sh.\n")
    print("| problem | D | contacts | tolerance | best of Siconos | ms | best of moreau | ms | ratio | ratio of auto |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    print("\n".join(lines))
    print(f"\nGeometric mean of the ratios: {geometric_mean(ratios):.2f} over {len(ratios)} problems that both solve, "
          f"{geometric_mean(large):.2f} over the {len(large)} with ten contacts or more; of auto {geometric_mean(auto_ratios):.2f}. "
          f"moreau is slower on {sum(r < 1 for r in ratios)}.")


if __name__ == "__main__":
    main()
