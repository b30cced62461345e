#!/usr/bin/env bash
# An installed Hopscotch builds a program with a user's own model, found by find_package.
# Usage: test_consumer.sh BUILD_DIR SOURCE_DIR
set -euo pipefail
build=$1
source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$work/prefix/bin/hopscotch" models >/dev/null
cp -r "$source/tests/install/consumer" "$work/consumer"
cmake -S "$work/consumer" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/log" 2>&1 ||
    { cat "$work/log"; exit 1; }
cmake --build "$work/build" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
cd "$work"
./build/my_hopscotch run consumer/ball.toml --quiet
./build/my_hopscotch models | grep -q '^passive_hopper' || { echo "the built-in models are gone"; exit 1; }
printf 'speed,restitution\n4,0.5\n' >rows.csv
./build/my_hopscotch eval bouncing_ball --section bounce --returns 3 --input rows.csv | tee rows.out
grep -q '^0,ok,3,3,.*,0\.5$' rows.out || { echo "e^3 v is 0.5"; exit 1; }
