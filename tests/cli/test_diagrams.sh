#!/usr/bin/env bash
# Orbit diagrams are maps to their user: killed, stopped, resumed, shared out and looked at while they grow.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"
source "$source_folder/tests/cli/kills.sh"
killed=("$source_folder/configs/scenes/koditschek1991_cascade.toml" grid.axis.0.cells=1500 "output.tile=[25]"
    --quiet --threads 2)
kill_runs 10

long=("${killed[@]}" grid.axis.0.cells=8000)
claim_exit "a diagram's cost is told beforehand" 0 hopscotch run "${long[@]}" --dry-run
claim_contains "with its tiles" "tiles      960 of 25 x 1 x 250 cells" out.txt
"$program" run "${long[@]}" -o long.h5 >out.txt 2>stopped.txt &
job=$!
for _ in $(seq 200); do [ "$(ls long.h5.tiles 2>/dev/null | grep -c tile_)" -ge 3 ] && break; sleep 0.05; done
claim_exit "what there is of a running diagram is drawn" 0 hopscotch render long.h5 -o part.png
kill -TERM $job
wait $job
claim_equal "a diagram told to stop is resumable" 75 $?
claim_contains "and says how" "tiles are done, none is lost); the same command with --resume?" stopped.txt
claim_exit "a diagram without time left is resumable" 75 hopscotch run "${long[@]}" -o long.h5 --resume --walltime 0

for part in 2/2 1/2; do
    claim_exit "shard $part of a diagram is computed" 0 hopscotch run "${killed[@]}" -o parts.h5 --shard $part
done
claim_exit "shards of a diagram are joined" 0 hopscotch merge parts.h5
claim_equal "into the same one" "$(hash_of whole.json)" "$(hash_of parts.json)"
claim_exit "which is sound" 0 hopscotch verify parts.h5
exit $failed
