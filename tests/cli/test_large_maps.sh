#!/usr/bin/env bash
# Maps larger than memory and than one file: planned without being computed, stopped, looked at while they
# grow, resumed, and joined from tile files that stay.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"

scene=$source_folder/configs/scenes/quickstart.toml
claim_exit "a map of 65536 x 65536 cells is planned" 0 \
    hopscotch run "$scene" grid.axis.0.cells=65536 grid.axis.1.cells=65536 --dry-run
claim_contains "its cells are counted" "cells      4294967296" out.txt

# stopped in the middle, with every tile as a file
large=("$scene" grid.axis.0.cells=2000 grid.axis.1.cells=2000 "output.tile=[100, 100]" accuracy.audit_cells=0
    --quiet --keep-tiles)
"$program" run "${large[@]}" -o map.h5 >out.txt 2>err.txt &
job=$!
for _ in $(seq 100); do
    [ "$(find map.h5.tiles -name 'tile_*' 2>/dev/null | wc -l)" -gt 3 ] && break
    sleep 0.02
done
kill -TERM $job
wait $job
claim_equal "a stopped run is resumable" 75 $?

# an unfinished map is drawn: what is there, and grey for what is not
claim_exit "an unfinished map is drawn" 0 hopscotch render map.h5 -o grows.png
[ -s grows.png ] || fail "an unfinished map is drawn" "no grows.png"
claim_exit "its run directory is, too" 0 hopscotch render map.h5.tiles -o grows_too.png
cmp -s grows.png grows_too.png || fail "both pictures are the same" "they differ"
claim_exit "what is missing is told" 0 hopscotch info map.h5
claim_contains "what is missing is told" "tiles are missing" out.txt

claim_exit "the run is resumed" 0 hopscotch run "${large[@]}" -o map.h5 --resume
claim_exit "and complete" 0 hopscotch verify map.h5
[ -d map.h5.tiles ] || fail "its tiles stay" "no map.h5.tiles"
hopscotch run "${large[@]:0:${#large[@]}-1}" -o packed.h5 >out.txt 2>&1
hash_of() { grep '"hash"' "$1" | cut -d'"' -f4; }
claim_equal "a packed map has the same hash" "$(hash_of packed.json)" "$(hash_of map.json)"
[ ! -d packed.h5.tiles ] || fail "a packed map needs no tiles" "packed.h5.tiles"

# readers that know nothing of this program, from another folder
mkdir elsewhere
mv map.h5 map.h5.tiles elsewhere/
python=/usr/bin/python3
if $python -c 'import h5py, xarray' 2>/dev/null; then
    $python - <<'PYTHON' || fail "xarray opens it with both engines" "see above"
import xarray as xr
packed = xr.open_dataset("packed.h5", engine="h5netcdf", mask_and_scale=False)
for engine in ("h5netcdf", "netcdf4"):
    joined = xr.open_dataset("elsewhere/map.h5", engine=engine, mask_and_scale=False)
    assert packed.equals(joined), engine
PYTHON
    # a truncated tile is no data for anybody, and is computed again
    truncate -s 300 elsewhere/map.h5.tiles/tile_000000007.h5
    claim_equal "a damaged tile reads as not computed" "10000" "$($python -c '
import h5py
label = h5py.File("elsewhere/map.h5")["label"][:, :]
print((label == -1).sum())')"
fi
truncate -s 300 elsewhere/map.h5.tiles/tile_000000007.h5
claim_exit "verify finds it" 4 hopscotch verify elsewhere/map.h5
claim_exit "resume mends it" 0 hopscotch run "${large[@]}" -o elsewhere/map.h5 --resume
claim_exit "and then it is sound" 0 hopscotch verify elsewhere/map.h5
exit $failed
