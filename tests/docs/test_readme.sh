#!/usr/bin/env bash
# Every command in the README runs. Lines of its ```console blocks that begin with ./hopscotch are run in
# order in an empty folder, with the program as it is built; tests and benchmarks are only looked up.
# Usage: test_readme.sh PROGRAM SOURCE_DIR
set -uo pipefail
program=$1
source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
ln -s "$source/configs" "$work/configs"
ln -s "$source/tests" "$work/tests"
cd "$work" || exit 1
failed=0
n=0
while IFS= read -r line; do
    arguments=${line#./hopscotch }
    case $arguments in
        test* | bench*) continue ;;
    esac
    n=$((n + 1))
    if ! eval "\"$program\" $arguments" >out.txt 2>&1; then
        echo "README command fails: $line"
        cat out.txt
        failed=1
    fi
done < <(awk '/^```console/ {inside=1; next} /^```/ {inside=0} inside' "$source/README.md" | grep '^\./hopscotch')
[ "$n" -ge 8 ] || { echo "only $n commands found in the README"; failed=1; }
exit $failed
