# Shared by the tests with a batch system: `source slurm_node.sh` after claims.sh starts munge, slurmctld
# and slurmd of a cluster of this one machine, with configuration, keys and sockets in the scratch folder,
# and ends them with the test. Leaves with 77 ("skipped") and the reason where they cannot run.
skip() {
    echo "skipped: $*"
    exit 77
}
export PATH=$PATH:/usr/sbin
for command in munged slurmctld slurmd sbatch; do
    command -v $command >/dev/null || skip "no $command (packages slurm-wlm and munge)"
done
[ "$(id -u)" = 0 ] || skip "slurmd starts jobs as their users, for which it must be root"

cluster=$scratch/cluster
mkdir -p -m 755 "$cluster"/{munge,state,spool,tmp}
node=$(hostname -s)
port=$((20000 + RANDOM % 20000))
export SLURM_CONF=$cluster/slurm.conf
daemons=()

stop_cluster() {
    squeue -h -o %A 2>/dev/null | xargs -r scancel 2>/dev/null
    for _ in $(seq 50); do [ -z "$(squeue -h 2>/dev/null)" ] && break; sleep 0.1; done
    for daemon in "${daemons[@]}"; do kill "$daemon" 2>/dev/null; done
    wait "${daemons[@]}" 2>/dev/null
    rm -rf "$scratch"
}
trap stop_cluster EXIT

cat >"$SLURM_CONF" <<END
ClusterName=hopscotch_test
SlurmctldHost=$node(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$cluster/munge/socket,cred_expire=10
CryptoType=crypto/munge
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd.pid
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool
SlurmctldLogFile=$cluster/slurmctld.log
SlurmdLogFile=$cluster/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
KillWait=5
MinJobAge=86400
TmpFS=$cluster/tmp
FirstJobId=$((1 + RANDOM))
SchedulerParameters=sched_interval=1,batch_sched_delay=0
NodeName=$node NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN
PartitionName=all Nodes=$node Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
END
printf 'CgroupAutomount=no\n' >"$cluster/cgroup.conf"

head -c 1024 /dev/urandom >"$cluster/munge/key"
chmod 400 "$cluster/munge/key"
munged --foreground --force --key-file="$cluster/munge/key" --socket="$cluster/munge/socket" \
    --pid-file="$cluster/munge/pid" --log-file="$cluster/munge/log" --seed-file="$cluster/munge/seed" \
    --num-threads=1 >"$cluster/munged.out" 2>&1 &
daemons+=($!)
for _ in $(seq 50); do [ -S "$cluster/munge/socket" ] && break; sleep 0.1; done
[ -S "$cluster/munge/socket" ] || skip "munged does not start: $(tail -n 2 "$cluster/munged.out")"
slurmctld -D -f "$SLURM_CONF" >"$cluster/slurmctld.out" 2>&1 &
daemons+=($!)
slurmd -D -f "$SLURM_CONF" -N "$node" >"$cluster/slurmd.out" 2>&1 &
daemons+=($!)
for _ in $(seq 150); do
    [ "$(sinfo -h -o %t 2>/dev/null)" = idle ] && break
    sleep 0.2
done
[ "$(sinfo -h -o %t 2>/dev/null)" = idle ] ||
    skip "slurm does not start: $(tail -qn 2 "$cluster"/slurm{ctld,d}.out | tr '\n' ' ')"

# A busy machine takes its time: waits are long and end early.
wait_until() {  # SECONDS COMMAND...: until it succeeds; false where it never does
    local end=$((SECONDS + $1))
    shift
    until "$@"; do
        [ $SECONDS -lt $end ] || return 1
        sleep 0.1
    done
}

n_tiles_in() { find "$1" -name 'tile_*.h5' 2>/dev/null | wc -l; }
has_tiles() { [ "$(n_tiles_in "$1")" -gt "$2" ]; }  # FOLDER N: more than N
says() { grep -qs -- "$2" "$1"; }                  # FILE TEXT

job_facts() { scontrol show job "$1" -o 2>/dev/null; }  # JOB: everything, on one line
has_fact() { job_facts "$1" | grep -qE " ($2)( |$)"; }  # JOB PATTERN of a fact, e.g. Restarts=1
has_ended() {  # JOB, or the number of an array: no task of it waits or runs
    local states
    states=$(squeue -h -j "$1" -t all -o %T 2>/dev/null) || return 1  # a controller that does not answer
    case $states in
        "" | *PENDING* | *RUNNING* | *COMPLETING* | *CONFIGURING* | *REQUEUE* | *SUSPENDED*) return 1 ;;
    esac
}

wait_for_job() {  # JOB [SECONDS]: until it has ended
    wait_until "${2:-300}" has_ended "$1" || fail "job $1 ends" "it is still $(squeue -h -j "$1" -t all)"
}

# Slurm starts a job that was queued again once its old credentials have expired (cred_expire, 10 s).
has_started_again() {  # JOB
    has_fact "$1" "Restarts=1" && has_fact "$1" "JobState=(RUNNING|COMPLETING|COMPLETED)"
}
wait_for_restart() {  # JOB [SETTING=VALUE...], e.g. TimeLimit=30
    local job=$1
    shift
    wait_until 120 has_fact "$job" "Restarts=1"
    [ $# = 0 ] || scontrol update JobId="$job" "$@"
    wait_until 180 has_started_again "$job" || fail "job $job starts again" "$(job_facts "$job")"
}
