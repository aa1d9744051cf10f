#!/usr/bin/env bash
# Time per step and memory of balls falling into a box, from 1 000 to 100 000: the table benches/results/scaling.md.
# The box keeps its depth of some twelve balls and grows in width, so that chains of contacts, and sweeps, stay alike.
set -euo pipefail
cd "$(dirname "$0")/.."
cargo build --release --quiet
exec > benches/results/scaling.md
echo '# Balls falling into a box, from a thousand to a hundred thousand'
echo
echo "$(grep -m1 'model name' /proc/cpuinfo | cut -d: -f2- | xargs), one thread. Made by benches/scaling.sh from scenes/box-of-balls.toml: 600 steps of"
echo '1e-4 s, frictionless, PDAS in NLGS, ε_glob ≤ 1e-5, warm start; memory is what the program holds at the end.'
echo
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

echo '| balls | contacts at the end | sweeps a step | detection ms/step | impulses ms/step | step ms | µs a step and ball | memory MiB | bytes a ball |'
echo '|---|---|---|---|---|---|---|---|---|'
for balls in 1000 3000 10000 30000 100000; do
    width=$(python3 -c "print(repr(0.0021 * ($balls / 12) ** 0.5))")
    target/release/moreau run scenes/box-of-balls.toml --quiet --out "$out/$balls" --set "containers.0.max=[$width, $width, 0.06]" \
        --set "generate.0.count=$balls" --set "generate.0.lattice.max=[$width, $width, 0.06]" --set 'output.kinds=["steps"]'
    python3 - "$out/$balls/summary.json" "$balls" <<'PY'
import json, sys
s = json.load(open(sys.argv[1])); n = int(sys.argv[2]); steps = s["steps"]; t = s["seconds"]
step = t["total"] - t["output"]
print(f"| {n} | {s['contacts_last']} | {s['sweeps_mean']:.1f} | {1e3*t['detect']/steps:.3f} | {1e3*t['solve']/steps:.3f} "
      f"| {1e3*step/steps:.3f} | {1e6*step/steps/n:.3f} | {s['memory_bytes']/2**20:.0f} | {s['memory_bytes']/n:.0f} |")
PY
done
