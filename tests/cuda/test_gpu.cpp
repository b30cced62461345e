// On a real device: every model's kernels give the bits of one double after the other, at sizes
// that fill the device. Skips, with the reason, where there is none.
#include "tests/cuda/loop_identity.hpp"

#ifdef HOPSCOTCH_HAS_CUDA
#include "host/device/devices.hpp"
#endif

namespace hopscotch {
namespace {

/// Why these tests can say nothing here, or "".
std::string reason_to_skip() {
    std::string reason = reason_against(backend::cuda);
#ifdef HOPSCOTCH_HAS_CUDA
    if (reason.empty() && device_arithmetic() != bits_of_the_others) reason = device_arithmetic();
#endif
    return reason;
}

class gpu : public testing::TestWithParam<const model_entry*> {
protected:
    void SetUp() override {
        if (const std::string reason = reason_to_skip(); !reason.empty()) GTEST_SKIP() << reason;
    }
};

TEST_P(gpu, gives_the_bits_of_one_double_after_the_other) {
    loop_identity::expect_same_returns(*GetParam(), 5000);
}

TEST_P(gpu, gives_the_exponents_of_one_orbit_after_the_other) {
    loop_identity::expect_same_exponents(*GetParam(), 1000);
}

TEST_P(gpu, requests_of_many_pieces_give_the_bits_of_the_widest_pack) {
    const model_entry& model = *GetParam();
    const std::vector<int> options(most_options, 0);
    // rows repeated until several pieces of 2^18 cells are needed
    every_model::rows of = every_model::random_rows(model, 0, options, 1000, 77);
    const int variant = every_model::variant_of(of);
    std::vector<std::size_t> again(1u << 20);
    for (std::size_t i = 0; i < again.size(); ++i) again[i] = i % of.size();
    const every_model::answers want = every_model::run(of, backend::scalar, variant);
    const every_model::answers got =
        every_model::run(every_model::picked(of, again), backend::cuda, variant);
    for (std::size_t i = 0; i < again.size(); ++i) {
        ASSERT_EQ(got.bits(i), want.bits(again[i])) << "cell " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(all, gpu, testing::ValuesIn(every_model::models()),
                         [](const auto& of) { return std::string(of.param->info->name); });

}  // namespace
}  // namespace hopscotch
