// The same rows give the same bits in every lane, in every order, in packs of every kind; and no
// lane that holds a number that is none disturbs its neighbours or ends as ok.
#include "tests/models/passive_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace hopscotch {
namespace {

using passive_rows::answers;
using passive_rows::can_run;
using passive_rows::rows;
using passive_rows::run;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr backend packs[] = {backend::avx2, backend::avx512};

std::string name_of_backend(backend which) {
    return which == backend::avx2 ? "avx2" : which == backend::avx512 ? "avx512" : "scalar";
}

/// Every field of one row as bits.
std::array<std::uint64_t, 8> bits_of(const answers& of, std::size_t i) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x == x ? x : nan); };
    return {static_cast<std::uint64_t>(of.end[i]),
            static_cast<std::uint64_t>(of.label[i]),
            of.returns[i],
            of.events[i],
            bits(of.time[i]),
            bits(of.speed[i]),
            bits(of.bounces[i]),
            bits(of.loss[i])};
}

void expect_same_bits(const answers& got, std::size_t i, const answers& want, std::size_t j,
                      const std::string& where) {
    EXPECT_EQ(bits_of(got, i), bits_of(want, j))
        << where << ": " << name_of(got.end[i]) << " " << got.speed[i] << " instead of "
        << name_of(want.end[j]) << " " << want.speed[j];
}

/// Rows of every character: ordinary, next to lossless points and cell edges, dying, bouncing long,
/// invalid.
rows mixed_rows(int variant, int section, std::size_t n, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto share = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
    rows of{.section = section, .returns = 3, .max_steps = 400.0};
    of.columns.assign(section == passive_rows::flight ? 4u : 1u, {});
    of.mass_ratio.clear();
    of.restitution.clear();
    of.damping.clear();
    of.increment.clear();
    for (std::size_t i = 0; i < n; ++i) {
        const std::uint64_t kind = random() % 10;
        if (section == passive_rows::lift_off) {
            double alpha = 14.0 * share();
            if (kind == 0) alpha = 4.493409457909064 + (share() - 0.5) * 1e-9;
            if (kind == 1) alpha = M_PI * static_cast<double>(1 + random() % 4);
            if (kind == 2) alpha = 1e-5 * share();
            if (kind == 3) alpha = 300.0 * share();
            if (kind == 4 && random() % 4 == 0)
                alpha = std::array{nan, inf, -1.0, 0.0}[random() % 4];
            of.columns[0].push_back(alpha);
        } else {
            double state[4] = {12.0 * share() - 6.0, 10.0 * share() - 5.0, 5.0 * share(),
                               6.0 * share() - 3.0};
            if (kind < 3) state[2] = 0.0;
            if (kind < 2) state[3] = 0.0;
            if (kind == 0) state[0] = 1.0;
            if (kind == 4 && random() % 4 == 0)
                state[random() % 4] = random() % 2 == 0 ? nan : -inf;
            for (std::size_t c = 0; c < 4; ++c) of.columns[c].push_back(state[c]);
        }
        of.mass_ratio.push_back(std::exp(std::log(1e3) * (2.0 * share() - 1.0)));
        of.restitution.push_back(variant >= passive_rows::elastic && kind % 2 == 0 ? 0.8 * share()
                                                                                   : 0.0);
        of.damping.push_back(variant == passive_rows::damped && kind % 3 == 0 ? 0.3 * share()
                                                                              : 0.0);
        of.increment.push_back(kind == 5 ? 0.2 * share() - 0.1 : 0.0);
    }
    return of;
}

rows reordered(const rows& of, const std::vector<std::size_t>& order) {
    rows result = of;
    const auto apply = [&](const std::vector<double>& from, std::vector<double>& to) {
        if (from.size() == 1) return;
        for (std::size_t i = 0; i < order.size(); ++i) to[i] = from[order[i]];
    };
    for (std::size_t c = 0; c < of.columns.size(); ++c) apply(of.columns[c], result.columns[c]);
    apply(of.mass_ratio, result.mass_ratio);
    apply(of.restitution, result.restitution);
    apply(of.damping, result.damping);
    apply(of.increment, result.increment);
    return result;
}

class passive_lanes : public testing::TestWithParam<backend> {
protected:
    void SetUp() override {
        if (!can_run(GetParam()))
            GTEST_SKIP() << "this processor lacks " << name_of_backend(GetParam())
                         << ", or it is not built";
    }
};

TEST_P(passive_lanes, packs_give_the_bits_of_one_double_after_the_other) {
    for (const char* model : {"passive_hopper", "passive_juggler"}) {
        for (int variant = 0; variant < 4; ++variant) {
            for (const int section : {passive_rows::lift_off, passive_rows::flight}) {
                rows of =
                    mixed_rows(variant, section, 1500, 77 + static_cast<std::uint64_t>(variant));
                of.model = model;
                const answers want = run(of, backend::scalar, variant);
                const answers got = run(of, GetParam(), variant);
                for (std::size_t i = 0; i < want.end.size(); ++i) {
                    expect_same_bits(got, i, want, i,
                                     std::string(model) + " variant " + std::to_string(variant) +
                                         " section " + std::to_string(section) + " row " +
                                         std::to_string(i));
                }
            }
        }
    }
}

