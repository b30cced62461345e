// The closed forms that the mirror laws' paper states about its return maps, as corrected by the
// page (models/mirror_juggler.md, sections 3 and 6): (19) to (21) from the observed impact, and the
// Schwarzian derivatives of the line juggler's two maps.
#include "kernels/models/mirror_line.hpp"
#include "kernels/models/mirror_planar.hpp"
#include "tests/models/orbit_runner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hopscotch::testing_models {
namespace {

/// The impact of one return, as traced: contact time, and position and velocity around it.
struct impact final : orbit_observer {
    double time = 0.0;
    double x = 0.0, z = 0.0, x_rate = 0.0, z_rate = 0.0, z_rate_after = 0.0;

    void phase(const char*, double, double, const sampler&) override {}
    void event(const char*, double at, const char*, const char*, const double* before,
               const double* after, double) override {
        time = at;
        x = before[0];
        z = before[1];
        x_rate = before[2];
        z_rate = before[3];
        z_rate_after = after[3];
    }
};

/// A return of the planar juggler with everything that (19) to (21) are written in.
struct planar_return {
    static constexpr double alpha = 0.75, gravity = 9.81, target = 0.5;
    double x, z, v;  // apex
    double next[3];  // the next one
    impact hit;
    double gain = 0.0;        // K
    double rise = 0.0;        // t_a
    double angle_rate = 0.0;  // of theta_b at contact
    double stretch = 0.0;     // rate of |b| over |b| there

