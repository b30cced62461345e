"""Maps are read by h5py, by xarray with both engines and by the loader, without the program.

HOPSCOTCH_TEST_MAP names a map file; any finished map with at least one axis will do.
"""

import os
import pathlib
import sys
import unittest
import warnings

import h5py
import numpy as np
import xarray as xr

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "analysis" / "python"))
import hopscotch  # noqa: E402

MAP = os.environ.get("HOPSCOTCH_TEST_MAP", "")
ENGINES = ("h5netcdf", "netcdf4")

warnings.filterwarnings("ignore", category=DeprecationWarning)


def layers_of(file):
    return [name for name, item in file.items()
            if isinstance(item, h5py.Dataset) and (item.chunks is not None or item.is_virtual)]


@unittest.skipUnless(MAP, "HOPSCOTCH_TEST_MAP names no map")
class MapFile(unittest.TestCase):
    def test_every_axis_of_every_layer_has_a_dimension_scale(self):
        with h5py.File(MAP) as file:
            self.assertTrue(layers_of(file))
            for name in layers_of(file):
                for axis in file[name].dims:
                    self.assertEqual(len(axis), 1, name)
                    self.assertEqual(axis[0].attrs["CLASS"], b"DIMENSION_SCALE")

    def test_layers_are_shuffled_deflated_and_chunked_like_their_tiles(self):
        with h5py.File(MAP) as file:
            extents = file["tiles/extent"][()]
            for name in layers_of(file):
                if file[name].is_virtual:
                    continue  # its tile files are
                self.assertEqual(file[name].compression, "gzip")
                self.assertEqual(file[name].shuffle, file[name].dtype.itemsize > 1)
                self.assertEqual(list(file[name].chunks), extents.max(axis=0).tolist())

    def test_layers_and_axes_have_types_that_paraview_s_netcdf_reader_knows(self):
        known = {np.dtype(kind) for kind in ("int8", "int16", "int32", "float32", "float64")}
        with h5py.File(MAP) as file:
            for name, item in file.items():
                if isinstance(item, h5py.Dataset):
                    self.assertIn(item.dtype.newbyteorder("="), known, name)

    def test_every_tile_is_in_the_tile_table_and_together_they_are_the_map(self):
        with h5py.File(MAP) as file:
            shape = np.array(file[layers_of(file)[0]].shape)
            origins, extents = file["tiles/origin"][()], file["tiles/extent"][()]
            self.assertEqual(extents.prod(axis=1).sum(), shape.prod())
            self.assertTrue(((origins + extents) <= shape).all())

    def test_no_object_carries_a_time_stamp(self):
        with h5py.File(MAP) as file:
            for name in ["/", *file]:
                info = h5py.h5o.get_info(file[name].id)
                times = [getattr(info, t, 0) for t in ("ctime", "mtime")]
                self.assertEqual(times, [0, 0], name)

    def test_the_scene_its_fingerprint_and_the_hash_are_text(self):
        with h5py.File(MAP) as file:
            for name in ("scene", "fingerprint", "hash"):
                self.assertIsInstance(file.attrs[name], str)
            self.assertEqual(len(file.attrs["hash"]), 32)

    def test_both_engines_read_the_numbers_that_h5py_reads(self):
        with h5py.File(MAP) as file:
            for engine in ENGINES:
                with xr.open_dataset(MAP, engine=engine, mask_and_scale=False) as dataset:
                    for name in layers_of(file):
                        np.testing.assert_array_equal(dataset[name].values, file[name][()])
                        self.assertEqual(dataset[name].dtype, file[name].dtype)
                        for axis in dataset[name].dims:
                            np.testing.assert_array_equal(dataset[axis].values, file[axis][()])

    def test_both_engines_read_every_group_alike(self):
        with h5py.File(MAP) as file:
            groups = [name for name, item in file.items() if isinstance(item, h5py.Group)]
        for group in groups:
            first, second = (xr.open_dataset(MAP, engine=e, group=group).load() for e in ENGINES)
            xr.testing.assert_equal(first, second)

    def test_categorical_layers_follow_the_climate_and_forecast_conventions(self):
        with xr.open_dataset(MAP, engine="netcdf4", mask_and_scale=False) as dataset:
            self.assertTrue(dataset.attrs["Conventions"].startswith("CF-"))
            for variable in dataset.data_vars.values():
                self.assertIn("units", variable.attrs)
                self.assertIn("long_name", variable.attrs)
                self.assertEqual(np.asarray(variable.attrs["_FillValue"]).dtype, variable.dtype)
                if "flag_values" in variable.attrs:
                    values = np.atleast_1d(variable.attrs["flag_values"])
                    self.assertEqual(values.dtype, variable.dtype)
                    self.assertEqual(len(values), len(variable.attrs["flag_meanings"].split()))


@unittest.skipUnless(MAP, "HOPSCOTCH_TEST_MAP names no map")
class Loader(unittest.TestCase):
    def test_both_engines_give_the_same_dataset(self):
        first, second = (hopscotch.open(MAP, engine=engine).load() for engine in ENGINES)
        xr.testing.assert_equal(first, second)

    def test_integer_layers_stay_integers(self):
        dataset = hopscotch.open(MAP)
        with h5py.File(MAP) as file:
            for name in layers_of(file):
                self.assertEqual(dataset[name].dtype, file[name].dtype)

    def test_attractors_have_names_colours_and_numbers_without_padding(self):
        dataset = hopscotch.open(MAP)
        for row in dataset.hop.attractors():
            self.assertRegex(row["colour"], "^#[0-9a-f]{6}$")
            self.assertEqual(dataset.hop.names()[row["label"]], row["name"])
            self.assertEqual(dataset.hop.palette()[row["label"]], row["colour"])
            for name in ("points", "multipliers"):
                self.assertFalse(np.isnan(row.get(name, np.zeros(1))).any())

    def test_shares_add_up_and_agree_with_the_masks_of_names(self):
        dataset = hopscotch.open(MAP)
        if "label" not in dataset:
            self.skipTest("a map without labels")
        shares = dataset.hop.shares()
        self.assertAlmostEqual(sum(shares.values()), 1.0)
        for name, share in shares.items():
            self.assertAlmostEqual(float(dataset.hop.is_in(name).mean()), share)

    def test_every_layer_can_be_drawn(self):
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        dataset = hopscotch.open(MAP)
        for layer in [None, *dataset.data_vars]:
            axes = dataset.hop.plot(layer)
            axes.figure.canvas.draw()
            self.assertTrue(axes.get_xlabel())
            plt.close(axes.figure)


if __name__ == "__main__":
    unittest.main()
