#!/usr/bin/env bash
# moreau beside Siconos on the same problems in one run: benches/results/siconos.md.
#
#   MOREAU_PROBLEMS=folder benches/siconos/run.sh [seconds a solve]
#
# Installs Debian's python3-siconos where it is missing (as root). The machine should be quiet; half an hour or more.
set -euo pipefail
cd "$(dirname "$0")/../.."
: "${MOREAU_PROBLEMS:?names the folder with the problem files (.dat, .hdf5)}"
seconds=${1:-10}
problems=$(realpath "$MOREAU_PROBLEMS")
python=/usr/bin/python3
if ! "$python" -c 'import siconos.numerics, scipy, h5py' 2> /dev/null; then
    export DEBIAN_FRONTEND=noninteractive
    apt-get update && apt-get install -y python3-siconos python3-scipy python3-h5py < /dev/null
fi
cargo build --release --quiet
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
shopt -s nullglob
files=("$problems"/*.dat "$problems"/*.hdf5)
"$python" benches/siconos/siconos_bench.py --seconds "$seconds" --repeat 5 --out "$out/siconos.json" "${files[@]}" > "$out/siconos.md"
mkdir -p benches/results
"$python" benches/siconos/side_by_side.py --siconos "$out/siconos.json" --moreau target/release/moreau --seconds "$seconds" \
    "${files[@]}" > "$out/table.md"
mv "$out/table.md" benches/results/siconos.md
