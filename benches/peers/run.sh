#!/usr/bin/env bash
# moreau beside Rapier and MuJoCo on one pile of balls: benches/results/peers.md.
#
#   benches/peers/run.sh [options of bench.py]        for example: --balls 500 --budget 60 --tolerances 1e-7
#
# Needs Rust, Python with venv, and the package registries of both. The machine should be quiet; some five minutes and the building.
# MOREAU names another program than target/release/moreau, OUT another file than benches/results/peers.md.
set -euo pipefail
export PYTHONDONTWRITEBYTECODE=1
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ -z "${MOREAU:-}" ]; then
    cargo build --release --quiet
    MOREAU=${CARGO_TARGET_DIR:-target}/release/moreau
fi
# Kept between runs beside moreau's own, since it takes minutes.
peers=${CARGO_TARGET_DIR:-$PWD/target}/peers
(cd benches/peers/rapier && CARGO_TARGET_DIR=$peers cargo build --release --quiet)
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check mujoco numpy
"$work/venv/bin/python" benches/peers/bench.py --moreau "$MOREAU" --rapier "$peers/release/rapier-pile" --work "$work" "$@" > "$work/peers.md"
out=${OUT:-benches/results/peers.md}
mv "$work/peers.md" "$out"
echo "written: $out" >&2
