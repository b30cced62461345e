#!/usr/bin/env bash
# Boundary refinement: the file is a full-resolution map with its level layer, computed cells are those of a
# full run, the saved share is told, an interrupted run goes on to the same map.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"

scene=("$source_folder/configs/scenes/cham2007_fig8_basins.toml" grid.axis.0.cells=256 grid.axis.1.cells=256
    "output.tile=[64, 64]" accuracy.audit_cells=20 --quiet)
hash_of() { grep '"hash"' "$1" | cut -d'"' -f4; }
claim_exit "a full map is computed" 0 hopscotch run "${scene[@]}" -o full.h5
claim_exit "and a refined one" 0 hopscotch run "${scene[@]}" grid.refine=4 -o map.h5
claim_contains "the computed share is told" "% of the cells computed" out.txt
claim_contains "also in the summary" '"refine_saved_share": 0.' map.json
claim_exit "its sums hold, and cells recomputed" 0 hopscotch verify map.h5 --cells 20
claim_exit "it is drawn" 0 hopscotch render map.h5 --layer level -o level.png
claim_exit "and analysed" 0 hopscotch analyse map.h5 -o analysis.json
claim_exit "a cell is replayed" 0 hopscotch replay map.h5 --cell 100,100
if /usr/bin/python3 -c 'import h5py' 2>/dev/null; then
    /usr/bin/python3 - <<'PYTHON' || fail "computed cells are those of the full run" "see above"
import h5py
full, part = h5py.File("full.h5"), h5py.File("map.h5")
computed = part["level"][:] >= 0
assert part["label"].shape == (256, 256)
assert 0.0 < computed.mean() < 0.5, computed.mean()
assert abs(1 - computed.mean() - float(part.attrs["refine_saved_share"])) < 1e-15
for layer in ("label", "outcome", "returns"):
    assert (full[layer][:][computed] == part[layer][:][computed]).all(), layer
assert (part["returns"][:][~computed] == part["returns"].attrs["_FillValue"]).all()
assert (full["label"][:] != part["label"][:]).mean() < 0.002
PYTHON
fi
claim_exit "tiles may stay" 0 hopscotch run "${scene[@]}" grid.refine=4 --keep-tiles "output.tile=[32, 256]" -o kept.h5
claim_equal "and tiles do not matter" "$(hash_of map.json)" "$(hash_of kept.json)"
if /usr/bin/python3 -c 'import h5py, xarray' 2>/dev/null; then
    /usr/bin/python3 - <<'PYTHON' || fail "the kept tiles' file is a virtual map of full resolution" "see above"
import h5py
import xarray as xr
packed, kept = h5py.File("map.h5"), h5py.File("kept.h5")
for layer in ("label", "outcome", "returns", "level"):
    assert kept[layer].is_virtual and not packed[layer].is_virtual, layer
    assert len(kept[layer].virtual_sources()) == 8, layer
    assert (kept[layer][:] == packed[layer][:]).all(), layer
    # what a coarse cell stands for takes next to no room
    assert packed[layer].id.get_storage_size() < 0.1 * packed[layer].nbytes, layer
for engine in ("h5netcdf", "netcdf4"):
    opened = xr.open_dataset("kept.h5", engine=engine)
    assert opened.label.shape == opened.level.shape == (256, 256)
    assert opened.label.dims == ("height", "velocity"), opened.label.dims
PYTHON
fi
rm kept.h5.tiles/tile_000000003.h5
claim_exit "a lost tile is computed again" 0 hopscotch run "${scene[@]}" grid.refine=4 --keep-tiles \
    "output.tile=[32, 256]" -o kept.h5 --resume
claim_equal "to the same map" "$(hash_of map.json)" "$(hash_of kept.json)"
claim_exit "numbers have no boundaries" 3 hopscotch run "${scene[@]}" grid.refine=4 question.kind=return_map \
    'output.layers=["outcome"]' -o none.h5
exit $failed
