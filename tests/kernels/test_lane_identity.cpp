// Every lane primitive and elementary function gives a pack's lanes the bits that double gets.
// Compiled once per target (avx2, avx512); the pack of that target is compared with double lane by
// lane.
#include "kernels/lanes/double_double.hpp"
#include "kernels/lanes/dual.hpp"
#include "kernels/lanes/pack.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>
#include <vector>

namespace hopscotch::inline HOPSCOTCH_TARGET {
namespace {

bool processor_has_target() {
#ifdef __AVX512F__
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
#else
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#endif
}

class lane_identity : public testing::Test {
protected:
    void SetUp() override {
        if (!processor_has_target())
            GTEST_SKIP() << "this processor lacks the target's instructions";
    }
};

using arguments = std::array<double, 3>;

/// Special values in all combinations, then random ones of three kinds: around 1, any bits, mixed
/// sizes.
std::vector<arguments> argument_table() {
    constexpr double inf = std::numeric_limits<double>::infinity();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> special{0.0, -0.0, 1.0, -1.0, 0.5, -0.5, 1.5, -2.5, inf, -inf, nan};
    special.insert(special.end(), {5e-324, -1e-310, 2.3e-308, 1e300, 1.7e308, -1.7e308});
    special.insert(special.end(), {709.8, -745.2, 0x1p40, 0x1.8p40, 0x1.fffffffffffffp-1});
    special.insert(special.end(), {1.5707963267948966, 3.141592653589793});
    std::vector<arguments> table;
    for (const double a : special)
        for (const double b : special) table.push_back({a, b, a * 0.75 + 0.1});
    std::mt19937_64 bits(11);
    const auto unit = [&] { return std::ldexp(static_cast<double>(bits() >> 11), -52) - 1.0; };
    const auto any_bits = [&] { return std::bit_cast<double>(bits()); };
    const auto sized = [&] { return unit() * power_of_two(nearest(unit() * 60.0)); };
    for (int i = 0; i < 6000; ++i) {
        table.push_back({unit(), unit(), unit()});
        table.push_back({sized(), sized(), sized()});
        table.push_back({any_bits(), any_bits(), any_bits()});
    }
    while (table.size() % 32 != 0) table.push_back({1.0, 2.0, 3.0});
    return table;
}

bool same_bits(double a, double b) {
    return (a != a && b != b) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

template <int Registers>
std::vector<double> lanes_of(const pack<Registers>& x) {
    constexpr int n = static_cast<int>(simd_register::size);
    std::vector<double> result(static_cast<std::size_t>(Registers * n));
    for (int i = 0; i < Registers; ++i) x.at(i).store_unaligned(result.data() + i * n);
    return result;
}

/// Compares one operation of up to three arguments for packs of this many registers.
template <int Registers, class Operation>
void expect_identical(const char* name, const Operation& operation) {
    using lanes = pack<Registers>;
    constexpr std::size_t width = width_of<lanes>;
    static const std::vector<arguments> table = argument_table();
    int n_different = 0;
    for (std::size_t start = 0; start + width <= table.size(); start += width) {
        std::array<lanes, 3> x;
        for (std::size_t a = 0; a < 3; ++a) {
            std::array<double, width> column;
            for (std::size_t i = 0; i < width; ++i) column[i] = table[start + i][a];
            for (int r = 0; r < Registers; ++r)
                x[a].part[r] = simd_register::load_unaligned(
                    column.data() + static_cast<std::size_t>(r) * simd_register::size);
        }
        const std::vector<double> got = lanes_of(operation(x[0], x[1], x[2]));
        for (std::size_t i = 0; i < width; ++i) {
            const arguments& y = table[start + i];
            const double want = operation(y[0], y[1], y[2]);
            if (same_bits(got[i], want)) continue;
            if (++n_different > 3) return;
            ADD_FAILURE() << name << "(" << y[0] << ", " << y[1] << ", " << y[2] << ") is " << want
                          << " for double, " << got[i] << " in lane " << i << " of " << width;
        }
    }
}

template <class Operation>
void expect_identical_at_every_width(const char* name, const Operation& operation) {
    expect_identical<1>(name, operation);
    expect_identical<2>(name, operation);
    expect_identical<4>(name, operation);
}

/// 1 or 0, so that masks can be compared too.
template <class Real>
Real as_number(const mask_of<Real>& mask) {
    return select(mask, Real(1.0), Real(0.0));
}

// A macro, because the expression has to be compiled for double and every pack and named in a
// failure.
#define EXPECT_IDENTICAL(...)                                         \
    expect_identical_at_every_width(                                  \
        #__VA_ARGS__,                                                 \
        []<class Real>(const Real& a, [[maybe_unused]] const Real& b, \
                       [[maybe_unused]] const Real& c) -> Real { return __VA_ARGS__; })

TEST_F(lane_identity, arithmetic) {
    EXPECT_IDENTICAL(a + b);
    EXPECT_IDENTICAL(a - b);
    EXPECT_IDENTICAL(a * b);
    EXPECT_IDENTICAL(a / b);
    EXPECT_IDENTICAL(-a);
    EXPECT_IDENTICAL(fma(a, b, c));
    EXPECT_IDENTICAL(sqrt(a));
    EXPECT_IDENTICAL(abs(a));
    EXPECT_IDENTICAL(floor(a));
    EXPECT_IDENTICAL(nearest(a));
    EXPECT_IDENTICAL(copysign(a, b));
    EXPECT_IDENTICAL(primal(a));
}

TEST_F(lane_identity, comparisons_and_selections) {
    EXPECT_IDENTICAL(as_number<Real>(a < b));
    EXPECT_IDENTICAL(as_number<Real>(a <= b));
    EXPECT_IDENTICAL(as_number<Real>(a > b));
    EXPECT_IDENTICAL(as_number<Real>(a >= b));
    EXPECT_IDENTICAL(as_number<Real>(a == b));
    EXPECT_IDENTICAL(as_number<Real>((a < b) & (b < c)));
    EXPECT_IDENTICAL(as_number<Real>((a < b) | (b < c)));
    EXPECT_IDENTICAL(as_number<Real>(!(a < b)));
    EXPECT_IDENTICAL(select(a < b, b, c));
    EXPECT_IDENTICAL(negate_where(a < b, c));
}

TEST_F(lane_identity, binary_representation) {
    EXPECT_IDENTICAL(power_of_two(select(abs(a) < 1.0, nearest(a * 1000.0), Real(0.0))));
    EXPECT_IDENTICAL(exponent(select(abs(a) >= 0x1p-1022, abs(a), Real(1.0))));
    EXPECT_IDENTICAL(mantissa(select(abs(a) >= 0x1p-1022, abs(a), Real(1.0))));
    EXPECT_IDENTICAL(as_number<Real>(has_bit<0>(a)));
    EXPECT_IDENTICAL(as_number<Real>(has_bit<1>(a)));
    EXPECT_IDENTICAL(as_number<Real>(has_bit<51>(a)));
}

TEST_F(lane_identity, any_and_all_see_every_lane) {
    constexpr int width = width_of<pack<4>>;
    for (int marked = 0; marked < width; ++marked) {
        std::array<double, width> column{};
        column[static_cast<std::size_t>(marked)] = 1.0;
        pack<4> x;
        for (std::size_t r = 0; r < 4; ++r)
            x.part[r] = simd_register::load_unaligned(column.data() + r * simd_register::size);
        EXPECT_TRUE(any(x > 0.5));
        EXPECT_FALSE(all(x > 0.5));
        EXPECT_FALSE(all(x < 0.5));
        EXPECT_FALSE(any(x > 1.5));
        EXPECT_TRUE(all(x > -0.5));
    }
}

TEST_F(lane_identity, circular_functions) {
    EXPECT_IDENTICAL(sin_cos(a).sin);
    EXPECT_IDENTICAL(sin_cos(a).cos);
    EXPECT_IDENTICAL(sin(a * 1e6));
    EXPECT_IDENTICAL(cos(a * 1e6));
    EXPECT_IDENTICAL(tan(a));
    EXPECT_IDENTICAL(atan(a));
    EXPECT_IDENTICAL(atan2(a, b));
    EXPECT_IDENTICAL(asin(a));
    EXPECT_IDENTICAL(acos(a));
}

TEST_F(lane_identity, exponentials_logarithms_and_roots) {
    EXPECT_IDENTICAL(exp(a));
    EXPECT_IDENTICAL(exp(a * 700.0));
    EXPECT_IDENTICAL(expm1(a));
    EXPECT_IDENTICAL(log(a));
    EXPECT_IDENTICAL(log1p(a));
    EXPECT_IDENTICAL(cbrt(a));
}

TEST_F(lane_identity, hyperbolic_functions) {
    EXPECT_IDENTICAL(sinh(a));
    EXPECT_IDENTICAL(cosh(a));
    EXPECT_IDENTICAL(tanh(a));
    EXPECT_IDENTICAL(sinh(a * 700.0));
    EXPECT_IDENTICAL(asinh(a));
    EXPECT_IDENTICAL(atanh(a));
}

TEST_F(lane_identity, dual_numbers_of_packs) {
    EXPECT_IDENTICAL(
        (sin_cos(dual<Real, 2>::variable(a, 0) * dual<Real, 2>::variable(b, 1)).cos).slope[0]);
    EXPECT_IDENTICAL(atan2(dual<Real, 2>::variable(a, 0), dual<Real, 2>::variable(b, 1)).slope[1]);
    EXPECT_IDENTICAL(sqrt(dual<Real, 1>::variable(a, 0)).slope[0]);
    EXPECT_IDENTICAL(implicit_root(a, dual<Real, 1>::variable(b, 0) * c, b).slope[0]);
}

TEST_F(lane_identity, double_doubles_of_packs) {
    EXPECT_IDENTICAL((double_double<Real>(a) / double_double<Real>(b)).low);
    EXPECT_IDENTICAL((double_double<Real>(a) * b + c).low);
    EXPECT_IDENTICAL(sqrt(double_double<Real>(a)).low);
    EXPECT_IDENTICAL(sin(double_double<Real>(a)).low);
    EXPECT_IDENTICAL(exp(double_double<Real>(a)).low);
    EXPECT_IDENTICAL(log(double_double<Real>(a)).low);
    EXPECT_IDENTICAL(atan2(double_double<Real>(a), double_double<Real>(b)).low);
}

}  // namespace
}  // namespace hopscotch::inline HOPSCOTCH_TARGET
