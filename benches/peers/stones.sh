#!/usr/bin/env bash
# A thousand stones poured into a box, moreau beside Rapier, both judged from their positions and velocities by the same measure.
#
#   benches/peers/stones.sh [COUNT [STEPS [TOLERANCE …]]]      writes to standard output; some minutes and the building
set -euo pipefail
cd "$(dirname "$0")/../.."
count=${1:-1000} steps=${2:-480} step=0.004166666666666667
shift $(($# < 2 ? $# : 2))
tolerances=${*:-1e-3 1e-5}
every=$((steps / 40))
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
target=${CARGO_TARGET_DIR:-$PWD/target}
cargo build --release --quiet -p moreau --example stones
(cd benches/peers/rapier && CARGO_TARGET_DIR=$target/peers cargo build --release --quiet --bin stones)
stones=$target/release/examples/stones
for tolerance in $tolerances; do
    "$stones" make "$count" $step "$tolerance" "$work/scene.toml" "$work/stones.txt"
    echo "moreau, scaled residual $tolerance:"
    RAYON_NUM_THREADS=1 "$stones" run "$work/scene.toml" "$steps" "$every" "$work/moreau"
    "$stones" judge "$work/scene.toml" "$work/moreau"
done
width=$(awk -v n="$count" 'BEGIN { print int(sqrt(n / 8) + 0.5) * 0.26 }')
echo 'Rapier:'
"$target/peers/release/stones" "$work/stones.txt" "$width" $step "$steps" "$every" "$work/rapier"
"$stones" judge "$work/scene.toml" "$work/rapier"
