// Lyapunov exponents of a scene of every model: their sum is the determinant's logarithm, and all
// backends give the same bits.
#include "analysis/labels/plan.hpp"
#include "analysis/orbit/orbit_functions.hpp"
#include "host/run/estimate.hpp"
#include "host/run/requests.hpp"
#include "host/scene/grid.hpp"
#include "tests/models/exponent_cells.hpp"

#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <bit>
#include <filesystem>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace hopscotch {
namespace {

using testing_models::exponent_cells;
using testing_models::spread;

/// Scenes that can be asked for exponents: one whose question has keys of its own cannot.
std::vector<scene> every_scene(const std::vector<std::string>& overrides) {
    std::vector<scene> scenes;
    for (const auto& file :
         std::filesystem::directory_iterator(HOPSCOTCH_SOURCE "/configs/scenes")) {
        if (file.path().extension() != ".toml") continue;
        try {
            scenes.push_back(read_scene(file.path(), overrides));
        } catch (const scene_error&) {
            continue;
        }
    }
    return scenes;
}

/// ln |det| of the derivative of `returns` returns that follow a transient; NaN where there are
/// none.
double log_determinant(const scene& scene, std::uint64_t cell, std::uint32_t transient,
                       std::uint32_t returns) {
    const double none = std::nan("");
    const cell_start start = start_of(scene, coordinates_of(scene, cell));
    jet_query query{.section = scene.section, .options = scene.options.data()};
    query.variant = scene.model->variant(
        {start.parameters.data(), start.parameters.data(), scene.options.data()});
    query.columns = start.columns.data();
    query.parameters = start.parameters.data();
    query.returns = transient;
    query.max_steps = static_cast<double>(scene.accuracy.max_events);
    query.tolerance = scene.accuracy.tolerance;
    const return_jet settled = scene.model->orbits().jet(query);
    if (settled.end != outcome::ok) return none;
    query.section = scene.start_section().returns_to;
    query.returns = 1;
    const auto n = static_cast<Eigen::Index>(scene.end_section().columns.size());
    double state[most_columns];
    std::copy(std::begin(settled.state), std::end(settled.state), state);
    query.columns = state;
    double sum = 0.0;
    for (std::uint32_t i = 0; i < returns; ++i) {
        const return_jet jet = scene.model->orbits().jet(query);
        if (jet.end != outcome::ok) return none;
        Eigen::MatrixXd derivative(n, n);
        for (Eigen::Index row = 0; row < n; ++row) {
            for (Eigen::Index c = 0; c < n; ++c) derivative(row, c) = jet.derivative[row][c];
        }
        sum += std::log(std::abs(derivative.determinant()));
        std::copy(std::begin(jet.state), std::end(jet.state), state);
    }
    return sum;
}

TEST(exponents_of_every_scene, add_up_to_the_determinant_of_the_return_map) {
    constexpr std::uint32_t transient = 25;
    constexpr std::uint32_t block = 6;
    const std::vector<std::string> short_run{"question.kind=\"lyapunov\"",
                                             "question.returns=6",
                                             "question.transient=25",
                                             "question.block=6",
                                             "output.layers=[\"lyapunov_rate\"]",
                                             "accuracy.max_events=2000"};
    std::size_t n_compared = 0;
    for (const scene& scene : every_scene(short_run)) {
        const std::size_t n_columns = scene.end_section().columns.size();
        const std::vector<std::uint64_t> chosen = sample_cells(scene.n_cells(), 40, 5);
        cell_request cells = request_of(scene, plan_labels(scene), chosen);
        std::vector<std::vector<double>> exponents(n_columns, std::vector<double>(chosen.size()));
        for (std::size_t k = 0; k < n_columns; ++k) {
            cells.request.exponents.exponents[k] = exponents[k].data();
        }
        kernel_of(scene, "auto").run(cells.request);
        std::size_t n_here = 0;
        std::size_t n_off = 0;
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            double sum = 0.0;
            for (const auto& exponent : exponents) sum += block * exponent[i];
            const double truth = log_determinant(scene, chosen[i], transient, block);
            if (!std::isfinite(sum) || !std::isfinite(truth) || truth < -60.0) continue;
            ++n_here;
            n_off += std::abs(sum - truth) > 1e-6 ? 1 : 0;
        }
        // next to a grazing contact six returns magnify the rounding of one
        EXPECT_LE(n_off, n_here / 10) << scene.name << ": " << n_off << " of " << n_here;
        n_compared += n_here;
    }
    EXPECT_GT(n_compared, 400u);
}

/// Results of one kernel call, as bits.
struct exponent_layers {
    std::vector<double> numbers;
    std::vector<std::uint32_t> counts;
    std::vector<std::uint8_t> codes;

    exponent_layers(cell_request& cells, const kernel_choice& kernel) {
        const std::size_t n = cells.request.n_cells;
        numbers.assign(6 * n, 0.0);
        counts.assign(2 * n, 0);
        codes.assign(2 * n, 0);
        exponent_request& to = cells.request.exponents;
        for (std::size_t k = 0; k < 4; ++k) to.exponents[k] = numbers.data() + k * n;
        to.standard_error = numbers.data() + 4 * n;
        to.rate = numbers.data() + 5 * n;
        to.returns = counts.data();
        to.motion = codes.data();
        cells.request.returns = counts.data() + n;
        cells.request.outcome = codes.data() + n;
        kernel.run(cells.request);
    }
    std::size_t n_different(const exponent_layers& other) const {
        std::size_t n = 0;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const bool both_nan = numbers[i] != numbers[i] && other.numbers[i] != other.numbers[i];
            const bool same = std::bit_cast<std::uint64_t>(numbers[i]) ==
                              std::bit_cast<std::uint64_t>(other.numbers[i]);
            n += both_nan || same ? 0 : 1;
        }
        for (std::size_t i = 0; i < counts.size(); ++i) n += counts[i] == other.counts[i] ? 0 : 1;
        for (std::size_t i = 0; i < codes.size(); ++i) n += codes[i] == other.codes[i] ? 0 : 1;
        return n;
    }
};

TEST(exponents_of_every_scene, have_the_same_bits_on_every_backend) {
    const std::vector<std::string> as_chaos_map{"question.kind=\"lyapunov\"",
                                                "question.returns=300",
                                                "question.transient=30",
                                                "question.block=20",
                                                "question.error=0.005",
                                                "question.min_blocks=8",
                                                "output.layers=[\"lyapunov_rate\"]",
                                                "accuracy.max_events=2000"};
    std::size_t n_scenes = 0;
    std::size_t n_numbers = 0;
    for (const scene& scene : every_scene(as_chaos_map)) {
        const std::vector<std::uint64_t> chosen = sample_cells(scene.n_cells(), 60, 3);
        cell_request cells = request_of(scene, plan_labels(scene), chosen);
        const exponent_layers reference(cells, kernel_of(scene, "scalar"));
        for (const double x : reference.numbers) n_numbers += std::isfinite(x) && x != 0.0 ? 1 : 0;
        ++n_scenes;
        for (const backend which : {backend::avx2, backend::avx512}) {
            if (!reason_against(which).empty()) continue;
            const exponent_layers other(cells, kernel_of(scene, name_of(which)));
            EXPECT_EQ(reference.n_different(other), 0u) << scene.name << " " << name_of(which);
        }
    }
    EXPECT_GT(n_scenes, 25u);
    EXPECT_GT(n_numbers, 5000u);
}

}  // namespace
}  // namespace hopscotch
