// Maps are read without this project: xarray with both engines, h5py, and the Python loader.
#include "tests/host/sample_map.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace hopscotch {
namespace {

/// A Python that has what reading maps needs; empty where there is none.
std::string capable_python() {
    for (const std::string python : {"python3", "/usr/bin/python3"}) {
        const std::string probe = python +
                                  " -W ignore -c 'import h5py, h5netcdf, netCDF4, xarray, "
                                  "matplotlib' >/dev/null 2>&1";
        if (std::system(probe.c_str()) == 0) return python;
    }
    return {};
}

class store_python : public testing::TestWithParam<std::vector<std::uint64_t>> {};

TEST_P(store_python, xarray_h5py_and_the_loader_open_a_map) {
    const std::string python = capable_python();
    if (python.empty()) {
        GTEST_SKIP() << "needs python3 with h5py, h5netcdf, netCDF4, xarray and matplotlib";
    }
    const test::scratch_folder folder;
    test::write_sample_map(folder / "map.h5", test::sample_layout(GetParam(), {32, 16, 4}));
    const std::filesystem::path scripts =
        std::filesystem::path(HOPSCOTCH_SOURCE) / "tests" / "python";
    const std::string command = "HOPSCOTCH_TEST_MAP='" + (folder / "map.h5").string() +
                                "' MPLBACKEND=Agg PYTHONDONTWRITEBYTECODE=1 " + python +
                                " -W ignore -m unittest discover -s '" + scripts.string() +
                                "' -p 'test_*.py' 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
}

INSTANTIATE_TEST_SUITE_P(one_and_three_axes, store_python,
                         testing::Values(std::vector<std::uint64_t>{70},
                                         std::vector<std::uint64_t>{40, 30, 6}));

}  // namespace
}  // namespace hopscotch
