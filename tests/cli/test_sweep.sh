#!/usr/bin/env bash
# Sweeps: one map per point, an index over them that xarray opens with both engines wherever it is moved,
# missing maps that are no data, resumption, and the commands that look at one map of a sweep.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"

sweep=("$source_folder/configs/scenes/quickstart.toml" grid.axis.0.cells=60 grid.axis.1.cells=50
    accuracy.audit_cells=0 sweep.axis.0.name=damping_ratio "sweep.axis.0.values=[0.0, 0.05, 0.1]"
    sweep.axis.1.name=quadratic_stiffness "sweep.axis.1.values=[0.0, 0.0]" --quiet)
claim_exit "a value that stands twice is a mistake" 3 hopscotch run "${sweep[@]}" -o twice.h5
sweep=("$source_folder/configs/scenes/quickstart.toml" grid.axis.0.cells=60 grid.axis.1.cells=50
    accuracy.audit_cells=0 sweep.axis.0.name=damping_ratio "sweep.axis.0.values=[0.0, 0.05, 0.1]" --quiet)

claim_exit "a sweep is planned" 0 hopscotch run "${sweep[@]}" --dry-run
claim_contains "with its maps" "maps       3" out.txt
claim_contains "and their cells" "cells      9000" out.txt
claim_exit "a sweep is computed" 0 hopscotch run "${sweep[@]}" -o sweep.h5
for file in sweep.h5 sweep.json sweep.h5.maps/map_000002.h5; do
    [ -s $file ] || fail "index, summary and maps are written" "no $file"
done
hash_of() { grep '^  "hash"' "$1" | cut -d'"' -f4; }
hash=$(hash_of sweep.json)
claim_exit "the summary is JSON" 0 /usr/bin/python3 -c 'import json
maps = json.load(open("sweep.json"))["maps"]
assert [m["point"]["damping_ratio"] for m in maps] == [0.0, 0.05, 0.1]
assert all(abs(sum(b["share"] for b in m["basins"]) - 1) < 1e-12 for m in maps)'

claim_exit "an existing sweep is not overwritten" 4 hopscotch run "${sweep[@]}" -o sweep.h5
claim_exit "its maps are verified" 0 hopscotch verify sweep.h5 --cells 2
claim_exit "an index tells what it is" 0 hopscotch info sweep.h5
claim_contains "and its sweep" "damping_ratio" out.txt
claim_exit "an index is no map" 2 hopscotch render sweep.h5
claim_exit "but each of its maps is" 0 hopscotch render sweep.h5 --point 1 -o one.png
claim_exit "also by its file" 0 hopscotch replay sweep.h5.maps/map_000001.h5 --cell 30,20
claim_exit "or by its point" 0 hopscotch replay sweep.h5 --point 1 --cell 30,20
claim_exit "and is analysed" 0 hopscotch analyse sweep.h5 --point 2 -o analysis.json
claim_exit "a point outside is usage" 2 hopscotch analyse sweep.h5 --point 3

claim_exit "one map can be computed on its own" 0 hopscotch run "${sweep[@]}" "sweep.point=[2]" -o single.h5
claim_equal "and is the same" "$(hopscotch verify single.h5 | grep ^hash)" \
    "$(hopscotch verify sweep.h5.maps/map_000002.h5 | grep ^hash)"

python=/usr/bin/python3
if $python -c 'import h5py, xarray' 2>/dev/null; then
    mkdir elsewhere
    cp -r sweep.h5 sweep.h5.maps elsewhere/
    rm elsewhere/sweep.h5.maps/map_000001.h5
    # HDF5 would also find a lost map in a folder of that name here, where the program was started
    mv sweep.h5.maps whole
    $python - <<'PYTHON' || fail "the index shows the maps, and nothing where one is missing" "see above"
import h5py
import numpy as np
import xarray as xr

