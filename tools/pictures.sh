#!/usr/bin/env bash
# ./run pictures: the pictures of the README, drawn by the program itself. Called in the project's folder, after the
# build; BRUSHFIRE_SCAN names the mesh.
set -euo pipefail
brushfire=build/release/brushfire
scan=${BRUSHFIRE_SCAN:?no scan could be fetched}
mkdir -p docs/images

far=$($brushfire distance "$scan" --source 0 --method exact --json | sed -n 's/^  "farthest_vertex": \([0-9]*\),$/\1/p')
view=(--azimuth 215 --elevation 12)
$brushfire render "$scan" --source 0 --isolines 30 --path "$far" --path 20000 --bar-title distance "${view[@]}" \
  --ambient-occlusion --size 720x600 -o docs/images/bunny.png
$brushfire render "$scan" --source 0 --isolines 30 --bar-title distance "${view[@]}" \
  --method kimmel-sethian --method exact --error --size 440x400 -o docs/images/error.png
$brushfire render "$scan" --source 0 --wave 60 "${view[@]}" --no-bar --size 720x600 -o docs/images/brushfire.webp
# Walls and cells (docs/walls-and-cells.md): a mask that leaves out every fourth cell of twelve, and centroidal cells.
temporary=$(mktemp -d)
trap 'rm -rf "$temporary"' EXIT
$brushfire sample "$scan" --count 12 --quiet >"$temporary/seeds.txt"
$brushfire voronoi "$scan" --sources "$temporary/seeds.txt" -o "$temporary/cells.csv" --quiet >/dev/null
awk -F, 'NR > 1 { print $3 % 4 == 3 ? 0 : 1 }' "$temporary/cells.csv" >"$temporary/mask.txt"
awk -F, 'NR > 1 { print $3 + 1 }' "$temporary/cells.csv" >"$temporary/labels.txt"
$brushfire render "$scan" --source 0 --mask "$temporary/mask.txt" --isolines 30 --bar-title distance "${view[@]}" \
  --size 560x480 -o docs/images/walls.png
$brushfire sample "$scan" --count 200 --lloyd --quiet >"$temporary/sites.txt"
$brushfire render "$scan" --sources "$temporary/sites.txt" --labels --no-bar "${view[@]}" --size 480x420 \
  -o docs/images/cells.png
# Curves (docs/curve-sources.md): a star drawn on the flank, its offsets, the signed field, cells of curves and points,
# and parcels by their Hausdorff distance from one of them.
awk 'BEGIN { for (i = 0; i < 10; ++i) { r = i % 2 ? 0.1 : 0.22; a = 3.14159265358979 * (i / 5 + 0.5)
    printf "v %.6f %.6f %.6f\n", 0.12 + r * cos(a), -0.15 + r * sin(a), 0.3 }
  print "l 1 2 3 4 5 6 7 8 9 10 1" }' >"$temporary/star.obj"
front=(--azimuth 0 --elevation 10)
$brushfire render "$scan" --source "$temporary/star.obj" --isolines 30 --bar-title distance "${front[@]}" \
  --size 480x440 -o docs/images/star-offsets.png
$brushfire render "$scan" --source "$temporary/star.obj" --signed --isolines 30 --bar-title "signed distance" \
  "${front[@]}" --size 480x440 -o docs/images/star-signed.png
$brushfire render "$scan" --source "$temporary/star.obj" --source path:0,20000 --sources "$temporary/seeds.txt" \
  --labels --no-bar "${front[@]}" --size 480x440 -o docs/images/curve-cells.png
$brushfire parcels "$scan" "$temporary/labels.txt" --distance hausdorff -o "$temporary/apart.csv" --quiet
awk -F, 'NR == FNR { if (FNR > 1) apart[$1] = $2; next } { print $1 in apart ? apart[$1] : 0 }' \
  "$temporary/apart.csv" "$temporary/labels.txt" >"$temporary/from-first.txt"
$brushfire render "$scan" --scalar "$temporary/from-first.txt" --bar-title "Hausdorff distance" "${front[@]}" \
  --size 480x440 -o docs/images/parcels.png
# Weights (docs/weights.md): a terrain whose middle costs four times as much.
$brushfire shape terrain --vertices 40000 -o "$temporary/terrain.obj" --quiet
awk '/^v / { x[++n] = $2; y[n] = $3 }
  /^f / { split($2, a, "/"); split($3, b, "/"); split($4, c, "/")
    u = (x[a[1]] + x[b[1]] + x[c[1]]) / 3 - 0.5; v = (y[a[1]] + y[b[1]] + y[c[1]]) / 3 - 0.5
    print u * u + v * v < 0.04 ? 4 : 1 }' "$temporary/terrain.obj" >"$temporary/weights.txt"
$brushfire distance "$temporary/terrain.obj" --source 0 --weights "$temporary/weights.txt" --bound upper --quiet \
  -o "$temporary/cost.npy"
$brushfire render "$temporary/terrain.obj" --scalar "$temporary/cost.npy" --isolines 30 --bar-title cost --up z \
  --azimuth 200 --elevation 60 --size 640x480 -o docs/images/weights.png
ls -l docs/images/bunny.png docs/images/error.png docs/images/brushfire.webp
