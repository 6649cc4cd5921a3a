#!/usr/bin/env bash
# A program of benchmarks/ on the shared meshes and on libcgal-demo's:
# on_meshes.sh tolerance_table | curve_samples | row_holes [--limit VERTICES]; what it prints is left in build/benchmark/PROGRAM.md.
set -euo pipefail
cd "$(dirname "$0")/.."
program=$1
shift

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
meshes=()
if [ -d ../shared/meshes ]; then meshes+=(../shared/meshes); fi
archive=/usr/share/doc/libcgal-dev/data.tar.gz
if [ -f $archive ]; then
  tar -xzf $archive -C "$folder"
  meshes+=("$folder")
else
  echo "libcgal-demo is not installed: its meshes are left out" >&2
fi
"build/benchmark/benchmarks/$program" "$@" "${meshes[@]}" | tee "build/benchmark/$program.md"
