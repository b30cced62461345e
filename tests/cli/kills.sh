# Kills small runs with signal 9 at random moments and resumes them: `source kills.sh` after claims.sh
# defines kill_runs N. Nothing finished may be lost or altered, no map may differ from the undisturbed one.
killed=("$source_folder/configs/scenes/quickstart.toml" grid.axis.0.cells=400 grid.axis.1.cells=300
    "output.tile=[20, 20]" accuracy.audit_cells=20 --quiet --backend scalar --threads 2)

hash_of() { grep '"hash"' "$1" | cut -d'"' -f4; }

# a tile counts as finished once its file has its name
finished_tiles() { (cd map.h5.tiles 2>/dev/null && sha256sum tile_*.h5 2>/dev/null | sort); }

now() { date +%s%N; }

kill_runs() {
    local n=$1 n_killed=0 n_resumed=0 n_maps=0 whole hash begin pause job
    begin=$(now)
    hopscotch run "${killed[@]}" -o whole.h5 >out.txt 2>&1
    whole=$((($(now) - begin) / 1000))  # microseconds from start to picture
    hash=$(hash_of whole.json)
    : >before.txt
    while [ $n_killed -lt "$n" ] && [ $failed = 0 ]; do
        "$program" run "${killed[@]}" -o map.h5 --resume >out.txt 2>err.txt &
        job=$!
        pause=$(((RANDOM * 32768 + RANDOM) % whole))
        sleep "$((pause / 1000000)).$(printf %06d $((pause % 1000000)))"
        kill -9 $job 2>/dev/null
        wait $job 2>/dev/null
        [ $? = 137 ] && n_killed=$((n_killed + 1))
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
    [ "$n_resumed" -gt $((n / 10)) ] || fail "kills come in the middle of runs" "$n_resumed of $n"
}
