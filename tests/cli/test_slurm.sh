#!/usr/bin/env bash
# The batch scripts in a real Slurm of one node: a job array and an MPI job give the map of one process;
# a job whose time runs out finishes its tiles, is queued again and goes on.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"
source "$source_folder/tests/cli/slurm_node.sh"
export HOPSCOTCH_HOME=$source_folder HOPSCOTCH_PROGRAM=$program
hash_of() { grep '"hash"' "$1" | cut -d'"' -f4; }
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
job=$(HOPSCOTCH_LAUNCHER=true sbatch --parsable --ntasks=2 "$slurm/mpi.sbatch" "${small[@]}" -o never.h5)
wait_for_job "$job"
claim_contains "a launcher that starts no rank and says nothing is no success" "not finished" "slurm-$job.out"
has_fact "$job" "JobState=FAILED" || fail "and fails its job" "$(job_facts "$job")"
if command -v mpirun >/dev/null; then
    job=$(HOPSCOTCH_LAUNCHER=mpirun sbatch --parsable --ntasks=3 "$slurm/mpi.sbatch" "${small[@]}" -o mpirun.h5)
    wait_for_job "$job"
    claim_equal "so do ranks started by mpirun" "$hash" "$(hash_of mpirun.json)"
    claim_contains "together" '"ranks": 3' mpirun.json
fi

# Slurm's warning comes long before the job's end; the tiles in flight are finished, the job starts again
large=("${small[@]}" grid.axis.0.cells=2400 grid.axis.1.cells=2400 "output.tile=[50, 50]" --backend scalar)
hopscotch run "${large[@]}" -o whole.h5 >out.txt 2>&1
job=$(sbatch --parsable --ntasks=2 "$slurm/mpi.sbatch" "${large[@]}" -o mpi.h5)
wait_until 120 has_tiles mpi.h5.tiles 3 || fail "the MPI job begins" "$(cat "slurm-$job.out")"
scancel --batch --signal=USR1 "$job"
wait_until 120 says "slurm-$job.out" "queued again"
claim_contains "an interrupted MPI job is queued again" "queued again" "slurm-$job.out"
has_tiles mpi.h5.tiles 3 || fail "its finished tiles are kept" "$(n_tiles_in mpi.h5.tiles)"
has_tiles mpi.h5.tiles 2303 && fail "it is interrupted in the middle" "all tiles are there"
wait_for_restart "$job"
wait_for_job "$job"
claim_equal "started again it gives the map of one process" "$(hash_of whole.json)" "$(hash_of mpi.json)"
claim_contains "going on" '"cells_computed"' mpi.json
[ "$(sed -n 's/.*"cells_computed": \([0-9]*\).*/\1/p' mpi.json)" -lt 5760000 ] ||
    fail "with the finished tiles" "all cells were computed"

# the last task of an array has the array's number in Slurm: only that task is queued again
array=$(sbatch --parsable --array=1-2 "$slurm/array.sbatch" "${large[@]}" -o tasks.h5)
wait_until 120 has_tiles tasks.h5.tiles 30 || fail "the array begins" "$(cat slurm-"${array}"_*.out)"
scancel --batch --signal=USR1 "${array}_2"
wait_until 120 says "slurm-${array}_2.out" "queued again"
claim_contains "an interrupted task of an array is queued again" "queued again" "slurm-${array}_2.out"
wait_for_job "${array}_1"
claim_contains "the others go on" "shard 1/2 of tasks.h5: all of its" "slurm-${array}_1.out"
says "slurm-${array}_1.out" "queued again" && fail "without being queued again" "task 1 was"
wait_for_restart "${array}_2"
wait_for_job "${array}_2"
claim_exit "and the task goes on to its end" 0 hopscotch merge tasks.h5
claim_equal "with the map of one process" "$(hash_of whole.json)" "$(hash_of tasks.json)"

# no time left: the wall time is read from the job
job=$(HOPSCOTCH_MARGIN=10000 sbatch --parsable --time=1:00 --ntasks=2 "$slurm/mpi.sbatch" "${small[@]}" -o late.h5)
wait_until 120 says "slurm-$job.out" "queued again"
claim_contains "a job without time left stops in time" "queued again" "slurm-$job.out"
[ $failed = 0 ] || { squeue -t all && tail -n 12 "$cluster/slurmctld.log" slurm-*.out; }
scancel "$job"
exit $failed
