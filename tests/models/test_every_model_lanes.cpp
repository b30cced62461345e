// For every model, section, choice of options and compile-time variant: packs give the bits of
// double, whatever a row's place in the pack, and numbers outside all reason end in an outcome.
#include "tests/models/every_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace hopscotch {
namespace {

using namespace every_model;

constexpr backend packs[] = {backend::avx2, backend::avx512};

std::vector<backend> available(const model_entry& model) {
    std::vector<backend> some;
    for (const backend which : packs) {
        if (model.has(which) && reason_against(which).empty()) some.push_back(which);
    }
    return some;
}

int n_sections(const model_entry& model) { return static_cast<int>(model.info->sections.size()); }

/// n random starts, and about n more that complete a return; every second of these goes on from
/// where that return led.
rows starts_that_go_on(const model_entry& model, int section, const std::vector<int>& options,
                       std::size_t n, std::uint64_t seed) {
    rows all = random_rows(model, section, options, n, seed);
    for (std::uint64_t batch = 1; batch <= 40 && all.size() < 2 * n; ++batch) {
        rows fresh = random_rows(model, section, options, n, seed + 1000 * batch);
        fresh.returns = 1;
        const answers once = run(fresh, backend::scalar, variant_of(fresh));
        for (std::size_t i = 0; i < n && all.size() < 2 * n; ++i) {
            if (once.ended(i) != outcome::ok) continue;
            const bool goes_on = fresh.starts_on().returns_to == section && i % 2 == 0;
            for (std::size_t c = 0; c < all.columns.size(); ++c) {
                all.columns[c].push_back(goes_on ? once.state[c][i] : fresh.columns[c][i]);
            }
            for (std::size_t p = 0; p < all.parameters.size(); ++p) {
                all.parameters[p].push_back(fresh.parameters[p][i]);
            }
        }
    }
    all.returns = 3;
    return all;
}

/// The rows grouped by the variant that the model would choose for each alone.
std::map<int, rows> by_variant(const rows& of, bool wants_time) {
    std::map<int, std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < of.size(); ++i) {
        groups[variant_of(picked(of, {i}), wants_time)].push_back(i);
    }
    std::map<int, rows> result;
    for (const auto& [variant, which] : groups) result[variant] = picked(of, which);
    return result;
}

void expect_same(const rows& of, const answers& got, std::size_t i, const answers& want,
                 std::size_t j, const std::string& where) {
    if (got.bits(i) == want.bits(j)) return;
    ADD_FAILURE() << where << ": " << describe(of, j) << "\n  " << name_of(got.ended(i))
                  << " returns " << got.returns[i] << " time " << got.time[i] << " state "
                  << got.state[0][i] << "\n  instead of " << name_of(want.ended(j)) << " returns "
                  << want.returns[j] << " time " << want.time[j] << " state " << want.state[0][j];
}

class every_model_lanes : public testing::TestWithParam<const model_entry*> {
protected:
    const model_entry& model = *GetParam();

    template <class Function>
    void for_every_choice(const Function& function) const {
        for (int section = 0; section < n_sections(model); ++section) {
            std::uint64_t seed = 100;
            for (const std::vector<int>& options : all_options(*model.info)) {
                function(section, options, ++seed);
                if (HasFailure()) return;
            }
        }
    }
};

TEST_P(every_model_lanes, packs_give_the_bits_of_one_double_after_the_other) {
    for_every_choice([&](int section, const std::vector<int>& options, std::uint64_t seed) {
        const rows all = starts_that_go_on(model, section, options, 400, seed);
        std::map<int, rows> groups = by_variant(all, true);
        for (auto& [variant, of] : by_variant(all, false)) groups.try_emplace(variant, of);
        groups.insert_or_assign(variant_of(all), all);  // the variant that serves them all
        std::uint64_t completed = 0;
        for (auto& [variant, of] : groups) {
            for (const decision by : {decision::returns, decision::certificate}) {
                if (by == decision::certificate && model.certificate_covers == nullptr) continue;
                of.decided_by = by;
                const answers want = run(of, backend::scalar, variant);
                for (const std::uint32_t n : want.returns) completed += n;
                for (const backend which : available(model)) {
                    const answers got = run(of, which, variant);
                    const std::string where =
                        std::string(name_of(which)) + " variant " + std::to_string(variant);
                    for (std::size_t i = 0; i < of.size(); ++i) {
                        expect_same(of, got, i, want, i, where);
                        if (HasFailure()) return;
                    }
                }
            }
        }
        // otherwise this test would show little
        EXPECT_GT(completed, 100u) << all.name();
    });
}

