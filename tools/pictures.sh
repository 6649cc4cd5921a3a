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
$brushfire render "$scan" --source 0 --wave 60 "${view[@]}" --no-bar --size 420x360 -o docs/images/brushfire.webp
ls -l docs/images/bunny.png docs/images/error.png docs/images/brushfire.webp
