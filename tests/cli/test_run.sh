#!/usr/bin/env bash
# `run` writes map, picture and summary; its hash is the same for every backend, thread count, tile and
# interruption; `info`, `verify`, `replay` and `render` read what it wrote.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"

claim_exit "a dry run computes nothing" 0 small_map --dry-run
claim_contains "but says what would be" "bytes      75600 before compression" out.txt
claim_equal "and writes nothing" "" "$(ls ./*.h5 2>/dev/null)"

claim_exit "a map is computed" 0 small_map -o map.h5
for file in map.h5 map.json map.png; do
    [ -s $file ] || fail "map, summary and picture are written" "no $file"
done
hash=$(grep '^hash' out.txt | awk '{print $2}')
claim_contains "the audit stands in the summary" "audit_wrong" map.json
claim_exit "an existing map is not overwritten" 4 small_map -o map.h5
claim_exit "a finished map resumes to itself" 0 small_map -o map.h5 --resume

hash_of() { grep '"hash"' "$1" | cut -d'"' -f4; }
claim_equal "text and JSON agree" "$hash" "$(hash_of map.json)"
for backend in scalar avx2 avx512; do
    small_map -o $backend.h5 --backend $backend >out.txt 2>&1
    code=$?
    [ $code = 5 ] && continue  # this processor has it not
    claim_equal "$backend gives the same map" "$hash" "$(hash_of $backend.json)"
done
small_map -o tiles.h5 --threads 1 output.tile='[7, 90]' >out.txt 2>&1
claim_equal "one thread and other tiles give the same map" "$hash" "$(hash_of tiles.json)"

small_map -o flags.h5 output.layers='["label", "uncertain"]' >out.txt 2>&1
flags=$(hash_of flags.json)
small_map -o flags_scalar.h5 --backend scalar output.tile='[7, 90]' output.layers='["label", "uncertain"]' >out.txt 2>&1
claim_equal "uncertain cells do not depend on backend and tiles" "$flags" "$(hash_of flags_scalar.json)"

claim_exit "sums are verified and cells recomputed" 0 hopscotch verify map.h5 --cells 10
claim_contains "and they hold" "wrong             0" out.txt
claim_contains "with the errors of their numbers" "error of returns" out.txt
claim_contains "the worst audited cell can be replayed" "hopscotch replay map.h5 --cell" map.json
claim_exit "one cell is replayed" 0 hopscotch replay map.h5 --cell 60,45
claim_contains "and its label holds" "the stored label holds" out.txt
claim_exit "a cell outside the map is usage" 2 hopscotch replay map.h5 --cell 120,0
claim_exit "a map tells what it is" 0 hopscotch info map.h5
claim_exit "a map is drawn" 0 hopscotch render map.h5 -o picture.png
[ -s picture.png ] || fail "a map is drawn" "no picture.png"

# an interrupt in the middle of a larger map, then the same command with --resume
large=("${small[@]}" grid.axis.0.cells=3000 grid.axis.1.cells=3000 "output.tile=[100, 100]")
hopscotch run "${large[@]}" -o whole.h5 >out.txt 2>&1
"$program" run "${large[@]}" -o part.h5 >out.txt 2>err.txt &
job=$!
for _ in $(seq 100); do
    [ "$(find part.h5.tiles -name 'tile_*' 2>/dev/null | wc -l)" -gt 3 ] && break
    sleep 0.05
done
kill -TERM $job
wait $job
claim_equal "a terminated run is resumable" 75 $?
claim_contains "and says how" "--resume" err.txt
hopscotch run "${large[@]}" -o part.h5 --resume >out.txt 2>&1
claim_equal "the resumed map is the same" "$(hash_of whole.json)" "$(hash_of part.json)"
exit $failed
