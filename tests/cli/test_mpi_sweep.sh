#!/usr/bin/env bash
# A sweep by several ranks is one pool of tiles: ranks that find no further map compute tiles of the others'
# maps. The maps are those of one process, also after a signal or the death of a rank.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"
source "$source_folder/tests/cli/ranks.sh"

# three maps by two ranks: one of them computes the third one, the costliest, the other helps
sweep=("$source_folder/configs/scenes/quickstart.toml" grid.axis.0.cells=500 grid.axis.1.cells=500
    "output.tile=[25, 25]" accuracy.audit_cells=0 --quiet --threads 1 --backend scalar
    sweep.axis.0.name=damping_ratio "sweep.axis.0.values=[0.1, 0.0, 0.05]")
hash_of() { grep '^  "hash"' "$1" | cut -d'"' -f4; }
fact_of() { sed -n "s/^  \"$1\": \(.*\),$/\1/p" "$2"; }
hopscotch run "${sweep[@]}" -o one.h5 >out.txt 2>&1
hash=$(hash_of one.json)
[ -n "$hash" ] || fail "one process computes a sweep" "$(cat out.txt)"
claim_equal "and has nobody to help" 0 "$(fact_of tiles_helped one.json)"
ranks 2 run "${sweep[@]}" -o two.h5 >out.txt 2>&1
claim_equal "two ranks give the same maps" "$hash" "$(hash_of two.json)"
[ "$(fact_of tiles_helped two.json)" -gt 0 ] || fail "a rank without a map of its own helps" "$(head -n 12 two.json)"
claim_equal "every cell is computed once" 750000 "$(fact_of cells_computed two.json)"
claim_exit "the maps are sound" 0 hopscotch verify two.h5
ranks 4 run "${sweep[@]}" -o four.h5 >out.txt 2>&1
claim_equal "more ranks than maps compute each together" "$hash" "$(hash_of four.json)"

# an owner's search finds more on a second pass, or refines: helpers take part in the first pass only
searched=("$source_folder/configs/scenes/cham2007_stride_sweep.toml" grid.axis.0.cells=32 grid.axis.1.cells=32
    "output.tile=[4, 16]" accuracy.audit_cells=0 --quiet --threads 1 sweep.axis.0.points=3
    "sweep.axis.1.values=[0.2]")
for kind in plain refined; do
    [ $kind = plain ] || searched+=(grid.refine=2)
    hopscotch run "${searched[@]}" -o $kind.h5 >out.txt 2>&1
    ranks 2 run "${searched[@]}" -o ${kind}2.h5 >out.txt 2>&1
    [ -s $kind.json ] || fail "a $kind sweep is computed" "$(cat out.txt)"
    claim_equal "searched attractors, $kind maps: the same" "$(hash_of $kind.json)" "$(hash_of ${kind}2.json)"
done

begin() {  # NAME: two ranks, until there are tiles
    mpirun --quiet -n 2 "$program" run "${sweep[@]}" -o "$1.h5" >out.txt 2>err.txt &
    job=$!
    wait_for_tiles "$1.h5.maps" 5
}
resume() {  # NAME CLAIM
    ranks 2 run "${sweep[@]}" -o "$1.h5" --resume >out.txt 2>err.txt
    claim_equal "$2" "$hash" "$(hash_of "$1.json")"
    [ "$(fact_of cells_computed "$1.json")" -lt 750000 ] || fail "$2, with what was there" "all cells were computed"
}
begin signalled
kill -USR1 $job
code=0
wait $job || code=$?
claim_equal "a signalled sweep is resumable" 75 $code
resume signalled "and goes on to the same maps"
begin killed
kill -9 "$(ranks_of $job | tail -n 1)"
wait $job && fail "a sweep with a dead rank fails" "exit code 0"
resume killed "after the death of a rank it goes on to the same maps"
exit $failed
