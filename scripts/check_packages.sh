#!/bin/sh
# Packages all crates, unpacks them elsewhere, and builds and tests them there from the packages alone: unit tests, and the programs of their documentation.
#
#   scripts/check_packages.sh FOLDER
#
# FOLDER is made. Dependencies that were built in target/ are used again, since they are the same.
set -eu
root=$(pwd)
mkdir -p "$1"
out=$(cd "$1" && pwd)
cargo package --workspace --no-verify --quiet --allow-dirty --target-dir "$out/packed"
cat > "$out/Cargo.toml" << 'END'
[workspace]
resolver = "3"
members = ["moreau*"]

END
# What the workspace says of versions is in the packages; where they find each other is not, and how they are built.
sed -n '/^\[profile/,$p' Cargo.toml >> "$out/Cargo.toml"
printf '\n[patch.crates-io]\n' >> "$out/Cargo.toml"
for package in "$out"/packed/package/*.crate; do
    # Files in packages bear one old date: without that of now a build of an earlier package, kept in target/, would count as theirs.
    tar -xzmf "$package" -C "$out"
    folder=$(basename "$package" .crate)
    for file in README.md LICENSE-MIT LICENSE-APACHE; do
        test -s "$out/$folder/$file" || { echo "$folder lacks $file"; exit 1; }
    done
    echo "${folder%-*} = { path = \"$folder\" }" >> "$out/Cargo.toml"
done
cp Cargo.lock "$out"
cd "$out"
# Unit tests are no measure of speed: less optimised, they are built sooner.
for crate in moreau moreau-cli moreau-view; do
    set -- "$@" --config "profile.release.package.$crate.opt-level=1"
done
shift
CARGO_TARGET_DIR="$root/target" cargo test --workspace --release --quiet --features moreau-solve/files "$@"
