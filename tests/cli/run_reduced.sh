#!/usr/bin/env bash
# Runs a scene with 24 cells along each axis in an empty folder. Usage: run_reduced.sh PROGRAM SCENE.toml
set -euo pipefail
program=$1
scene=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
reduced=()
axes=$(grep -c '^\[\[grid.axis\]\]' "$scene")
for ((axis = 0; axis < axes; ++axis)); do reduced+=("grid.axis.$axis.cells=24"); done
"$program" run "$scene" "${reduced[@]}" accuracy.audit_cells=5 --quiet -o map.h5
"$program" verify map.h5 --cells 2
