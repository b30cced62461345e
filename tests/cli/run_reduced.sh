#!/usr/bin/env bash
# Answers a scene's question with few cells along each axis in an empty folder: maps with 24, branches with
# 5. Usage: run_reduced.sh PROGRAM SCENE.toml
set -euo pipefail
program=$1
scene=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
reduced=()
axes=$(grep -c '^\[\[grid.axis\]\]' "$scene")
if grep -q '^kind = "branch"' "$scene"; then
    for ((axis = 0; axis < axes; ++axis)); do reduced+=("grid.axis.$axis.cells=5"); done
    "$program" branch "$scene" "${reduced[@]}" -o branches
    [ -s branches.csv ] && [ -s branches.png ]
    python3 -c 'import json; assert json.load(open("branches.json"))["branches"]'
    exit
fi
for ((axis = 0; axis < axes; ++axis)); do reduced+=("grid.axis.$axis.cells=24"); done
# integrated attractors are searched at every parameter point: fewer points and starts. Flow rates from 0.8
# to 9.4 still show rest, cycles and chaos
[[ $(basename "$scene") != relief_valve_basins.toml ]] ||
    reduced+=(grid.axis.0.cells=8 question.samples=8)
# sweeps: two points along every axis that has a number of them
axis=0
for key in $(grep -oE "^(points|values)" "$scene"); do
    [ "$key" = values ] || reduced+=("sweep.axis.$axis.points=2")
    axis=$((axis + 1))
done
"$program" run "$scene" "${reduced[@]}" accuracy.audit_cells=5 --quiet -o map.h5
"$program" verify map.h5 --cells 2
