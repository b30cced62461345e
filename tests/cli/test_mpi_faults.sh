#!/usr/bin/env bash
# What goes wrong on clusters, done for real: a rank killed in mid-tile, a second job in the same
# directory, a full disk, a damaged tile, kills at random moments. Nothing finished is lost and the
# resumed map is the same.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"
source "$source_folder/tests/cli/ranks.sh"
source "$source_folder/tests/cli/kills.sh"

large=("${small[@]}" grid.axis.0.cells=1400 grid.axis.1.cells=1400 "output.tile=[50, 50]" --backend scalar)
hopscotch run "${large[@]}" -o whole.h5 >out.txt 2>&1
hash=$(hash_of whole.json)
sums_of() { (cd "$1" && sha256sum tile_*.h5 2>/dev/null | sort); }

# resumed: the tiles listed in kept.txt are still there until the end, and the map is the undisturbed one
resume() {  # NAME N CLAIM
    ranks "$2" run "${large[@]}" -o "$1.h5" --resume >out.txt 2>err.txt
    claim_equal "$3" "$hash" "$(hash_of "$1.json")"
    claim_exit "$1: the map is sound" 0 hopscotch verify "$1.h5"
}

# any rank, 0 (which owns the run) included
for rank in 0 2; do
    mpirun --quiet -n 3 "$program" run "${large[@]}" -o killed$rank.h5 >out.txt 2>err.txt &
    job=$!
    wait_for_tiles killed$rank.h5.tiles 5
    kill -9 "$(ranks_of $job | sed -n $((rank + 1))p)"
    code=0
    wait $job || code=$?
    [ $code != 0 ] || fail "a job with a dead rank fails" "exit code 0"
    for _ in $(seq 100); do ranks_alive=$(pgrep -f -- "-o killed$rank.h5" | wc -l); [ "$ranks_alive" = 0 ] && break; sleep 0.1; done
    claim_equal "and leaves no rank behind" 0 "$ranks_alive"
    sums_of killed$rank.h5.tiles >before.txt
    [ "$(wc -l <before.txt)" -gt 5 ] || fail "finished tiles are there" "$(wc -l <before.txt)"
    ranks 2 run "${large[@]}" -o killed$rank.h5 --resume --walltime 0 >out.txt 2>err.txt
    claim_contains "the dead run's lock is explained" "which runs no longer" err.txt
    sums_of killed$rank.h5.tiles >after.txt
    claim_equal "every finished tile is kept as it was" "" "$(comm -23 before.txt after.txt)"
    resume killed$rank 2 "after the death of rank $rank the resumed map is the same"
done

# two jobs in one directory; a lock left on another machine
mpirun --quiet -n 2 "$program" run "${large[@]}" -o twice.h5 >first.txt 2>&1 &
job=$!
wait_for_tiles twice.h5.tiles 2
ranks 2 run "${large[@]}" -o twice.h5 --resume >out.txt 2>err.txt
claim_equal "a second job is refused" 4 $?
claim_equal "in one line" 1 "$(grep -c '^hopscotch: ' err.txt)"
grep -qE 'another run works here: process [0-9]+ on .*, started .*Z \([0-9:]+ ago\)\); wait for it' err.txt ||
    fail "which names the owner and its age" "$(cat err.txt)"
wait $job
claim_equal "and the first does not notice" "$hash" "$(hash_of twice.json)"
mkdir other.h5.tiles
echo "process 7 host far-away since 2020-01-01T00:00:00Z job - start 0" >other.h5.tiles/lock
ranks 2 run "${large[@]}" -o other.h5 --resume >out.txt 2>err.txt
claim_equal "a lock of another machine is not taken over" 4 $?
claim_contains "but explained" "last sign of life" err.txt
rm other.h5.tiles/lock
resume other 2 "once it is removed the map is computed"

# the disk of one rank is full: it sees a file system of its own, just large enough to join the run
stopped() {  # NAME: a run that has been stopped with more than 8 tiles
    mpirun --quiet -n 2 "$program" run "${large[@]}" -o "$1.h5" >out.txt 2>err.txt &
    local job=$!
    wait_for_tiles "$1.h5.tiles" 8
    kill -USR1 $job
    wait $job
}
stopped full
cat >own_disk.sh <<'END'
cp full.h5.tiles/run.h5 run.h5 && mount -t tmpfs -o size=128k tmpfs full.h5.tiles && mv run.h5 full.h5.tiles && exec "$@"
END
if unshare -m true 2>unshare.txt; then
    mpirun --quiet -n 1 "$program" run "${large[@]}" -o full.h5 --resume \
        : -n 1 unshare -m sh own_disk.sh "$program" run "${large[@]}" -o full.h5 --resume >out.txt 2>err.txt
    claim_equal "a rank with a full disk ends the job" 4 $?
    claim_equal "in one line" 1 "$(grep -c '^hopscotch: ' err.txt)"
    claim_contains "in which rank 0 names it" "rank 1 on" err.txt
    claim_contains "with its reason" "No space left on device" err.txt
else
    echo "full disk of one rank left out: $(cat unshare.txt)"
fi
resume full 3 "tiles of the other rank are kept and the map completed"

# a disk that is really full: a small file system of our own, where the kernel lets us have one
mkdir small_disk
if mount -t tmpfs -o size=600k tmpfs small_disk 2>mount.txt; then
    ranks 2 run "${large[@]}" -o small_disk/map.h5 >out.txt 2>err.txt
    claim_equal "a full disk ends the job" 4 $?
    claim_contains "with the reason" "No space left on device" err.txt
    claim_contains "and a way out" "free some space and go on with --resume" err.txt
    n_before=$(n_tiles_in small_disk/map.h5.tiles)
    [ "$n_before" -gt 2 ] || fail "finished tiles stay on a full disk" "$n_before"
    mount -o remount,size=60m small_disk
    ranks 2 run "${large[@]}" -o small_disk/map.h5 --resume >out.txt 2>err.txt
    claim_equal "with more room the map is completed" "$hash" "$(hash_of small_disk/map.json)"
    umount small_disk
else
    echo "full disk left out: no mount here ($(cat mount.txt))"
fi

# tiles damaged between two starts: one truncated, one altered, one empty
stopped damaged
mapfile -t tiles < <(find damaged.h5.tiles -name 'tile_*' | sort | head -n 3)
truncate -s 700 "${tiles[0]}"
size=$(stat -c %s "${tiles[1]}")
head -c $((size / 3)) /dev/zero | tr '\0' '\377' |
    dd of="${tiles[1]}" bs=1 seek=$((size / 3)) conv=notrunc 2>/dev/null
: >"${tiles[2]}"
ranks 2 run "${large[@]}" -o damaged.h5 --resume >out.txt 2>err.txt
claim_equal "damaged tiles are computed again" "$hash" "$(hash_of damaged.json)"
for tile in "${tiles[@]}"; do
    claim_contains "and named" "$(basename "$tile") (" err.txt
done

# any rank at any moment, also while ranks connect or the map is packed (slow_kills_of_ranks.sh: a hundred)
mkdir random && cd random || exit 1
kill_ranks 5
exit $failed
