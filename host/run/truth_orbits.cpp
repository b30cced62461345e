// Builds and runs single orbits.
#include "host/run/truth_orbits.hpp"

#include "host/run/requests.hpp"
#include "host/scene/grid.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace hopscotch {

std::string exact_decimal(double x) {
    if (!std::isfinite(x)) return fmt::format("{}", x);
    // 767 significant digits hold every double; zeros at the end are cut
    std::string text = fmt::format("{:.766e}", x);
    const std::size_t exponent = text.find('e');
    std::size_t end = exponent;
    while (text[end - 1] == '0') --end;
    if (text[end - 1] == '.') --end;
    return text.erase(end, exponent - end);
}

owned_row row_of(const scene& scene, const label_plan& plan,
                 std::span<const std::uint64_t> coordinates) {
    owned_row result;
    const cell_start start = start_of(scene, coordinates);
    for (const double x : start.columns) result.columns.push_back(exact_decimal(x));
    for (const double x : start.parameters) result.parameters.push_back(exact_decimal(x));
    result.options = scene.options;
    orbit_row& row = result.row;
    row.section = scene.section;
    row.options = result.options.data();
    row.variant = variant_of(scene);
    row.columns = result.columns;
    row.parameters = result.parameters;
    row.returns = most_returns_of(scene);
    row.max_steps = static_cast<double>(scene.accuracy.max_events);
    row.tolerance = scene.accuracy.tolerance;
    row.decided_by = plan.decided_by;
    row.died_label = plan.died_label;
    const std::size_t point = point_index(scene, plan, coordinates);
    if (plan.decided_by == decision::intervals) {
        const auto n_traps = static_cast<std::size_t>(plan.n_traps);
        row.traps = std::span(plan.traps).subspan(point * n_traps, n_traps);
    } else if (plan.decided_by == decision::ellipsoids) {
        const auto n_traps = static_cast<std::size_t>(plan.n_ellipsoids);
        row.ellipsoids = std::span(plan.ellipsoids).subspan(point * n_traps, n_traps);
    }
    return result;
}

std::string_view name_of(precision value) {
    switch (value) {
        case precision::binary64:
            return "double";
        case precision::dd:
            return "dd";
        case precision::mp50:
            return "mp50";
    }
    return "";
}

orbit_answer run_cell(const scene& scene, const label_plan& plan,
                      std::span<const std::uint64_t> coordinates, precision value,
                      const orbit_row& row) {
    orbit_answer answer = run_orbit(*scene.model, value, row);
    if (answer.end != outcome::budget || answer.returns < row.returns || plan.chaotic.empty()) {
        return answer;
    }
    std::vector<double> state;
    for (const std::string& text : answer.columns) state.push_back(std::stod(text));
    answer.label = plan.chaotic_label(point_index(scene, plan, coordinates), state);
    if (answer.label > 0) answer.end = outcome::attracted;
    return answer;
}

orbit_answer run_stored_cell(const scene& scene, const label_plan& plan,
                             std::span<const std::uint64_t> coordinates, precision value,
                             const orbit_row& row, int stored) {
    const orbit_answer answer = run_cell(scene, plan, coordinates, value, row);
    const bool is_rest =
        scene.question.has_labels && plan.died_label > 0 && stored == plan.died_label;
    const bool is_on_its_way = answer.end == outcome::budget && answer.returns == row.returns;
    if (value == precision::binary64 || !is_rest || !is_on_its_way) return answer;
    orbit_row longer = row;
    longer.returns *= 5;
    return run_cell(scene, plan, coordinates, value, longer);
}

namespace {

const orbit_functions& orbits_of(const model_entry& model) {
    if (model.orbits_table == nullptr) {
        throw std::invalid_argument(
            fmt::format("{} is built without single orbits", model.info->name));
    }
    return model.orbits();
}

}  // namespace

exponent_answer run_exponents(const scene& scene, const label_plan& plan, const orbit_row& row) {
    return orbits_of(*scene.model).exponents(row, exponents_of(scene, plan));
}

orbit_answer run_orbit(const model_entry& model, precision value, const orbit_row& row) {
    const orbit_functions& orbits = orbits_of(model);
    switch (value) {
        case precision::binary64:
            return orbits.run_double(row);
        case precision::dd:
            return orbits.run_dd(row);
        case precision::mp50:
            return orbits.run_mp50(row);
    }
    return {};
}

}  // namespace hopscotch
