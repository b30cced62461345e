#!/usr/bin/env bash
# The portable folder runs with an emptied environment, and takes nothing from the machine but the C
# library. Usage: test_portable.sh BUILD_DIR
set -euo pipefail
build=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --component portable --prefix "$work/here" >"$work/log" 2>&1 ||
    { cat "$work/log"; exit 1; }
mv "$work/here" "$work/elsewhere"  # nothing may point to where it was installed
cd "$work/elsewhere"
loaded=$(env -i LD_TRACE_LOADED_OBJECTS=1 ./hopscotch)
foreign=$(grep '=>' <<<"$loaded" | grep -v "=> $work/elsewhere/" |
    grep -vE '^\s*lib(c|m|dl|rt|pthread|resolv|util)\.so' || true)
[ -z "$foreign" ] || { echo "libraries of the machine are used:"; echo "$foreign"; exit 1; }
env -i ./hopscotch models | grep -q '^passive_hopper'
env -i ./hopscotch run scenes/quickstart.toml grid.axis.0.cells=40 grid.axis.1.cells=40 --quiet \
    -o "$work/map.h5" | tee "$work/run.log"
grep -q '^hash' "$work/run.log"
[ -s "$work/map.h5" ]
