// What users of other solvers trip over, as tests under names that say so. Those that need a room
// of their own are elsewhere:
// - event on a step's boundary, integrator stuck at the event, two events in one step cancel: the
//   tests first_zero;
// - simultaneous crossings: mirror_planar.reaches_every_outcome_in_the_order_of_the_page,
//   openloop_hopper.a_body_at_the_two_fold_is_held_until_the_thrust_ends;
// - reset by the wrong guard: openloop_hopper.agrees_with_a_stepped_simulation_under_both_guards;
// - callbacks ignored by part of a batch, AVX-512 or a GPU changes results: every_model_lanes,
//   lane_identity, device_loop;
// - a failed event is only logged: uncertain_cells,
//   every_model_lanes.wild_numbers_end_in_an_outcome_and_disturb_no_neighbour;
// - energy drifts through events: passive_energy, passive_nonlinear, long_runs;
// - derivatives through event times are wrong: every_model_derivatives;
// - labels depend on order: device_scenes, cli.test_run, cli.test_shards, cli.test_mpi;
// - out of device memory, assembling results is slow: device_pool;
// - files without dimension scales, missing parts that read as data: python.open,
//   python.open_virtual, virtual_map;
// - progress and --dry-run: cli.test_run, cli.test_large_maps.
#include "host/run/backends.hpp"
#include "tests/models/every_model.hpp"
#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

using namespace hopscotch;
using testing_models::digits;
using testing_models::named_map;

namespace {

named_map paddle(double amplitude, double restitution, double phase, double velocity) {
    return named_map("paddle_juggler", "impact",
                     {{"amplitude", amplitude},
                      {"restitution", restitution},
                      {"phase", phase},
                      {"relative_velocity", velocity}});
}

}  // namespace

// DifferentialEquations.jl #138, #353; scipy #17066: the ball falls through the floor after many
// bounces, or an impact in a chatter is missed
TEST(peer_regression, no_impact_of_a_chatter_is_missed_and_nothing_falls_through) {
    for (const double restitution : {0.3, 0.5, 0.7}) {
        const named_map map(
            "passive_hopper", "liftoff",
            {{"mass_ratio", 1.0}, {"restitution", restitution}, {"liftoff_speed", 2.0}});
        const orbit_answer plain = map.answer(1);
        const orbit_answer truth = map.answer(1, digits::fifty);
        EXPECT_EQ(plain.end, truth.end) << restitution;
        // bounces slower than 1.5e-9 count as contact (chatter_speed in passive/return_map.hpp);
        // their time is added, and they have no energy that a double could hold
        EXPECT_NEAR(std::stod(plain.time), std::stod(truth.time), 1e-14) << restitution;
        EXPECT_NEAR(std::stod(plain.extras[1]), std::stod(truth.extras[1]), 1e-12) << restitution;
    }
}

// OpenModelica #12190: Zeno falls through. Here the catch ends at the release, in closed form.
TEST(peer_regression, zeno_ends_in_a_catch_and_a_release_at_the_closed_form) {
    for (const double amplitude : {1.5, 1.7, 2.0}) {
        const orbit_answer answer = paddle(amplitude, 0.2, 0.3, 1e-6).answer(1);
        ASSERT_EQ(answer.end, outcome::ok) << amplitude;
        EXPECT_EQ(std::stod(answer.extras[0]), 1.0) << "one catch";
        EXPECT_NEAR(std::stod(answer.columns[0]), std::asin(1.0 / amplitude), 1e-15) << amplitude;
        EXPECT_EQ(std::stod(answer.columns[1]), 0.0) << amplitude;
    }
}

// ChaosTools #188: runs that never end
TEST(peer_regression, an_endless_bounce_ends_with_the_outcome_budget) {
    const named_map map("passive_hopper", "liftoff",
                        {{"mass_ratio", 1.0}, {"restitution", 1.0}, {"liftoff_speed", 4.4}});
    EXPECT_EQ(map.answer(1).end, outcome::budget);
}

// A NaN ends as a normal result (many): in every model, section, column and backend it has an
// outcome of its own.
TEST(peer_regression, a_start_that_is_no_number_never_ends_as_a_result) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const model_entry* model : every_model::models()) {
        const int n_sections = static_cast<int>(model->info->sections.size());
        for (int section = 0; section < n_sections; ++section) {
            every_model::rows of = every_model::random_rows(*model, section, {}, 12, 5);
            for (std::size_t c = 0; c < of.columns.size(); ++c) {
                every_model::rows broken = of;
                for (double& x : broken.columns[c]) x = nan;
                for (const backend which : {backend::scalar, backend::avx2, backend::avx512}) {
                    if (!reason_against(which).empty()) continue;
                    const auto all =
                        every_model::run(broken, which, every_model::variant_of(broken));
                    for (std::size_t i = 0; i < broken.size(); ++i) {
                        const outcome end = all.ended(i);
                        EXPECT_TRUE(end == outcome::invalid_start || end == outcome::not_finite)
                            << every_model::describe(broken, i) << " ends " << name_of(end);
                    }
                }
            }
        }
    }
}