for engine in ("h5netcdf", "netcdf4"):
    index = xr.open_dataset("elsewhere/sweep.h5", engine=engine)
    assert index.label.dims == ("damping_ratio", "liftoff_speed", "mass_ratio"), index.label.dims
    assert index.damping_ratio.values.tolist() == [0.0, 0.05, 0.1]
    for i in (0, 2):
        one = xr.open_dataset(f"whole/map_00000{i}.h5", engine=engine)
        for layer in ("label", "outcome", "returns"):
            assert (index[layer].isel(damping_ratio=i).values == one[layer].values).all(), layer
    assert np.isnan(index.label.isel(damping_ratio=1).values).all()  # lost: masked, no data
    assert (index.basin_share_error.fillna(0).values >= 0).all()
    assert (index.n_attractors.values >= 1).all()
    labels = index.label.isel(damping_ratio=2).values
    for label in index.attractor.values:
        told = float(index.basin_share.isel(damping_ratio=2).sel(attractor=label))
        assert abs(told - (labels == label).mean()) < 1e-12, (label, told)
with h5py.File("elsewhere/sweep.h5") as file:
    assert (file["label"][1] == file["label"].attrs["_FillValue"]).all()
    assert not any(v.file_name.startswith("/") for v in file["label"].virtual_sources())
PYTHON
    mv whole sweep.h5.maps
fi

if /usr/bin/python3 -c 'import matplotlib' 2>/dev/null; then
    PYTHONPATH=$source_folder/analysis/python /usr/bin/python3 - <<'PYTHON' || fail "an index is drawn" "see above"
import matplotlib
matplotlib.use("Agg")
import hopscotch
index = hopscotch.open("sweep.h5")
one = index.hop.plot("label", damping_ratio=2)
assert (one.get_xlabel(), one.get_ylabel()) == ("liftoff speed", "mass ratio"), one.get_xlabel()
assert "damping_ratio = 0.1" in one.get_title(), one.get_title()
table = index.hop.plot("basin_entropy")
assert table.get_xlabel() == "damping ratio", table.get_xlabel()
PYTHON
fi

# interrupted and resumed; a lost map is told and computed again
rm sweep.h5.maps/map_000001.h5
claim_exit "a lost map is found" 4 hopscotch verify sweep.h5
claim_exit "and computed again" 0 hopscotch run "${sweep[@]}" -o sweep.h5 --resume
claim_equal "to the same hash" "$hash" "$(hash_of sweep.json)"
claim_exit "a sweep out of time is resumable" 75 hopscotch run "${sweep[@]}" -o late.h5 --walltime 0:00:00
claim_exit "its index is there, without maps" 0 hopscotch info late.h5
claim_contains "and says so" "0 of them there" out.txt
claim_exit "it goes on" 0 hopscotch run "${sweep[@]}" -o late.h5 --resume
claim_equal "to the same maps" "$hash" "$(hash_of late.json)"

# shards of a sweep take whole maps; a run without --shard completes the index
claim_exit "a shard of a sweep is computed" 0 hopscotch run "${sweep[@]}" -o part.h5 --shard 2/2
claim_contains "and says what completes it" "with --resume and without --shard completes the index" out.txt
claim_equal "it has its own maps" map_000001.h5 "$(ls part.h5.maps)"
claim_exit "the other shard has the others" 0 hopscotch run "${sweep[@]}" -o part.h5 --shard 1/2
claim_exit "the index is completed" 0 hopscotch run "${sweep[@]}" -o part.h5 --resume
claim_contains "without computing a map again" '"cells_computed": 0' part.json
claim_equal "and is that of one run" "$hash" "$(hash_of part.json)"

# axes that move together
claim_exit "axes may move together" 0 hopscotch run "${sweep[@]}" sweep.combine=zip \
    sweep.axis.1.name=restitution "sweep.axis.1.values=[0.0, 0.0, 0.0]" -o zip.h5
if $python -c 'import xarray' 2>/dev/null; then
    claim_equal "over one dimension" "('point', 'liftoff_speed', 'mass_ratio') [0.   0.05 0.1 ]" "$($python -c '
import xarray as xr
index = xr.open_dataset("zip.h5", engine="h5netcdf")
print(index.label.dims, index.coords["damping_ratio"].values)')"
fi
exit $failed
