// Exact structure of the plastic return map (model page, sections 3 and 4): which landings are
// sustained, the single-impact branch in closed form, where hopping stops, how far each lossless
// motion attracts.
#include "tests/models/passive_rows.hpp"
#include "tests/models/passive_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hopscotch {
namespace {

using namespace passive_truth;
using passive_rows::answers;
using passive_rows::hop;
using passive_rows::rows;
using passive_rows::run;

real50 kappa_of(double mass_ratio) {
    const real50 total = real50(mass_ratio) + 1.0;
    return real50(mass_ratio) / (total * total);
}

TEST(passive_structure, half_flight_function_takes_m_pi_and_the_lossless_points_to_themselves) {
    for (int m = 1; m <= 6; ++m) {
        const real50 turns = pi50() * static_cast<double>(m);
        EXPECT_LT(abs(half_flight(turns).alpha() - turns), real50(1e-58));
        EXPECT_LT(abs(half_flight(lossless(m)).alpha() - lossless(m)), real50(1e-58));
    }
}

TEST(passive_structure, truths_agree_on_the_single_impact_branch) {
    // the marching simulator against section 3's closed form: the two truths of these tests
    for (const double alpha : {0.7, 2.9, 4.6, 5.5, 7.9, 10.95, 14.1}) {
        const half_flight there = half_flight_of(alpha);
        const history marched = simulator({.mass_ratio = 0.3}).from_lift_off(alpha);
        EXPECT_EQ(marched.impacts, 1);
        EXPECT_LT(abs(marched.flight_time - there.x * 2.0), real50(1e-45)) << alpha;
        const real50 squared = real50(alpha) * alpha - kappa_of(0.3) * there.toll();
        ASSERT_EQ(marched.lifts, squared > 0.0);
        if (marched.lifts) EXPECT_LT(abs(marched.speed - sqrt(squared)), real50(1e-45)) << alpha;
    }
}

TEST(passive_structure, landing_is_sustained_from_each_lossless_speed_to_the_end_of_its_cell) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int k = 0; k <= 20; ++k) {
        const double point = to_double(lossless(k));
        const double cell = k * M_PI;
        const double end = (k + 1) * M_PI;
        for (int i = 0; i < 40; ++i) {
            const double mass_ratio = std::exp(std::log(1e4) * (2.0 * share(random) - 1.0));
            const double right = point + (end - point) * (1e-6 + share(random) * (1.0 - 2e-6));
            EXPECT_EQ(hop(right, mass_ratio).bounces, 0.0) << right << " " << mass_ratio;
            if (k == 0) continue;
            const double left = cell + (point - cell) * (1e-6 + share(random) * (1.0 - 2e-6));
            EXPECT_GE(hop(left, mass_ratio).bounces, 1.0) << left << " " << mass_ratio;
        }
    }
}

TEST(passive_structure,
     single_impact_branch_has_the_closed_form_and_one_kappa_for_m_and_its_inverse) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 150; ++i) {
        const int k = i % 8;
        const real50 point = lossless(k);
        const double alpha = to_double(point) + to_double(pi50() * (k + 1.0) - point) *
                                                    (0.001 + 0.998 * share(random));
        const double mass_ratio =
            std::ldexp(1.0, static_cast<int>(random() % 13) - 6);  // exact inverse
        const half_flight there = half_flight_of(alpha);
        const real50 loss = kappa_of(mass_ratio) * there.toll();
        const real50 squared = real50(alpha) * alpha - loss;
        const auto heavy = hop(alpha, mass_ratio);
        const auto light = hop(alpha, 1.0 / mass_ratio);
        EXPECT_EQ(heavy.end == outcome::ok, squared > 0.0);
        EXPECT_EQ(light.end, heavy.end);
        // alpha and x carry a few ulp; f multiplies them by f' = (alpha + 4 kappa S p (x + S p /
        // q)) / f
        const double rounding = 2e-16 * alpha;
        EXPECT_NEAR(heavy.loss, to_double(loss), 40.0 * rounding * (1.0 + to_double(loss)));
        if (heavy.end != outcome::ok) continue;
        const real50 f = sqrt(squared);
        const real50 slope = (real50(alpha) + kappa_of(mass_ratio) * 4.0 * there.sine * there.p *
                                                  (there.x + there.sine * there.p / there.q)) /
                             f;
        const double allowed = 8.0 * rounding * (1.0 + std::abs(to_double(slope)));
        EXPECT_NEAR(heavy.speed, to_double(f), allowed) << alpha << " " << mass_ratio;
        EXPECT_NEAR(light.speed, to_double(f), allowed);
    }
}