    planar_return(const char* law, double x0, double z0, double v0) : x(x0), z(z0), v(v0) {
        const double speed = std::sqrt(2 * gravity * target);
        const double energy_gain = 0.5 / (1.75 * gravity * target);  // B = 1/2
        const double velocity_gain = 0.5 * target / speed;
        const double offset = 1.0 / 7.0;
        const std::string parameters[] = {print_real(alpha),
                                          print_real(gravity),
                                          print_real(offset),
                                          print_real(energy_gain),
                                          print_real(target),
                                          print_real(target),
                                          print_real(0.4 * velocity_gain * gravity / speed),
                                          print_real(velocity_gain),
                                          print_real(0.0),
                                          print_real(100.0),
                                          print_real(-100.0)};
        const std::vector<int> options = chosen_options<mirror_planar>({.options = {{"law", law}}});
        const std::vector<std::string> columns{print_real(x), print_real(z), print_real(v)};
        const std::vector<std::string> texts(std::begin(parameters), std::end(parameters));
        orbit_row row;
        row.options = options.data();
        row.variant = options[0];
        row.columns = columns;
        row.parameters = texts;
        row.returns = 1;
        const orbit_answer end = orbits_of<mirror_planar>().run_double(row);
        EXPECT_EQ(end.end, outcome::ok);
        for (std::size_t c = 0; c < 3; ++c) next[c] = number(end.columns[c]);
        orbits_of<mirror_planar>().trace(row, hit);
        gain = offset + energy_gain * gravity * (target - z);
        rise = hit.z_rate_after / gravity;
        const double square = hit.x * hit.x + hit.z * hit.z;
        angle_rate = (hit.x * hit.z_rate - hit.z * hit.x_rate) / square;
        stretch = (hit.x * hit.x_rate + hit.z * hit.z_rate) / square;
    }
    double m() const { return alpha + (1 + alpha) * gain; }
    double push() const { return (1 + alpha) * (1 + gain) * angle_rate; }  // xi_2
    double xi_0() const { return m() * gravity; }
    double xi_1() const { return (1 + alpha) * (1 + gain) * stretch; }
    /// d of the page
    double coupling() const {
        return 1 - m() * m() +
               (2 * xi_0() * xi_1() * hit.time + xi_1() * xi_1() * hit.z) / (2 * gravity);
    }
    /// d as (20) is printed
    double printed_coupling() const {
        return 1 - m() * m() + 2 * xi_0() * xi_1() * hit.time * hit.z +
               xi_1() * xi_1() * std::pow(hit.z, 3);
    }
};

/// Returns of both laws for which (19) to (21) are exact, from starts about the fixed point.
template <class Check>
void on_many_returns(const Check& check) {
    std::mt19937_64 bits(19);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (const char* law : {"solvable", "level"}) {
        for (int i = 0; i < 60; ++i)
            check(planar_return(law, 0.5 + 0.1 * u(bits), 0.5 + 0.2 * u(bits), 0.2 * u(bits)));
    }
}

TEST(mirror_identities, horizontal_motion_obeys_rows_1_and_3_of_equation_19) {
    on_many_returns([](const planar_return& r) {
        const double kick = r.push() * r.hit.z;  // xi_2 l, l the height of the contact
        // a few ulp of velocities of 3 m/s and of the trace's times
        EXPECT_NEAR(r.next[2], r.v + kick, 2e-14);
        EXPECT_NEAR(r.next[0], r.x + r.v * (r.hit.time + r.rise) + kick * r.rise, 2e-14);
    });
}

TEST(mirror_identities, vertical_motion_is_the_line_map_and_the_corrected_coupling_of_equation_20) {
    double printed_misses_by = 0.0;
    on_many_returns([&](const planar_return& r) {
        const double line = r.m() * r.m() * r.z;  // (9)
        EXPECT_NEAR(r.next[1], line + r.hit.z * r.coupling(), 2e-14);
        printed_misses_by = std::fmax(printed_misses_by,
                                      std::abs(r.next[1] - line - r.hit.z * r.printed_coupling()));
    });
    EXPECT_GT(printed_misses_by, 1e-3);  // as printed, (20) is wrong
}

TEST(mirror_identities, coupling_does_not_vanish_with_the_horizontal_error_but_its_product_does) {
    for (const double small : {1e-4, 1e-6}) {
        const planar_return r("solvable", 0.5 + small, 0.3, 0.0);
        EXPECT_NEAR(r.coupling(), 1 - r.m() * r.m(), 100 * small);
        EXPECT_GT(std::abs(1 - r.m() * r.m()), 0.1);
        EXPECT_LT(std::abs(r.hit.z * r.coupling()), small);
    }
}

// ------------------------------------------------------------------- Schwarzian derivatives

/// Sf = f''' / f' - 3/2 (f'' / f')^2 by central differences in 50 digits.
template <class Map>
real50 schwarzian(const Map& f, const real50& x) {
    const real50 h("1e-9");  // error h^2, rounding 1e-50 / h^3
    const real50 far_down = f(x - h - h), down = f(x - h), here = f(x), up = f(x + h),
                 far_up = f(x + h + h);
    const real50 first = (up - down) / (h + h);
    const real50 second = (up - here - here + down) / (h * h);
    const real50 third = (far_up - up - up + down + down - far_down) / (real50(2.0) * h * h * h);
    const real50 bend = second / first;
    return third / first - real50(1.5) * bend * bend;
}

/// y' = y (a - y)^2 is the model with restitution 0, gravity 1, kappa0 = 0, kappa1 = 1, b* = a.
real50 apex_map(const real50& y, double a) {
    const orbit_answer end = run_row<mirror_line>({"apex",
                                                   {print_real(y)},
                                                   {{"restitution", "0"},
                                                    {"gravity", "1"},
                                                    {"gain_offset", "0"},
                                                    {"energy_gain", "1"},
                                                    {"target_height", print_real(a)}}},
                                                  arithmetic::mp50);
    return parse_real<real50>(end.columns[0]);
}

TEST(mirror_identities, schwarzian_of_the_apex_map_is_the_page_s_and_negative) {
    for (const double a : {1.25, 1.5, 2.0, 2.5, 3.0}) {
        for (double y = 0.1; y < a + 1; y += 0.31) {
            if (std::abs(y - a) < 0.05 || std::abs(y - a / 3) < 0.05) continue;  // poles
            const double got =
                to_double(schwarzian([&](const real50& x) { return apex_map(x, a); }, real50(y)));
            const double expected =
                -6 * (3 * a * a - 8 * a * y + 6 * y * y) / std::pow((a - y) * (a - 3 * y), 2);
            EXPECT_NEAR(got, expected, 1e-9 * std::abs(expected)) << a << " " << y;
            EXPECT_LT(got, 0.0);
        }
    }
}

TEST(mirror_identities, schwarzian_of_the_velocity_map_is_the_page_s_and_negative) {
    // with these parameters y = 2 beta gamma b = x^2, so x' = sqrt(y')
    for (const double a : {1.25, 2.0, 3.0}) {
        for (double x = 0.2; x * x < a; x += 0.23) {
            if (std::abs(3 * x * x - a) < 0.1 || a - x * x < 0.1)
                continue;  // critical, and its end
            const double got = to_double(
                schwarzian([&](const real50& u) { return sqrt(apex_map(u * u, a)); }, real50(x)));
            const double expected = -6 * (a + 6 * x * x) / std::pow(a - 3 * x * x, 2);
            EXPECT_NEAR(got, expected, 1e-9 * std::abs(expected)) << a << " " << x;
            EXPECT_LT(got, 0.0);
        }
    }
}

TEST(mirror_identities, both_critical_points_of_the_apex_map_are_those_of_the_page) {
    for (const double a : {1.5, 2.0, 2.5}) {
        const real50 h("1e-20");
        for (const double y : {a / 3, a}) {  // where a / 3 is rounded, the slope is that small
            const real50 slope =
                (apex_map(real50(y) + h, a) - apex_map(real50(y) - h, a)) / (h + h);
            EXPECT_LT(std::abs(to_double(slope)), 1e-15) << a;
        }
        EXPECT_EQ(apex_map(real50(a), a), real50(0.0));  // so at most one attracting cycle (Singer)
    }
}

}  // namespace
}  // namespace hopscotch::testing_models
