#!/usr/bin/env bash
# Slurm's own --signal before a real time limit: an MPI job and a job array finish their tiles, are queued
# again and go on to the map of one process. Takes some minutes: Slurm counts time limits in them. (One run,
# two cores with a load of 10 to 14: the MPI job was queued again after 76 s with 485 of 2000 tiles, the
# array after 61 s with 538; 17 min 19 s in all.)
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"
source "$source_folder/tests/cli/slurm_node.sh"
export HOPSCOTCH_HOME=$source_folder HOPSCOTCH_PROGRAM=$program
export HOPSCOTCH_MARGIN=-10000  # the program knows of no limit: only the signal can stop it in time
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
hash_of() { grep '"hash"' "$1" | cut -d'"' -f4; }
slurm=$source_folder/configs/slurm

# by the scalar backend two cores take two minutes, of which the signal (30 to 90 s) leaves some
large=("$source_folder/configs/scenes/paddle_sticking.toml" grid.axis.0.cells=5000 grid.axis.1.cells=4000
    "output.tile=[100, 100]" accuracy.audit_cells=5 --quiet)
hopscotch run "${large[@]}" -o whole.h5 >out.txt 2>&1
hash=$(hash_of whole.json)
[ -n "$hash" ] || fail "the undisturbed run gives a map" "$(cat out.txt)"

submit() {  # SBATCH_ARGUMENTS...: with two minutes, of which Slurm tells the last half
    sbatch --parsable --time=2 --signal=B:USR1@30 "$@"
}

claim_interrupted() {  # NAME FILES...: each says that its job is queued again; a part of the tiles is there
    local name=$1 n begin=$SECONDS
    shift
    for file in "$@"; do
        wait_until 300 says "$file" "queued again" ||
            fail "$name at its time limit is queued again" "$(tail -n 3 "$file")"
    done
    n=$(n_tiles_in "$name.h5.tiles")
    echo "$name: queued again after $((SECONDS - begin)) s with $n of 2000 tiles"
    [ "$n" -gt 3 ] || fail "$name: finished tiles are kept" "$n"
    [ "$n" -lt 2000 ] || fail "$name: the limit comes in the middle" "all tiles are there"
}

job=$(submit --ntasks=2 "$slurm/mpi.sbatch" "${large[@]}" --backend scalar -o mpi.h5)
claim_interrupted mpi "slurm-$job.out"
wait_for_restart "$job" TimeLimit=30
wait_for_job "$job" 1200
claim_equal "the MPI job goes on to the map of one process" "$hash" "$(hash_of mpi.json)"
[ "$(sed -n 's/.*"cells_computed": \([0-9]*\).*/\1/p' mpi.json)" -lt 20000000 ] ||
    fail "without computing finished tiles again" "all cells were computed"

job=$(submit --array=1-2 "$slurm/array.sbatch" "${large[@]}" --backend scalar -o array.h5)
claim_interrupted array "slurm-${job}_1.out" "slurm-${job}_2.out"
wait_for_restart "${job}_1" TimeLimit=30
wait_for_restart "${job}_2" TimeLimit=30
wait_for_job "$job" 1200
claim_exit "the shards are there after the array's second start" 0 hopscotch merge array.h5
claim_equal "and are joined into the map of one process" "$hash" "$(hash_of array.json)"
[ $failed = 0 ] || { squeue -t all && tail -n 12 "$cluster/slurmctld.log" slurm-*.out; }
echo "$SECONDS s in all"
exit $failed
