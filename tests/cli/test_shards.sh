#!/usr/bin/env bash
# Shards compute their tiles in any order and place; `merge` joins them into the map of one run and says
# what is missing.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"
hash_of() { grep '"hash"' "$1" | cut -d'"' -f4; }
n_tiles_in() { find "$1" -name 'tile_*.h5' | wc -l; }

small_map -o one.h5 >out.txt 2>&1  # 4 x 3 tiles
for part in 3/3 1/3; do
    claim_exit "shard $part is computed" 0 small_map -o map.h5 --shard $part
    claim_contains "and says what comes next" "merge map.h5" out.txt
done
claim_equal "each has its own tiles" 8 "$(n_tiles_in map.h5.tiles)"
claim_exit "a shard is missing" 4 hopscotch merge map.h5
claim_contains "and named" "4 tiles of 12 missing, the first one is 1: shard 2/3 lacks 4 of 4, never begun" err.txt
claim_contains "with the way out" "--resume --shard 2/3 and merge again?" err.txt
claim_exit "a shard is not computed twice" 4 small_map -o map.h5 --shard 1/3
claim_exit "a shard out of time is resumable" 75 small_map -o map.h5 --shard 2/3 --walltime 0
claim_exit "what it lacks is said" 4 hopscotch merge map.h5
claim_contains "and that it has begun" "shard 2/3 lacks 4 of 4, begun by process" err.txt
claim_exit "it goes on" 0 small_map -o map.h5 --shard 2/3 --resume
claim_exit "what is there can be verified before it is joined" 0 hopscotch verify map.h5
claim_contains "and has no hash yet" "none yet (all tiles are there, the run is not finished)" out.txt
claim_exit "shards are joined" 0 hopscotch merge map.h5
claim_equal "into the map of one run" "$(hash_of one.json)" "$(hash_of map.json)"
[ -s map.png ] || fail "with its picture" "no map.png"
claim_exit "the map is sound" 0 hopscotch verify map.h5 --cells 10
claim_equal "no run directory is left" "" "$(ls -d map.h5.tiles 2>/dev/null)"
claim_exit "a joined map stays" 0 hopscotch merge map.h5

# machines without a common file system: folders are brought together afterwards
mkdir a b c
small_map -o a/map.h5 --shard 1/2 >out.txt 2>&1
small_map -o b/map.h5 --shard 2/2 >out.txt 2>&1
claim_exit "folders of other machines are joined" 0 hopscotch merge c/map.h5 a/map.h5.tiles b/map.h5.tiles
claim_equal "into the same map" "$(hash_of one.json)" "$(hash_of c/map.json)"
truncate -s 900 a/map.h5.tiles/tile_000000004.h5
claim_exit "a damaged tile is not taken" 4 hopscotch merge c/again.h5 a/map.h5.tiles b/map.h5.tiles
claim_contains "but missing" "1 tile of 12 missing, the first one is 4: shard 1/2 lacks 1 of 6" err.txt
claim_contains "and told why" "tile_000000004.h5 (" err.txt
small_map -o c/other.h5 grid.axis.0.max=14 --shard 1/2 >out.txt 2>&1
claim_exit "tiles of another scene are refused" 4 hopscotch merge c/other.h5 b/map.h5.tiles
claim_contains "by their fingerprint" "belongs to another scene" err.txt

# usage
for part in 0/3 4/3 x 1/0 1/2/3; do
    claim_exit "--shard $part is no shard" 2 small_map -o x.h5 --shard $part
done
claim_exit "nothing to merge is said" 4 hopscotch merge nothing.h5
claim_contains "with the name looked for" "nothing.h5.tiles" err.txt

# attractors that are searched: the same labels from every shard, the second search at the join
searched=("$source_folder/configs/scenes/cham2007_fig8_basins.toml" grid.axis.0.cells=30
    grid.axis.1.cells=30 "output.tile=[8, 8]" accuracy.audit_cells=5 --quiet)
hopscotch run "${searched[@]}" -o searched1.h5 >out.txt 2>&1
for part in 1/2 2/2; do hopscotch run "${searched[@]}" -o searched.h5 --shard $part >out.txt 2>&1; done
claim_exit "shards of a searched scene are joined" 0 hopscotch merge searched.h5
claim_equal "into the same map" "$(hash_of searched1.json)" "$(hash_of searched.json)"

# a refined map: shards compute the coarse grid, the join what lies below it
refined=("${searched[@]}" grid.refine=2)
hopscotch run "${refined[@]}" -o refined1.h5 >out.txt 2>&1
claim_exit "a shard of a refined map is computed" 0 hopscotch run "${refined[@]}" -o refined.h5 --shard 2/2
claim_exit "without the other the grid is not refined" 4 hopscotch merge refined.h5
claim_contains "and the other is named" "shard 1/2 lacks 8 of 8, never begun" err.txt
hopscotch run "${refined[@]}" -o refined.h5 --shard 1/2 >out.txt 2>&1
claim_exit "shards of a refined map are joined" 0 hopscotch merge refined.h5
claim_equal "into the same map" "$(hash_of refined1.json)" "$(hash_of refined.json)"
claim_contains "which is refined" '"refine_saved_share": 0.' refined.json

for part in 1/2 2/2; do hopscotch run "${searched[@]}" -o stale.h5 --shard $part >out.txt 2>&1; done
printf 0123456789abcdef >stale.h5.tiles/plan.kept
claim_exit "tiles labelled by another search are not joined" 4 hopscotch merge stale.h5
claim_contains "which is said" "other attractors" err.txt
exit $failed
