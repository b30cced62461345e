# Kills small runs with signal 9 at random moments and resumes them: `source kills.sh` after claims.sh
# defines kill_runs N and, with ranks.sh before it, kill_ranks N, which kills one rank of an MPI job.
# Nothing finished may be lost or altered, no map may differ from the undisturbed one.
killed=("$source_folder/configs/scenes/quickstart.toml" grid.axis.0.cells=400 grid.axis.1.cells=300
    "output.tile=[20, 20]" accuracy.audit_cells=20 --quiet --backend scalar --threads 2)

hash_of() { grep '"hash"' "$1" | cut -d'"' -f4; }

# a tile counts as finished once its file has its name
finished_tiles() { (cd map.h5.tiles 2>/dev/null && sha256sum tile_*.h5 2>/dev/null | sort); }

now() { date +%s%N; }

one_process() { exec "$program" run "${killed[@]}" "$@"; }
kill_process() {  # JOB: true if it was still there to be killed
    kill -9 "$1" 2>/dev/null
    wait "$1" 2>/dev/null
    [ $? = 137 ]
}

# Open MPI 4.1 may wait for itself for ever when a rank dies while it connects (in PMIx_server_finalize);
# a launcher without living ranks for 20 seconds is ended, and counted.
n_stuck=0
three_ranks() { exec mpirun --quiet -n 3 "$program" run "${killed[@]}" "$@"; }
kill_one_rank() {  # JOB: true if one of its ranks was there to be killed; all have ended when it returns
    local victims victim=
    mapfile -t victims < <(ranks_of "$1")
    if [ ${#victims[@]} -gt 0 ]; then
        victim=${victims[RANDOM % ${#victims[@]}]}
        kill -9 "$victim" 2>/dev/null || victim=
        for _ in $(seq 200); do kill -0 "$1" 2>/dev/null || break; sleep 0.1; done
        if kill -0 "$1" 2>/dev/null; then
            claim_equal "a launcher that does not end has no living rank" "" \
                "$(ps -o stat= --ppid "$1" | grep -v Z)"
            kill -9 "$1"
            n_stuck=$((n_stuck + 1))
        fi
    fi
    wait "$1" 2>/dev/null
    for pid in "${victims[@]}"; do
        for _ in $(seq 500); do [ -e "/proc/$pid" ] || break; sleep 0.02; done
        [ -e "/proc/$pid" ] && fail "all ranks end with the one killed" "$pid is there after 10 s"
    done
    [ -n "$victim" ]
}

kill_runs() { kill_jobs "$1" one_process kill_process; }
kill_ranks() {
    kill_jobs "$1" three_ranks kill_one_rank
    echo "$n_stuck launchers did not end by themselves"
}

kill_jobs() {  # N START KILL
    local n=$1 start=$2 kill=$3 n_killed=0 n_resumed=0 n_maps=0 whole hash begin pause job
    begin=$(now)
    ($start -o whole.h5) >out.txt 2>&1
    whole=$((($(now) - begin) / 1000))  # microseconds from start to picture
    hash=$(hash_of whole.json)
    [ -n "$hash" ] || fail "the undisturbed run gives a map" "$(cat out.txt)"
    : >before.txt
    while [ $n_killed -lt "$n" ] && [ $failed = 0 ]; do
        $start -o map.h5 --resume >out.txt 2>err.txt &
        job=$!
        pause=$(((RANDOM * 32768 + RANDOM) % whole))
        sleep "$((pause / 1000000)).$(printf %06d $((pause % 1000000)))"
        $kill $job && n_killed=$((n_killed + 1))
        if [ -e map.h5 ]; then  # finished, before the kill or by it: the map is whole or not there
            claim_exit "a map that has its name is sound" 0 hopscotch verify map.h5
            claim_equal "and the undisturbed one" "hash              $hash" "$(grep hash out.txt)"
            rm -rf map.*
            : >before.txt
            n_maps=$((n_maps + 1))
            continue
        fi
        finished_tiles >after.txt
        claim_equal "no finished tile is lost or altered (kill $n_killed)" "" "$(comm -23 before.txt after.txt)"
        mv after.txt before.txt
        [ -s before.txt ] && n_resumed=$((n_resumed + 1))
    done
    hopscotch run "${killed[@]}" -o map.h5 --resume >out.txt 2>err.txt
    claim_equal "the last run resumes to the undisturbed map" "$hash" "$(hash_of map.json)"
    echo "$n_killed kills, $n_resumed of them with finished tiles kept, $((n_maps + 1)) maps completed, all equal: $((1 - failed))"
    [ "$n_resumed" -ge $((n / 10)) ] || fail "kills come in the middle of runs" "$n_resumed of $n"
}
