#!/usr/bin/env bash
# compute-sanitizer over every model's kernels, on a machine with a GPU: memory errors, races, reads of
# what was never written. Usage: sanitize.sh BUILD_DIR [--gtest_filter=...]
set -euo pipefail
build=$1
shift
[ $# -gt 0 ] || set -- '--gtest_filter=*bits_of_one_double*:*exponents_of_one_orbit*'
command -v compute-sanitizer >/dev/null || { echo "SKIPPED: there is no compute-sanitizer"; exit 77; }
if ! "$build/hopscotch" version | grep -q '^backend *cuda *available'; then
    echo "SKIPPED: $("$build/hopscotch" version | grep '^backend *cuda')"
    exit 77
fi
for tool in memcheck racecheck initcheck; do
    echo "== $tool"
    compute-sanitizer --tool "$tool" --error-exitcode 1 "$build/tests/cuda/test_gpu" --gtest_brief=1 "$@"
done
