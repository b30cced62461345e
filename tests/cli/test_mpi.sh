#!/usr/bin/env bash
# The ranks of an MPI job give the map of one process; errors are told once; a signal or a time limit
# leaves a run that any number of ranks can resume.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"
source "$source_folder/tests/cli/ranks.sh"

small_map -o one.h5 >out.txt 2>&1
hash=$(hash_of one.json)
for n in 2 4; do
    ranks $n run "${small[@]}" -o ranks$n.h5 >out.txt 2>err.txt
    claim_equal "$n ranks end well" 0 $?
    claim_equal "$n ranks give the same map" "$hash" "$(hash_of ranks$n.json)"
    claim_equal "one of them tells" 1 "$(grep -c '^hash' out.txt)"
    claim_contains "and says how many there were" "\"ranks\": $n" ranks$n.json
    claim_exit "the map is sound" 0 hopscotch verify ranks$n.h5
done
ranks 3 run "${small[@]}" -o tiles.h5 output.tile='[7, 90]' --backend scalar >out.txt 2>&1
claim_equal "other tiles by another backend too" "$hash" "$(hash_of tiles.json)"

# a scene whose attractors are searched
searched=("$source_folder/configs/scenes/cham2007_fig8_basins.toml" grid.axis.0.cells=40
    grid.axis.1.cells=40 "output.tile=[7, 11]" accuracy.audit_cells=5 --quiet)
hopscotch run "${searched[@]}" -o searched1.h5 >out.txt 2>&1
ranks 3 run "${searched[@]}" -o searched3.h5 >out.txt 2>&1
claim_equal "searched attractors give the same labels" "$(hash_of searched1.json)" "$(hash_of searched3.json)"

# an orbit diagram: the tiles of a sweep depend on each other, those of starts do not
diagram=("$source_folder/configs/scenes/cham2007_fig5_orbits.toml" grid.axis.0.cells=30 grid.axis.1.cells=3 --quiet)
hopscotch run "${diagram[@]}" -o diagram1.h5 >out.txt 2>&1
ranks 3 run "${diagram[@]}" "output.tile=[8, 1]" -o diagram3.h5 >out.txt 2>&1
claim_equal "an orbit diagram by three ranks is the same" "$(hash_of diagram1.json)" "$(hash_of diagram3.json)"
claim_contains "and they were three" '"ranks": 3' diagram3.json

ranks 2 branch "$source_folder/configs/scenes/cham2007_fig6_branch.toml" -o b.csv >out.txt 2>err.txt
claim_equal "branches are not followed by several ranks" 2 $?
claim_equal "which is said once" 1 "$(grep -c 'hopscotch: ' err.txt)"

# errors: one line of ours, the exit code of one process
ranks 3 run "${small[@]}" -o one.h5 >out.txt 2>err.txt
claim_equal "an existing map is not overwritten" 4 $?
claim_equal "which is said once" 1 "$(grep -c '^hopscotch: ' err.txt)"
ranks 3 run "${small[@]}" -o x.h5 grid.axis.7.cells=3 >out.txt 2>err.txt
claim_equal "a wrong scene ends all ranks" 3 $?
claim_equal "which is said once" 1 "$(grep -c '^hopscotch: ' err.txt)"
mpirun --quiet -n 1 "$program" run "${small[@]}" -o x.h5 : -n 1 "$program" run "${small[@]}" -o y.h5 \
    >out.txt 2>err.txt
claim_equal "ranks with different commands are refused" 3 $?
claim_contains "and the stranger is named" "rank 1 on" err.txt

# every rank on a terminal of its own, where the line is written anew five times a second
cat >on_terminal.sh <<'END'
exec script -qec "$*" "rank$OMPI_COMM_WORLD_RANK.txt"
END
scene=("$source_folder/configs/scenes/quickstart.toml" grid.axis.0.cells=1000 grid.axis.1.cells=1000
    "output.tile=[25,25]" accuracy.audit_cells=0 --backend scalar)  # script's words: no space within
if command -v script >/dev/null; then
    mpirun --quiet -n 2 sh on_terminal.sh "$program" run "${scene[@]}" -o shown.h5 >out.txt 2>&1
    claim_contains "rank 0 shows the progress of all" "cells/s" rank0.txt
    claim_contains "to the end" "100.0 %" rank0.txt
    claim_equal "the other rank writes nothing" "" "$(grep -v '^Script' rank1.txt)"
else
    echo "progress lines left out: no script (bsdutils)"
fi

# stopped by the batch system's signal, by the time limit; resumed by another number of ranks
large=("${small[@]}" grid.axis.0.cells=2000 grid.axis.1.cells=2000 "output.tile=[50, 50]")
hopscotch run "${large[@]}" -o whole.h5 >out.txt 2>&1
mpirun --quiet -n 2 "$program" run "${large[@]}" -o part.h5 >out.txt 2>err.txt &
job=$!
wait_for_tiles part.h5.tiles 3
kill -USR1 $job
wait $job
claim_equal "a signalled job is resumable" 75 $?
claim_contains "and says how" "--resume" err.txt
ranks 3 run "${large[@]}" -o part.h5 --resume --walltime 0:00:00 >out.txt 2>err.txt
claim_equal "a job without time left is resumable" 75 $?
ranks 3 run "${large[@]}" -o part.h5 --resume >out.txt 2>&1
claim_equal "the resumed map is the same" "$(hash_of whole.json)" "$(hash_of part.json)"
exit $failed