TEST(passive_structure, bounce_branches_differ_between_m_and_its_inverse) {
    for (const double alpha : {4.2, 6.6}) {  // H9
        EXPECT_GT(std::abs(hop(alpha, 0.05).speed - hop(alpha, 20.0).speed), 1e-3) << alpha;
    }
    for (const double alpha : {4.6, 5.5, 8.0}) {
        EXPECT_NEAR(hop(alpha, 0.05).speed, hop(alpha, 20.0).speed,
                    1e-13);  // kappa differs by an ulp
    }
}

TEST(passive_structure, stuck_intervals_at_mass_ratio_1_are_those_of_the_page) {
    // page: (1.424197, pi) and (5.621749, 2 pi); the ends here from 4 p^4 kappa = (x^2 - S^2)^2 in
    // 50 digits
    const double page[] = {1.424197, 5.621749};
    for (int k = 0; k <= 1; ++k) {
        const real50 low = k == 0 ? real50(1.0) : lossless(1) + 0.01;
        const auto left_over = [](const real50& x) {
            const half_flight there(x);
            return there.alpha() * there.alpha() - there.toll() * 0.25;
        };
        const real50 edge = half_flight(bisect(left_over, low, pi50() * (k + 1.0))).alpha();
        EXPECT_NEAR(to_double(edge), page[k], 1e-6);
        const double near = to_double(edge);
        EXPECT_EQ(hop(near - 1e-13, 1.0).end, outcome::ok);
        EXPECT_EQ(hop(near + 1e-13, 1.0).end, outcome::stuck);
        const double end = (k + 1) * M_PI;
        EXPECT_EQ(hop(end - 1e-9, 1.0).end, outcome::stuck);
        EXPECT_EQ(hop(0.5 * (near + end), 1.0).end, outcome::stuck);
    }
}

TEST(passive_structure, cells_have_stuck_starts_only_for_mass_ratios_in_an_interval_about_1) {
    struct cell {
        int k;
        double low, high;
    };
    for (const cell& c :
         {cell{0, 0.32750, 3.05345}, cell{1, 0.62636, 1.59654}, cell{2, 0.73706, 1.35673}}) {
        const auto needed = [&](const real50& x) {  // kappa at which alpha^2 = loss
            const half_flight there(x);
            return there.alpha() * there.alpha() / there.toll();
        };
        const real50 place = minimise(needed, lossless(c.k) + 0.3, pi50() * (c.k + 1.0));
        const real50 least = needed(place);
        // kappa = M / (1 + M)^2 solved for M
        const real50 half = real50(0.5) / least - 1.0;
        const real50 high = half + sqrt(half * half - 1.0);
        EXPECT_NEAR(to_double(high), c.high, 6e-6);  // five digits printed
        EXPECT_NEAR(to_double(real50(1.0) / high), c.low, 6e-6);
        const double alpha = to_double(half_flight(place).alpha());
        for (const double end : {to_double(high), to_double(real50(1.0) / high)}) {
            const double inward = end > 1.0 ? end * (1.0 - 1e-9) : end * (1.0 + 1e-9);
            const double outward = end > 1.0 ? end * (1.0 + 1e-9) : end * (1.0 - 1e-9);
            EXPECT_EQ(hop(alpha, inward).end, outcome::stuck) << c.k << " " << end;
            EXPECT_EQ(hop(alpha, outward).end, outcome::ok) << c.k << " " << end;
        }
    }
}

/// r_k(M) as a lift-off speed: the first place where kappa = D, or the end of the branch.
real50 trap_end(int k, double mass_ratio) {
    const real50 place = least_escape_place(k);
    const real50 kappa = kappa_of(mass_ratio);
    if (kappa <= escaping_kappa(k, place)) return pi50() * (k + 1.0);
    const real50 x = bisect([&](const real50& at) { return escaping_kappa(k, at) - kappa; },
                            lossless(k) + 1e-12, place);
    return half_flight(x).alpha();
}

TEST(passive_structure, extents_of_attraction_at_mass_ratio_1_are_those_of_the_page) {
    EXPECT_NEAR(to_double(trap_end(1, 1.0) - lossless(1)), 0.0159187, 6e-8);
    EXPECT_NEAR(to_double(trap_end(2, 1.0) - lossless(2)), 0.00332297, 6e-9);
}

TEST(passive_structure, whole_branches_are_trapped_beyond_the_page_s_mass_ratios) {
    const double page[2][2] = {{0.103458, 9.66578}, {0.0644945, 15.5052}};
    for (int k = 1; k <= 2; ++k) {
        const real50 least = escaping_kappa(k, least_escape_place(k));
        const real50 half = real50(0.5) / least - 1.0;
        const real50 high = half + sqrt(half * half - 1.0);
        EXPECT_NEAR(to_double(high) / page[k - 1][1], 1.0, 1e-6);
        EXPECT_NEAR(to_double(real50(1.0) / high) / page[k - 1][0], 1.0, 1e-5);
        for (const double side : {0.999, 1.001}) {
            // at the least favourable place of the branch
            const double alpha = to_double(half_flight(least_escape_place(k)).alpha());
            const auto ends = run({.columns = {{alpha}},
                                   .mass_ratio = {to_double(high) * side},
                                   .returns = 5000,
                                   .decided_by = decision::certificate,
                                   .died_label = 1});
            EXPECT_EQ(ends.label[0] == k + 1, side > 1.0) << k << " " << side;
        }
    }
}

