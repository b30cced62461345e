#!/usr/bin/env bash
# Every source of the benchmarks compiles as the build would compile it, but no object is made: they are no part of
# the program's build and must not fall behind. Usage: test_compiles.sh NINJA BUILD_FOLDER; 77: not built by Ninja.
set -uo pipefail
ninja=$1
cd "$2" || exit 1
[ -f build.ninja ] || { echo "the build tree is not Ninja's"; exit 77; }
# the commands of the target `benchmarks` that compile a file of bench/; each source once
"$ninja" -t commands benchmarks | grep -E ' -c [^ ]*bench/[^ ]+$' |
    sed -E 's/^([^ ]*ccache )?//; s/ -MD -MT [^ ]+ -MF [^ ]+//; s/ -o [^ ]+ -c / -fsyntax-only /' |
    sort -u >bench_sources.txt
[ "$(wc -l <bench_sources.txt)" -gt 20 ] || { echo "FAILED: only $(wc -l <bench_sources.txt) sources found"; exit 1; }
failed=0
while read -r command; do
    bash -c "$command" || { echo "FAILED: ${command##* }"; failed=1; }
done <bench_sources.txt
exit $failed
