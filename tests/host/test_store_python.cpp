// Maps are read without this project: xarray with both engines, h5py, and the Python loader.
#include "tests/host/sample_map.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace hopscotch {
namespace {

TEST(store_python, xarray_h5py_and_the_loader_open_a_map) {
    if (std::system("python3 -c 'import h5py, h5netcdf, netCDF4, xarray, matplotlib' "
                    ">/dev/null 2>&1") != 0) {
        GTEST_SKIP() << "needs python3 with h5py, h5netcdf, netCDF4, xarray and matplotlib";
    }
    const test::scratch_folder folder;
    test::write_sample_map(folder / "map.h5", test::sample_layout({70, 50}, {32, 16}));
    const std::filesystem::path scripts =
        std::filesystem::path(__FILE__).parent_path().parent_path() / "python";
    const std::string command = "HOPSCOTCH_TEST_MAP='" + (folder / "map.h5").string() +
                                "' MPLBACKEND=Agg PYTHONDONTWRITEBYTECODE=1 python3 -m unittest "
                                "discover -s '" + scripts.string() + "' -p 'test_*.py' 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
}

}  // namespace
}  // namespace hopscotch