/// The page's rigorous classification (section 4) with 50-digit traps; 0 where hopping dies.
int class_of(double alpha, double mass_ratio, const std::vector<real50>& ends) {
    const simulator hopper({.mass_ratio = mass_ratio});
    real50 speed(alpha);
    for (int i = 0; i < 200; ++i) {
        int k = 0;
        while (k + 1 < static_cast<int>(ends.size()) && lossless(k + 1) <= speed) ++k;
        if (k == 0) return 0;
        if (speed <= ends[static_cast<std::size_t>(k)]) return k;
        const history next = hopper.from_lift_off(speed);
        if (!next.lifts) return 0;
        speed = next.speed;
    }
    return -1;
}

TEST(passive_structure, certificate_gives_the_class_of_the_rigorous_criterion) {
    for (const double mass_ratio : {0.02, 0.3, 1.0, 7.0, 40.0}) {
        std::vector<real50> ends{real50(0.0)};
        for (int k = 1; k <= 4; ++k) ends.push_back(trap_end(k, mass_ratio));
        rows of{.mass_ratio = {mass_ratio},
                .returns = 5000,
                .decided_by = decision::certificate,
                .died_label = 1};
        of.columns.emplace_back();
        for (int i = 0; i < 40; ++i) of.columns[0].push_back(0.1 + 15.4 * (i + 0.37) / 40.0);
        const answers found = run(of);
        for (std::size_t i = 0; i < of.columns[0].size(); ++i) {
            EXPECT_EQ(found.end[i], outcome::attracted);
            EXPECT_EQ(found.label[i] - 1, class_of(of.columns[0][i], mass_ratio, ends))
                << of.columns[0][i] << " at " << mass_ratio;
        }
    }
}

TEST(passive_structure, certificate_decides_on_both_sides_of_every_trap_end) {
    for (int k = 1; k <= 6; ++k) {
        for (const double mass_ratio : {1.0, 0.4, 3.0}) {
            const real50 end = trap_end(k, mass_ratio);
            if (end >= pi50() * (k + 1.0)) continue;
            const double edge = to_double(end);
            // the extent is D's crossing: alpha is sharp to an ulp, the map to a few
            const auto found = run({.columns = {{edge - 1e-12, edge + 1e-12}},
                                    .mass_ratio = {mass_ratio},
                                    .returns = 5000,
                                    .decided_by = decision::certificate,
                                    .died_label = 1});
            EXPECT_EQ(found.label[0], k + 1) << k << " " << mass_ratio;
            EXPECT_LE(found.label[1], k) << k << " " << mass_ratio;
        }
    }
}

TEST(passive_structure, contact_start_gets_the_class_of_its_lift_off_speed) {
    // M = 1: alpha^2 = (Y - 1)(Y + 3) / 2 from rest at Y; alpha = 4.5 lies in T_1, 3.4 and 6.0 die
    for (const double alpha : {4.5, 3.4, 6.0, 7.727}) {
        const double y = -1.0 - std::sqrt(4.0 + 2.0 * alpha * alpha);
        const auto from_contact = run({.section = passive_rows::flight,
                                       .columns = {{y}, {0.0}, {0.0}, {0.0}},
                                       .returns = 5000,
                                       .decided_by = decision::certificate,
                                       .died_label = 1});
        const auto from_lift_off = run({.columns = {{alpha}},
                                        .returns = 5000,
                                        .decided_by = decision::certificate,
                                        .died_label = 1});
        EXPECT_EQ(from_contact.label[0], from_lift_off.label[0]) << alpha;
    }
    EXPECT_EQ(
        run({.columns = {{4.5}}, .returns = 5000, .decided_by = decision::certificate}).label[0],
        2);
}

TEST(passive_structure, single_impact_maps_lose_no_more_than_alpha_to_the_fifth_when_small) {
    for (const double alpha : {1e-2, 1e-3, 1e-6}) {  // H3: alpha - f -> (32/9) kappa alpha^5
        const auto one = hop(alpha, 2.0);
        const double lost = one.loss / (2.0 * alpha);
        // next order is alpha^2 relative, with a coefficient of order one
        EXPECT_NEAR(lost / (32.0 / 9.0 * (2.0 / 9.0) * std::pow(alpha, 5)), 1.0,
                    3.0 * alpha * alpha + 1e-13);
    }
}

}  // namespace
}  // namespace hopscotch
