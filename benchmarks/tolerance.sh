#!/usr/bin/env bash
# The tolerance of windows against exact on the shared meshes and on libcgal-demo's: one table, one summary.
# ./run tolerance [--limit VERTICES]; the table is left in build/benchmark/tolerance.md.
set -euo pipefail
cd "$(dirname "$0")/.."

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
build/benchmark/benchmarks/tolerance_table "$@" "${meshes[@]}" | tee build/benchmark/tolerance.md
