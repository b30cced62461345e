// Orbits from solutions.
#include "analysis/continuation/describe.hpp"

#include "analysis/continuation/event_signature.hpp"
#include "analysis/continuation/stability_tests.hpp"
#include "analysis/periodic/return_equation.hpp"

namespace hopscotch {

orbit_on_branch describe(const branch_equation& equation, const curve_point& point) {
    orbit_on_branch orbit{.unknowns = point.unknowns};
    const map_point map = equation.map_at(point.unknowns);
    orbit.variable = equation.variable_of(point.unknowns);
    orbit.state = equation.state_of(point.unknowns);
    wrap_phases(map, orbit.state);
    orbit.multipliers = multipliers_of(equation.derivative_at(point.unknowns));
    orbit.word = event_signature(map, orbit.state, equation.period());
    return orbit;
}

std::vector<std::vector<double>> points_of(const branch_family& family, int period,
                                           const orbit_on_branch& orbit) {
    const branch_equation equation(family, period);
    const map_point map = equation.map_at(orbit.unknowns);
    std::vector<std::vector<double>> points{orbit.state};
    for (int i = 1; i < period; ++i) {
        const return_jet jet = map.jet(orbit.state.data(), static_cast<std::uint32_t>(i));
        if (jet.end != outcome::ok) break;
        points.emplace_back(jet.state, jet.state + map.n_columns());
    }
    return points;
}

}  // namespace hopscotch
