#!/usr/bin/env bash
# ./run demo: distances on a real scan, told in words, and coloured files. Called in the project's folder, after the
# build; BRUSHFIRE_SCAN names the mesh, or is empty where none could be had.
set -euo pipefail
brushfire=build/release/brushfire
mkdir -p demo

# value KEY < JSON: the value of a key of the outermost object.
value() { sed -n "s/^  \"$1\": \"\{0,1\}\([^\",]*\)\"\{0,1\},\{0,1\}$/\1/p"; }
percent() { awk -v x="$1" 'BEGIN { printf "%.2g %%", 100 * x }'; }
round() { awk -v x="$1" -v f="${2:-%.4g}" 'BEGIN { printf f, x }'; }
milliseconds() { awk -v x="$1" 'BEGIN { printf "%.1f ms", 1000 * x }'; }

scan=${BRUSHFIRE_SCAN:-}
if [ -n "$scan" ]; then
  echo "The mesh: $scan, a scan of a real object"
else
  scan=demo/folded-sphere.ply
  $brushfire shape folded-sphere --vertices 40000 -o $scan --quiet
  echo "The mesh: $scan, generated (no scan could be fetched): a sphere with folds like a cortex's"
fi
name=$(basename "${scan%.*}")
$brushfire info "$scan" | sed 1d

result=demo/$name-distance
fast=demo/$name-novotni-klein.npy
told=$($brushfire distance "$scan" --source 0 --json -o "$result.ply")
$brushfire distance "$scan" --source 0 --json -o "$result.vtk" >/dev/null
marched=$($brushfire distance "$scan" --source 0 --method novotni-klein --json -o "$fast")
echo
echo "From vertex 0, within $(percent "$(value tolerance <<<"$told")") of the truth ($(value method <<<"$told")):"
echo "  $(value reached <<<"$told") of $(value vertices <<<"$told") vertices reached;" \
  "the farthest is vertex $(value farthest_vertex <<<"$told"), at $(round "$(value max_distance <<<"$told")")"
echo "  computed in $(milliseconds "$(value solve_s <<<"$told")") after $(milliseconds "$(value set_up_s <<<"$told")") of set-up;" \
  "proven: no distance is wrong by more than $(percent "$(value max_error_bound <<<"$told")")"
echo "By the method of Novotni and Klein ($(value method <<<"$marched")):"
echo "  computed in $(milliseconds "$(value solve_s <<<"$marched")"), without a promise"

echo
echo "How right is that?"
# Where Pythagoras knows the answer: the flat square of the paper's figures, seed at a corner.
$brushfire shape paper-square -o demo/square.obj --quiet
$brushfire distance demo/square.obj --source 0 --method novotni-klein -o demo/square.npy --json >/dev/null
awk '$1 == "v" { if (!n++) { x = $2; y = $3 } printf "%.17g\n", sqrt(($2 - x) ^ 2 + ($3 - y) ^ 2) }' demo/square.obj >demo/square.txt
flat=$($brushfire compare demo/square.npy demo/square.txt --json)
echo "  novotni-klein on the paper's flat square (604 vertices) against Pythagoras: largest relative error $(round "$(value max_relative <<<"$flat")" %.1e)"
# Where an exact method knows it: the scan itself.
$brushfire distance "$scan" --source 0 --method exact -o "$result-exact.npy" --json >demo/exact.json
echo "  on this mesh against exact window propagation ($(round "$(value solve_s <demo/exact.json)" %.2g) s):"
for field in "$result.ply" "$fast"; do
  error=$($brushfire compare "$field" "$result-exact.npy" --json)
  echo "    $(if [ "$field" = "$fast" ]; then echo novotni-klein; else value method <<<"$told"; fi):" \
    "mean error $(percent "$(value mean_relative <<<"$error")"), largest $(percent "$(value max_relative <<<"$error")")"
done

echo
echo "Files, coloured by distance:"
echo "  $result.ply   for MeshLab (and any viewer of PLY); the distance is the vertex quality"
echo "  $result.vtk   for ParaView; choose Coloring: distance"
