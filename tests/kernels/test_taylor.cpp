// The pieces of the Taylor integrator that no model shows by itself: products by pairs of
// coefficients, and the rough root that the length of a step comes from.
#include "analysis/truth/real50.hpp"
#include "kernels/integrators/taylor.hpp"
#include "kernels/lanes/double_double.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hopscotch {
namespace {

template <class Real>
void compare_products_with_integers() {
    // (1 + 2 t + 3 t^2 + ...) (1 - t + t^2 - ...): small integers, exact in every arithmetic
    taylor::series<Real> a;
    taylor::series<Real> b;
    for (int n = 0; n <= taylor::order<Real>; ++n) {
        a.c[n] = Real(n + 1.0);
        b.c[n] = Real(n % 2 == 0 ? 1.0 : -1.0);
    }
    for (int n = 0; n < taylor::order<Real>; n += 2) {
        const auto pair = taylor::products(a, b, n);
        // alternating sum of 1 ... n + 1: n / 2 + 1 for even n, the same for n + 1
        EXPECT_EQ(pair.first, Real(n / 2 + 1.0)) << n;
        EXPECT_EQ(taylor::completed(pair.rest, a, b, n + 1), Real(n / 2 + 1.0)) << n;
    }
}

TEST(taylor, products_by_pairs_are_the_cauchy_product) {
    compare_products_with_integers<double>();
    compare_products_with_integers<double_double<double>>();
    compare_products_with_integers<real50>();
}

TEST(taylor, the_rough_root_is_good_to_two_ten_thousandths_for_every_size) {
    for (const int n : {21, 22}) {
        for (double x = 1e-300; x < 1e300; x *= 1.37) {
            const double exact = std::exp(std::log(x) / n);
            EXPECT_NEAR(taylor::rough_root(x, n) / exact, 1.0, 2e-4) << x;
        }
        EXPECT_GT(taylor::rough_root(HUGE_VAL, n), 0x1p40);  // a series that ends: any step
    }
}

TEST(taylor, the_mean_rate_leaves_out_the_start) {
    taylor::series<double> a{};
    a.c[0] = 7.0;
    a.c[1] = 2.0;
    a.c[3] = 4.0;
    EXPECT_EQ(taylor::mean_rate(a, 0.5), 3.0);
}

}  // namespace
}  // namespace hopscotch
