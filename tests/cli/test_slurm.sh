#!/usr/bin/env bash
# The batch scripts in a real Slurm of one node: a job array and an MPI job give the map of one process;
# a job whose time runs out finishes its tiles, is queued again and goes on.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"
source "$source_folder/tests/cli/slurm_node.sh"
export HOPSCOTCH_HOME=$source_folder HOPSCOTCH_PROGRAM=$program
hash_of() { grep '"hash"' "$1" | cut -d'"' -f4; }
n_tiles_in() { find "$1" -name 'tile_*.h5' 2>/dev/null | wc -l; }
slurm=$source_folder/configs/slurm

small_map -o one.h5 >out.txt 2>&1
hash=$(hash_of one.json)
array=$(sbatch --parsable --array=1-3 "$slurm/array.sbatch" "${small[@]}" -o array.h5)
merge=$(sbatch --parsable --dependency=afterok:"$array" "$slurm/merge.sbatch" array.h5)
wait_for_job "$array"
wait_for_job "$merge"
claim_equal "a job array and its merge give the map of one process" "$hash" "$(hash_of array.json)"
[ "$hash" = "$(hash_of array.json)" ] || tail -n 5 slurm-*.out

if "$program" version | grep -q 'built without MPI'; then
    echo "MPI job left out: the program is built without MPI"
    exit $failed
fi
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
if srun --mpi=list 2>&1 | grep -q pmix; then
    job=$(sbatch --parsable --ntasks=3 "$slurm/mpi.sbatch" "${small[@]}" -o srun.h5)
    wait_for_job "$job"
    claim_equal "ranks started by srun give the map of one process" "$hash" "$(hash_of srun.json)"
    claim_contains "and work together" '"ranks": 3' srun.json
fi
if command -v mpirun >/dev/null; then
    job=$(HOPSCOTCH_LAUNCHER=mpirun sbatch --parsable --ntasks=3 "$slurm/mpi.sbatch" "${small[@]}" -o mpirun.h5)
    wait_for_job "$job"
    claim_equal "so do ranks started by mpirun" "$hash" "$(hash_of mpirun.json)"
    claim_contains "together" '"ranks": 3' mpirun.json
fi

# Slurm's warning comes long before the job's end; the tiles in flight are finished, the job starts again
large=("${small[@]}" grid.axis.0.cells=3000 grid.axis.1.cells=3000 "output.tile=[50, 50]" --backend scalar)
hopscotch run "${large[@]}" -o whole.h5 >out.txt 2>&1
interrupted() {  # NAME SBATCH_ARGUMENTS...: a job that gets USR1 once it has tiles
    local name=$1 job
    shift
    job=$(sbatch --parsable "$@" "${large[@]}" -o "$name.h5")
    for _ in $(seq 300); do
        [ "$(n_tiles_in "$name.h5.tiles")" -gt 3 ] && break
        sleep 0.05
    done
    scancel --batch --signal=USR1 "$job"
    for _ in $(seq 300); do
        scontrol show job "$job" -o | grep -q ' Restarts=1 ' && break
        sleep 0.1
    done
    claim_contains "$name: an interrupted job is queued again" "queued again" "slurm-$job.out"
    before=$(n_tiles_in "$name.h5.tiles")
    [ "$before" -gt 3 ] || fail "$name: finished tiles are kept" "only $before tiles"
    [ "$before" -lt 3600 ] || fail "$name: the job is interrupted in the middle" "all tiles are there"
    sleep 2  # slurmd refuses credentials of the second in which it revoked the last one
    for _ in $(seq 100); do  # Slurm waits for its credentials to expire; a test does not
        scontrol update JobId="$job" StartTime=now 2>/dev/null && break
        sleep 0.1
    done
    wait_for_job "$job"
    claim_equal "$name: the restarted job gives the map of one process" \
        "$(hash_of whole.json)" "$(hash_of "$name.json")"
    claim_contains "$name: it went on with the finished tiles" '"cells_computed"' "$name.json"
    [ "$(sed -n 's/.*"cells_computed": \([0-9]*\).*/\1/p' "$name.json")" -lt 9000000 ] ||
        fail "$name: finished tiles are not computed again" "all cells were computed"
}
interrupted mpi --ntasks=2 "$slurm/mpi.sbatch"

# the last task of an array has the array's number in Slurm: only that task is queued again
array=$(sbatch --parsable --array=1-2 "$slurm/array.sbatch" "${large[@]}" -o tasks.h5)
for _ in $(seq 300); do
    [ "$(n_tiles_in tasks.h5.tiles)" -gt 30 ] && break
    sleep 0.05
done
scancel --batch --signal=USR1 "${array}_2"
for _ in $(seq 300); do
    grep -q "queued again" "slurm-${array}_2.out" 2>/dev/null && break
    sleep 0.1
done
claim_contains "an interrupted task of an array is queued again" "queued again" "slurm-${array}_2.out"
wait_for_job "${array}_1"
claim_contains "the others go on" "shard 1/2 of tasks.h5: all of its" "slurm-${array}_1.out"
claim_equal "without being queued again" "" "$(grep "queued again" "slurm-${array}_1.out")"
sleep 2  # as above
for _ in $(seq 200); do
    scontrol update JobId="${array}_2" StartTime=now 2>/dev/null && break
    sleep 0.1
done
wait_for_job "${array}_2"
claim_exit "and the task goes on to its end" 0 hopscotch merge tasks.h5
claim_equal "with the map of one process" "$(hash_of whole.json)" "$(hash_of tasks.json)"

# no time left: the wall time is read from the job
job=$(HOPSCOTCH_MARGIN=10000 sbatch --parsable --time=1:00 --ntasks=2 "$slurm/mpi.sbatch" "${small[@]}" -o late.h5)
for _ in $(seq 300); do
    grep -q "queued again" "slurm-$job.out" 2>/dev/null && break
    sleep 0.1
done
claim_contains "a job without time left stops in time" "queued again" "slurm-$job.out"
[ $failed = 0 ] || { squeue -t all && tail -n 12 "$cluster/slurmctld.log" "slurm-$job.out"; }
scancel "$job"
exit $failed