TEST_P(passive_lanes, shuffled_rows_give_the_same_bits) {
    std::mt19937_64 random(5);
    for (int variant = 0; variant < 4; ++variant) {
        const rows of = mixed_rows(variant, passive_rows::lift_off, 700, 13);
        const answers want = run(of, GetParam(), variant);
        std::vector<std::size_t> order(of.columns[0].size());
        std::iota(order.begin(), order.end(), 0u);
        for (int trial = 0; trial < 4; ++trial) {
            std::shuffle(order.begin(), order.end(), random);
            const answers got = run(reordered(of, order), GetParam(), variant);
            for (std::size_t i = 0; i < order.size(); ++i)
                expect_same_bits(got, i, want, order[i], "variant " + std::to_string(variant));
        }
    }
}

TEST_P(passive_lanes, certificates_and_labels_do_not_depend_on_the_pack) {
    rows of = mixed_rows(passive_rows::plastic, passive_rows::lift_off, 2000, 21);
    of.returns = 2000;
    of.decided_by = decision::certificate;
    of.died_label = 1;
    for (const int section : {passive_rows::lift_off, passive_rows::flight}) {
        rows with_section = mixed_rows(passive_rows::plastic, section, 1000, 22);
        with_section.returns = 2000;
        with_section.decided_by = decision::certificate;
        with_section.died_label = 1;
        const answers want = run(with_section, backend::scalar, passive_rows::plastic);
        const answers got = run(with_section, GetParam(), passive_rows::plastic);
        for (std::size_t i = 0; i < want.end.size(); ++i)
            expect_same_bits(got, i, want, i, "section");
    }
}

TEST_P(passive_lanes, every_count_of_rows_fills_and_drains_the_pack) {
    const rows all = mixed_rows(passive_rows::plastic, passive_rows::lift_off, 40, 31);
    for (std::size_t n = 1; n <= 40; ++n) {
        std::vector<std::size_t> first(n);
        std::iota(first.begin(), first.end(), 0u);
        rows of = reordered(all, first);
        for (auto* column :
             {&of.columns[0], &of.mass_ratio, &of.restitution, &of.damping, &of.increment})
            column->resize(n);
        const answers want = run(of, backend::scalar, passive_rows::plastic);
        const answers got = run(of, GetParam(), passive_rows::plastic);
        for (std::size_t i = 0; i < n; ++i)
            expect_same_bits(got, i, want, i, std::to_string(n) + " rows");
    }
}

TEST_P(passive_lanes, number_that_is_none_in_any_lane_ends_there_and_nowhere_else) {
    for (int variant = 0; variant < 4; ++variant) {
        for (const double bad : {nan, inf, -inf}) {
            for (std::size_t position = 0; position < 33; ++position) {
                rows of{.returns = 2};
                of.columns.assign(1, std::vector<double>(33));
                for (std::size_t i = 0; i < 33; ++i)
                    of.columns[0][i] = 0.4 + 0.31 * static_cast<double>(i);
                of.mass_ratio = {0.2};
                const answers clean = run(of, backend::scalar, variant);
                of.columns[0][position] = bad;
                const answers hurt = run(of, GetParam(), variant);
                EXPECT_EQ(hurt.end[position], outcome::invalid_start) << position;
                for (std::size_t i = 0; i < 33; ++i) {
                    if (i != position) expect_same_bits(hurt, i, clean, i, "neighbour");
                }
            }
        }
    }
}

TEST_P(passive_lanes, parameter_that_is_none_in_any_lane_ends_there_and_nowhere_else) {
    for (int variant = 0; variant < 4; ++variant) {
        for (int p = 0; p < 4; ++p) {
            rows of{.returns = 2, .max_steps = 300.0};
            of.columns.assign(1, std::vector<double>(20));
            for (std::size_t i = 0; i < 20; ++i)
                of.columns[0][i] = 0.4 + 0.51 * static_cast<double>(i);
            of.mass_ratio.assign(20, 0.2);
            of.restitution.assign(20, 0.0);
            of.damping.assign(20, 0.0);
            of.increment.assign(20, 0.0);
            const answers clean = run(of, backend::scalar, variant);
            std::vector<double>* const column[] = {&of.mass_ratio, &of.restitution, &of.damping,
                                                   &of.increment};
            for (const std::size_t position : {0u, 3u, 7u, 8u, 15u, 19u}) {
                const double kept = (*column[p])[position];
                (*column[p])[position] = nan;
                const answers hurt = run(of, GetParam(), variant);
                EXPECT_NE(hurt.end[position], outcome::ok) << p << " variant " << variant;
                EXPECT_NE(hurt.end[position], outcome::attracted);
                (*column[p])[position] = kept;
                for (std::size_t i = 0; i < 20; ++i) {
                    if (i != position) expect_same_bits(hurt, i, clean, i, "neighbour");
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(targets, passive_lanes, testing::ValuesIn(packs),
                         [](const auto& param) { return name_of_backend(param.param); });

TEST(passive_lanes_scalar, times_left_out_change_nothing_else) {
    for (const int section : {passive_rows::lift_off, passive_rows::flight}) {
        const rows of = mixed_rows(passive_rows::plastic, section, 1500, 41);
        const answers timed = run(of, backend::scalar, passive_rows::plastic);
        answers untimed = run(of, backend::scalar, passive_rows::untimed);
        untimed.time = timed.time;
        for (std::size_t i = 0; i < timed.end.size(); ++i)
            expect_same_bits(untimed, i, timed, i, "untimed");
    }
}

}  // namespace
}  // namespace hopscotch
