"""From a map file to a dataset."""

import importlib.util

import numpy as np
import xarray as xr

ENGINES = ("h5netcdf", "netcdf4")
MODULES = {"h5netcdf": "h5netcdf", "netcdf4": "netCDF4"}


def open(path, engine=None):
    """The map of a file as an ``xarray.Dataset``; cells are read when they are used.

    Integers stay integers: a value equal to a layer's attribute ``_FillValue`` was not computed
    (finished maps have none). ``engine`` is ``"h5netcdf"`` or ``"netcdf4"``; by default the one that
    is installed.
    """
    engine = engine or _installed_engine()
    as_stored = {"engine": engine, "mask_and_scale": False, "decode_times": False}
    dataset = xr.open_dataset(path, **as_stored)
    if "attractors" in _groups(path, engine):
        with xr.open_dataset(path, group="attractors", **as_stored) as table:
            dataset = dataset.assign_coords(_attractor_coordinates(table.load()))
    return dataset


def _installed_engine():
    for engine in ENGINES:
        if importlib.util.find_spec(MODULES[engine]) is not None:
            return engine
    raise ImportError("reading maps needs h5netcdf or netCDF4 beside xarray")


def _groups(path, engine):
    if engine == "h5netcdf":
        import h5netcdf

        with h5netcdf.File(path, "r") as file:
            return list(file.groups)
    import netCDF4

    with netCDF4.Dataset(path) as file:
        return list(file.groups)


def _attractor_coordinates(table):
    """The group /attractors as coordinates along the dimension ``attractor`` of the map."""
    names = table["name"].values.astype(str)
    coordinates = {
        "attractor": ("attractor", names, {"long_name": "name of the attractor"}),
        "attractor_label": ("attractor", table["label"].values, table["label"].attrs),
        "attractor_colour": ("attractor", [f"#{int(c):06x}" for c in table["colour"].values]),
        "attractor_trap": ("attractor", table["trap"].values.astype(str), table["trap"].attrs),
    }
    for name in ("period", "share"):
        coordinates["attractor_" + name] = ("attractor", table[name].values, table[name].attrs)
    if "points" in table:
        coordinates["column"] = ("column", table["column"].values.astype(str))
        coordinates["attractor_points"] = (
            ("attractor", "point", "column"), table["points"].values, table["points"].attrs)
    if "multipliers" in table:
        parts = np.asarray(table["multipliers"].values)
        coordinates["attractor_multipliers"] = (
            ("attractor", "multiplier"), parts[..., 0] + 1j * parts[..., 1],
            table["multipliers"].attrs)
    return coordinates
