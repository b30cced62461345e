#!/usr/bin/env bash
# Maps from a GPU have the hash of maps from the processor, for labels by proof, searched traps, a chaos
# map and an integrated flow; the file names the device. Usage: test_map.sh PROGRAM SOURCE_DIR
set -euo pipefail
program=$1
scenes=$2/configs/scenes
if ! "$program" version | grep -q '^backend *cuda *available'; then
    echo "SKIPPED: $("$program" version | grep '^backend *cuda')"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
hash_of() {  # backend, scene: the map's hash
    "$program" run "$scenes/$2.toml" grid.axis.0.cells=300 grid.axis.1.cells=200 accuracy.audit_cells=0 \
        --backend "$1" --quiet --force -o "$work/$1.h5" | sed -n 's/^hash *//p'
}
failed=0
for scene in quickstart cham2007_fig8_basins chatterjee2002_lyapunov ghigliazza2005_gravity_basins; do
    device=$(hash_of cuda "$scene")
    processor=$(hash_of scalar "$scene")
    echo "$scene: $device on the GPU, $processor on the processor"
    [ -n "$device" ] && [ "$device" = "$processor" ] || failed=1
    "$program" info "$work/cuda.h5" | grep -q 'device' || { echo "the file does not name the device"; failed=1; }
done
exit $failed
