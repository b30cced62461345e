// Finds the attractors of a return map, their number not known in advance: samples of starts
// settle, what they settle on is identified (Newton on P^p for cycles, exponents for chaos), gets
// its traps, and the samples that no trap has caught are looked at again. Source: DESIGN section 5;
// models/openloop_hopper.md, sections 4 to 8.
#pragma once

#include "analysis/attractors/attractor_kind.hpp"
#include "analysis/periodic/periodic_orbit.hpp"
#include "host/run/state_cover.hpp"
#include "kernels/ensemble/request.hpp"

#include <complex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hopscotch {

struct found_attractor {
    attractor_kind kind = attractor_kind::cycle;  // of any period
    int period = 1;                               // 0 where chaotic
    std::vector<double> points;  // [period][column], the smallest first; chaotic: the two corners
    std::vector<std::complex<double>> multipliers;  // of the free columns
    double exponent = 0.0;                          // largest, per return (chaotic only)
    double exponent_error = 0.0;                    // its standard error
    std::vector<trap_ellipsoid> traps;              // one per point of a cycle; labels still 0
    bool is_proved = true;        // the traps, by enclosures; else checked at samples
    state_cover cover;            // chaotic only
    std::vector<double> samples;  // [sample][column], of the chaotic set
    bool is_late = false;         // found by a later search than the others

    /// Canonical order: period, then points; chaotic sets last; late ones after all others.
    bool operator<(const found_attractor& other) const;
};

struct search_limits {
    std::uint32_t transient = 400;  // returns before the first look
    std::uint32_t returns = 4000;   // at most, before an orbit counts as not settling on a cycle
    int longest_period = 64;
    int most_attempts = 64;  // orbits looked at that turn out to be nothing new
    bool wants_unstable = false;
    bool wants_proofs = true;  // of traps, where enclosures can give one
    bool is_quick = false;  // for many points: traps and samples need not be as large as can be
};

struct attractor_search {
    std::vector<found_attractor> attractors;  // canonical order
    std::vector<periodic_orbit> unstable;     // saddles and repellers met on the way
    std::size_t n_starts = 0;
    std::size_t n_open = 0;  // starts that neither ended nor were caught
};

/// Columns that the return map conserves at every state given whose return is completed: they are
/// parameters of the motion, not attracted to anything. Rising; the complement are the free
/// columns. Nothing where no return is completed.
std::optional<std::vector<int>> conserved_everywhere(const map_point& map,
                                                     std::span<const double> states);

/// \param section  where the starts lie (its returns end on map.section)
/// \param starts   [start][column]
/// \param scale    typical size of every column of map.section, > 0
/// \param known    attractors found before: not looked for again, part of the result
attractor_search search_attractors(const map_point& map, int section,
                                   std::span<const double> starts, std::span<const double> scale,
                                   const search_limits& limits,
                                   std::vector<found_attractor> known = {});

}  // namespace hopscotch
