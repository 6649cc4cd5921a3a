#!/usr/bin/env bash
# Regenerates docs/paper.md and its pictures from the built measuring programs. Scans come from Debian's libcgal-demo, where it is installed.
set -euo pipefail
cd "$(dirname "$0")/.."

data=/usr/share/doc/libcgal-demo/data.tar.gz
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
scans=()
if [ -r "$data" ]; then
  for scan in fandisk_large man diplodocus; do
    tar -xzf "$data" -C "$folder" "data/meshes/$scan.off"
    scans+=("$folder/data/meshes/$scan.off")
  done
else
  echo "libcgal-demo is not installed: figure 8 and most of table 1 are left out" >&2
fi
build/benchmark/benchmarks/paper/paper benchmarks/paper/paper.md.in "${scans[@]}" >"$folder/paper.md"
mv "$folder/paper.md" docs/paper.md
pictures=()
for scan in "${scans[@]}"; do
  case $scan in */man.off) ;; *) pictures+=("$scan") ;; esac  # two scans, as in the paper
done
build/benchmark/benchmarks/paper/figures docs/images "${pictures[@]}"
echo "docs/paper.md" >&2
