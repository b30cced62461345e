// The GPU's ensemble loop without a GPU: 32 threads that draw cells and vote give the bits of one
// double after the other. What runs is the source that nvcc compiles, over emulated warps, and the
// host's part of the backend with its copies and pieces.
#include "tests/cuda/emulated_device.hpp"
#include "tests/cuda/loop_identity.hpp"

namespace hopscotch {
namespace {

class device_loop : public testing::TestWithParam<const model_entry*> {};

TEST_P(device_loop, emulated_warps_give_the_bits_of_one_double_after_the_other) {
    loop_identity::expect_same_returns(*GetParam(), 320);
}

TEST_P(device_loop, emulated_warps_give_the_exponents_of_one_orbit_after_the_other) {
    loop_identity::expect_same_exponents(*GetParam(), 96);
}

INSTANTIATE_TEST_SUITE_P(all, device_loop, testing::ValuesIn(emulation::emulated_models()),
                         [](const auto& of) { return std::string(of.param->info->name); });

}  // namespace
}  // namespace hopscotch
