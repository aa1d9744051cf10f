#!/usr/bin/env bash
# The paper's tables and its figure 4: benches/results/paper.md and docs/figures/.
set -euo pipefail
cd "$(dirname "$0")/.."
cargo build --release --quiet
moreau=target/release/moreau
mkdir -p docs/figures benches/results
table=benches/results/paper.md
trap 'rm -f "$table.new"' EXIT
{
    echo '# The three experiments, each method from the same start'
    echo
    echo "$(grep -m1 'model name' /proc/cpuinfo | cut -d: -f2- | xargs), $(nproc) cores, one thread used; the fastest of three runs, of one for inclined-plane."
    echo 'Made by benches/paper.sh.'
    for name in sliding-ball sliding-ball-2d sedimentation sedimentation-2d inclined-plane inclined-plane-2d; do
        repeat=3
        case $name in inclined*) repeat=1 ;; esac
        printf '\n## %s\n\n```\n' "$name"
        "$moreau" compare "scenes/paper/$name.toml" --local sbp,sal,ebp,eal,pdas,exact --repeat "$repeat" --at 1000 --quiet \
            --plot "docs/figures/sweeps-$name.svg"
        printf '```\n'
    done
    printf '\n## sedimentation with the automatic ρ\n\n```\n'
    "$moreau" compare scenes/paper/sedimentation.toml --repeat 3 --quiet --set solver.rho=auto
    printf '```\n\n## sliding-ball: sweeps a step against ρ\n\n```\n'
    "$moreau" compare scenes/paper/sliding-ball.toml --set time.steps=200 --quiet \
        --rho 0.05,0.1,0.15,0.2,0.3,0.4,0.42,0.5,0.6,0.7,0.8,0.9,1 --plot docs/figures/rho.svg
    printf '```\n\n## sedimentation: sweeps a step against ρ\n\n```\n'
    "$moreau" compare scenes/paper/sedimentation.toml --set time.steps=600 --quiet --local sbp,sal,pdas \
        --rho 0.1,0.2,0.3,0.42,0.6,0.8,1,1.2,1.4,1.6,1.8 --plot docs/figures/rho-sedimentation.svg
    printf '```\n'
} > "$table.new"
mv "$table.new" "$table"
rm -f docs/figures/sweeps-sliding-ball.svg docs/figures/sweeps-sliding-ball-2d.svg