TEST_P(every_model_lanes, rows_in_any_order_give_the_same_bits) {
    for_every_choice([&](int section, const std::vector<int>& options, std::uint64_t seed) {
        const rows of = starts_that_go_on(model, section, options, 120, seed);
        const int variant = variant_of(of);
        const answers want = run(of, backend::scalar, variant);
        std::vector<std::size_t> order(of.size());
        std::iota(order.rbegin(), order.rend(), 0u);
        std::mt19937_64 random(seed);
        for (int trial = 0; trial < 3; ++trial) {
            const rows moved = picked(of, order);
            for (const backend which : available(model)) {
                const answers got = run(moved, which, variant);
                for (std::size_t i = 0; i < order.size(); ++i) {
                    expect_same(of, got, i, want, order[i], std::string(name_of(which)));
                    if (HasFailure()) return;
                }
            }
            for (std::size_t i = order.size(); i-- > 1;)
                std::swap(order[i], order[random() % (i + 1)]);
        }
    });
}

TEST_P(every_model_lanes, every_count_of_rows_fills_and_drains_the_pack) {
    const rows all = starts_that_go_on(model, 0, std::vector<int>(most_options, 0), 40, 7);
    const int variant = variant_of(all);
    const answers want = run(all, backend::scalar, variant);
    for (std::size_t n = 1; n <= std::min<std::size_t>(all.size(), 50); ++n) {
        std::vector<std::size_t> first(n);
        std::iota(first.begin(), first.end(), 0u);
        const rows of = picked(all, first);
        for (const backend which : available(model)) {
            const answers got = run(of, which, variant);
            for (std::size_t i = 0; i < n; ++i) {
                expect_same(of, got, i, want, i, std::to_string(n) + " rows");
                if (HasFailure()) return;
            }
        }
    }
}

bool accepts(const parameter_info& parameter, double x) {
    return parameter.valid.holds(x) || (x != x && parameter.standard != parameter.standard);
}

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double bad_numbers[] = {not_given, inf,    -inf,   1e300,   -1e300, 1.7e308,
                                  1e160,     5e-324, 1e-310, -1e-310, 0.0,    -0.0,
                                  1e18,      -1e18,  1e-160, 1.0,     -1.0,   1e6};

TEST_P(every_model_lanes, wild_numbers_end_in_an_outcome_and_disturb_no_neighbour) {
    for_every_choice([&](int section, const std::vector<int>& options, std::uint64_t seed) {
        rows clean = starts_that_go_on(model, section, options, 40, seed);
        clean.returns = 2;
        clean.max_steps = 200.0;
        const int variant = variant_of(clean);
        const answers want = run(clean, backend::scalar, variant);
        const std::size_t n_columns = clean.columns.size();
        for (std::size_t place = 0; place < n_columns + clean.parameters.size(); ++place) {
            const bool is_column = place < n_columns;
            rows wild = clean;
            auto& values = is_column ? wild.columns[place] : wild.parameters[place - n_columns];
            const auto is_wild = [](std::size_t i) { return i % 4 == 1; };
            for (std::size_t i = 0; i < wild.size(); ++i) {
                if (is_wild(i)) values[i] = bad_numbers[(i / 4) % std::size(bad_numbers)];
            }
            const answers alone = run(wild, backend::scalar, variant);
            for (std::size_t i = 0; i < wild.size(); ++i) {
                const bool is_done = alone.ended(i) == outcome::ok;
                // parameters outside their range never reach a kernel: the program refuses them
                const bool is_legal =
                    is_column || accepts(model.info->parameters[place - n_columns], values[i]);
                EXPECT_TRUE(!is_done || !is_legal || alone.is_sound(i))
                    << describe(wild, i) << ": ok with time " << alone.time[i] << ", state "
                    << alone.state[0][i];
                if (!is_wild(i)) expect_same(wild, alone, i, want, i, "neighbour");
            }
            for (const backend which : available(model)) {
                const answers got = run(wild, which, variant);
                for (std::size_t i = 0; i < wild.size(); ++i) {
                    expect_same(wild, got, i, alone, i, std::string(name_of(which)));
                    if (HasFailure()) return;
                }
            }
        }
    });
}

INSTANTIATE_TEST_SUITE_P(all, every_model_lanes, testing::ValuesIn(models()),
                         [](const auto& of) { return std::string(of.param->info->name); });

}  // namespace
}  // namespace hopscotch
