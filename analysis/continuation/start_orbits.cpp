// Newton searches from grids of starts.
#include "analysis/continuation/start_orbits.hpp"

#include "analysis/attractors/settle.hpp"

#include <algorithm>

namespace hopscotch {
namespace {

/// Whether the orbit keeps away from ends that its columns cannot reach: a limit of orbits there (a
/// hop of no height) is none itself.
bool is_inside(const map_point& map, const periodic_orbit& orbit, std::span<const double> scale) {
    constexpr double apart = 1e-6;
    const auto columns = map.columns_of().columns;
    for (int i = 0; i < orbit.period; ++i) {
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const range& valid = columns[c].valid;
            const double x = orbit.point(i)[c];
            const double reach = apart * scale[c];
            if (!valid.has_lowest && x < valid.lowest + reach) return false;
            if (!valid.has_highest && x > valid.highest - reach) return false;
        }
    }
    return true;
}

void add_new(std::vector<periodic_orbit>& orbits, const branch_family& family, const map_point& map,
             std::span<const double> guess, int period) {
    newton_limits limits{.free_columns = family.columns, .scale = family.scale};
    const auto orbit = refine_periodic_orbit(map, guess, period, limits);
    if (!orbit || !is_inside(map, *orbit, family.scale)) return;
    const bool is_known = std::any_of(orbits.begin(), orbits.end(), [&](const auto& known) {
        return is_same_orbit(map, known, *orbit, family.scale);
    });
    if (!is_known) orbits.push_back(*orbit);
}

}  // namespace

std::vector<double> grid_of_starts(const std::vector<sampled_column>& columns) {
    std::vector<double> starts;
    std::vector<int> index(columns.size(), 0);
    while (true) {
        for (std::size_t c = 0; c < columns.size(); ++c)
            starts.push_back(columns[c].sample(index[c]));
        std::size_t c = 0;
        while (c < columns.size() && ++index[c] == columns[c].n_samples) index[c++] = 0;
        if (c == columns.size()) return starts;
    }
}

bool is_same_orbit(const map_point& map, const periodic_orbit& a, const periodic_orbit& b,
                   std::span<const double> scale) {
    constexpr double apart = 1e-7;
    if (a.period != b.period) return false;
    for (int i = 0; i < a.period; ++i) {
        if (distance_of(map, a.point(i), b.point(0), scale) < apart) return true;
    }
    return false;
}

std::vector<periodic_orbit> start_orbits(const branch_family& family, double variable,
                                         const std::vector<sampled_column>& columns,
                                         int most_period, int settling) {
    const branch_equation equation(family, 1);
    std::vector<sampled_column> sampled = columns;
    for (std::size_t c = 0; c < sampled.size(); ++c) {  // conserved ones keep their value
        const bool is_unknown = std::find(family.columns.begin(), family.columns.end(),
                                          static_cast<int>(c)) != family.columns.end();
        if (!is_unknown) sampled[c] = {family.state[c], family.state[c], 1};
    }
    if (family.variable.is_column)
        sampled[static_cast<std::size_t>(family.variable.index)] = {variable, variable, 1};
    const std::vector<double> starts = grid_of_starts(sampled);
    const map_point map =
        equation.map_at(equation.unknowns_of(std::span(starts).first(sampled.size()), variable));
    settled_orbits settled;
    if (settling > 0) {
        settled = settle(map, map.section, starts, static_cast<std::uint32_t>(settling));
    }
    const std::size_t n = sampled.size();
    std::vector<periodic_orbit> orbits;
    for (int period = 1; period <= most_period; ++period) {
        for (std::size_t i = 0; i < starts.size() / n; ++i) {
            add_new(orbits, family, map, std::span(starts).subspan(i * n, n), period);
            if (settling > 0 && settled.end_of(i) == outcome::ok)
                add_new(orbits, family, map, settled.state_of(i), period);
        }
    }
    return orbits;
}

}  // namespace hopscotch
