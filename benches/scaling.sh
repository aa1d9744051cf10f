#!/usr/bin/env bash
# Time per step and memory of balls falling into a box with friction, from a thousand to a million, on one thread and on two: the table
# benches/results/scaling.md. The box keeps its depth of some twelve balls and grows in width, so that chains of contacts, and sweeps,
# stay alike.
set -euo pipefail
cd "$(dirname "$0")/.."
cargo build --release --quiet
exec > benches/results/scaling.md
echo '# Balls falling into a box, from a thousand to a million'
echo
echo "$(grep -m1 'model name' /proc/cpuinfo | cut -d: -f2- | xargs), one thread and two. Made by benches/scaling.sh from scenes/box-of-balls.toml:"
echo '200 steps of 1e-4 s, μ = 0.3, default solver, ε_glob ≤ 1e-5, warm start; every step converged. Memory is what the program holds at the'
echo 'end. Milliseconds are means over the steps.'
echo
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

echo '| balls | threads | contacts at the end | sweeps a step | detection ms | localising ms | impulses ms | step ms | µs a step and ball | memory MiB | bytes a ball |'
echo '|---|---|---|---|---|---|---|---|---|---|---|'
for balls in 1000 10000 100000 1000000; do
    width=$(python3 -c "print(repr(0.0021 * ($balls / 12) ** 0.5))")
    for threads in 1 2; do
        target/release/moreau run scenes/box-of-balls.toml --quiet --threads "$threads" --out "$out/$balls" --force --set time.steps=200 \
            --set 'default_law={ coulomb = { friction = 0.3 } }' --set "containers.0.max=[$width, $width, 0.06]" \
            --set "generate.0.count=$balls" --set "generate.0.lattice.max=[$width, $width, 0.06]" --set 'output.kinds=["steps"]'
        python3 - "$out/$balls/summary.json" "$balls" "$threads" <<'PY'
import json, sys
s = json.load(open(sys.argv[1])); n = int(sys.argv[2]); steps = s["steps"]; t = s["seconds"]
assert s["unconverged_steps"] == 0
step = t["total"] - t["output"]
print(f"| {n} | {sys.argv[3]} | {s['contacts_last']} | {s['sweeps_mean']:.1f} | {1e3*t['detect']/steps:.2f} | {1e3*t['localise']/steps:.2f} "
      f"| {1e3*t['solve']/steps:.2f} | {1e3*step/steps:.2f} | {1e6*step/steps/n:.3f} | {s['memory_bytes']/2**20:.0f} | {s['memory_bytes']/n:.0f} |",
      flush=True)
PY
    done
done
