# Shared by the batch scripts beside it: find the program, read how long the job may run, pass Slurm's
# warning on, queue the job again where its time was too short. Sourced, never submitted.

# The checkout: where the job was submitted from, or HOPSCOTCH_HOME. The program is the one built there,
# or HOPSCOTCH_PROGRAM; jobs build nothing.
program=${HOPSCOTCH_PROGRAM:-$home/build/release/hopscotch}
if [ ! -x "$program" ]; then
    echo "$program (no program); ./hopscotch version on the login node, or HOPSCOTCH_PROGRAM?" >&2
    exit 2
fi

# This job; a task of an array by its own name, because the number of the last one stands for all of them.
job=$SLURM_JOB_ID
[ -z "${SLURM_ARRAY_JOB_ID:-}" ] || job=${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID

# --walltime SECONDS: what Slurm says is left of this job, less the seconds that finishing a tile and
# packing the map may take (HOPSCOTCH_MARGIN); nothing for a job without a limit.
walltime_option() {
    local end left
    end=$(squeue -h -j "$job" -o %e) || return 0
    end=$(date -d "$end" +%s 2>/dev/null) || return 0
    left=$((end - $(date +%s) - ${HOPSCOTCH_MARGIN:-60}))
    echo "--walltime $((left > 0 ? left : 0))"
}

# Runs a command. USR1 (#SBATCH --signal) and TERM (scancel, preemption) are passed on as USR1, upon which
# tiles in flight are finished. Leaves the command's exit code in $code.
run_to_the_end() {
    "$@" &
    local child=$!
    trap 'kill -USR1 $child 2>/dev/null' USR1 TERM
    code=0
    wait $child || code=$?
    while kill -0 $child 2>/dev/null; do  # a trap has ended the wait, not the command
        code=0
        wait $child || code=$?
    done
    trap - USR1 TERM
}

# 75: interrupted, nothing lost. The job is queued again under its number and goes on with --resume.
leave() {
    if [ "$code" = 75 ]; then
        echo "hopscotch: job $job has not finished and is queued again" >&2
        scontrol requeue "$job"
    fi
    exit "$code"
}
