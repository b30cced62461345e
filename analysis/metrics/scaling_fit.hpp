// Exponents of power laws f(s) ~ s^a measured on one map, with errors that admit how little is
// known: deviation from the law, and differences between the map's parts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hopscotch::metrics {

/// Hits and trials of one part of the map at one scale.
struct hit_count {
    std::uint64_t hits = 0;
    std::uint64_t trials = 0;
};

struct power_law {
    bool is_defined = false;
    std::string why;  // where it is not
    double exponent = 0.0;
    double fit_error = 0.0;         // from the residuals of the straight line in log f over log s
    double sampling_error = 0.0;    // jackknife over parts; NaN where some part holds every hit
    std::vector<double> scales;     // in cells
    std::vector<double> fractions;  // f at these scales

    /// Both errors in quadrature; only the fit's where the other one is unknown.
    double error() const;

    /// The points lie on a line well enough for its slope to mean something: to 0.1 in the
    /// exponent.
    bool is_clear() const { return is_defined && fit_error < 0.1; }
};

/// Least squares through (log s, log f), f = hits / trials summed over all parts. The fit's error
/// is that of as many independent points as the scales span octaves, with Student's factor:
/// boundaries built by repetition oscillate around their power law; at least half the difference
/// between the slopes of the smaller and of the larger scales, so that a curve that is no power law
/// (basins narrower than the larger scales) says so. The jackknife leaves out one part of the map
/// at a time: the counts at different scales come from the same cells, so that errors of single
/// points would not be independent.
///
/// \param parts  [part][scale]
/// \return       undefined below three scales or where a scale has no hit
power_law fit_power_law(const std::vector<double>& scales,
                        const std::vector<std::vector<hit_count>>& parts);

/// An exponent for all boundaries together, and one for the boundary of each class with the union
/// of the others.
struct scaling_by_class {
    power_law whole;
    std::vector<power_law> classes;
};

/// Mean of value / weight sums over parts and its jackknife error (NaN below two parts with
/// weight).
struct ratio_estimate {
    double ratio = 0.0;
    double error = 0.0;
};
ratio_estimate ratio_over_parts(const std::vector<double>& values,
                                const std::vector<double>& weights);

}  // namespace hopscotch::metrics
