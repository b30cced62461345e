// Many orbits of one return map at once, through the kernels: where samples of starts settle. The
// bits are those of the map that is computed later.
#pragma once

#include "analysis/periodic/map_point.hpp"
#include "kernels/ensemble/request.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hopscotch {

/// Where orbits have ended, start by start.
struct settled_orbits {
    int n_columns = 0;          // of the section the returns end on
    std::vector<double> state;  // [start][column], the last section state reached
    std::vector<std::uint8_t> end;
    std::vector<std::int16_t> label;
    std::vector<std::uint32_t> returns;

    std::size_t size() const { return end.size(); }
    outcome end_of(std::size_t i) const { return static_cast<outcome>(end[i]); }
    std::span<const double> state_of(std::size_t i) const {
        const auto n = static_cast<std::size_t>(n_columns);
        return std::span(state).subspan(i * n, n);
    }
};

/// Runs every start for `returns` returns, or until a trap or the model's own certificate labels
/// it.
///
/// \param section  where the starts lie; [start][column] over its columns
/// \param traps    none: orbits run for all returns (outcome `ok`) unless they end by themselves
/// \param died_label  of orbits that end stuck or at rest
settled_orbits settle(const map_point& map, int section, std::span<const double> starts,
                      std::uint32_t returns, decision decided_by = decision::returns,
                      std::span<const trap_ellipsoid> traps = {}, std::int16_t died_label = 0);

}  // namespace hopscotch
