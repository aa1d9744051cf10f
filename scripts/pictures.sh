#!/usr/bin/env bash
# Makes the pictures of docs/figures anew: the three experiments, an arch, a pile of stones, forces under a punch.
#
#   scripts/pictures.sh [FOLDER]        runs the scenes into FOLDER (a temporary one by default); some minutes
set -euo pipefail
cd "$(dirname "$0")/.."
work=${1:-$(mktemp -d)}
cargo build --release --quiet
moreau=${CARGO_TARGET_DIR:-target}/release/moreau
shoot() { # SCENE PICTURE WORDS…
    local out=$work/$(basename "$1" .toml)
    [ -f "$out/trajectory.h5" ] || "$moreau" run "scenes/$1" --out "$out" --force --quiet --set 'output.kinds=["trajectory"]'
    "$moreau" render "$out" --out "docs/figures/$2" --force "${@:3}"
}
shoot paper/sliding-ball.toml sliding-ball.png --size 640x480
shoot paper/sedimentation.toml sedimentation.png --size 800x600 --colour speed --time 0.02
shoot paper/inclined-plane.toml inclined-plane.png --size 800x600 --colour speed
shoot aqueduct.toml aqueduct.png --size 1200x600 --look=-0.35,1,-0.4
shoot arch.toml arch.png --chains --size 900x600 --look=-0.3,1,-0.25
shoot ballast.toml ballast.png --size 800x600
shoot punch.toml punch.svg --chains
