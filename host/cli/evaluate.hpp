// Batches of rows through the return map: in double by the ensemble kernels, row by row in higher
// precision or with derivatives. Gives the lines of the output file.
#pragma once

#include "host/cli/row_source.hpp"
#include "host/run/truth_orbits.hpp"
#include "host/scene/scene.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace hopscotch {

struct evaluation {
    std::uint32_t returns = 1;
    double max_events = 1e5;  // steps of work per return
    double tolerance = standard_tolerance;
    hopscotch::precision precision = precision::binary64;
    bool has_derivative = false;
    std::string backend = "auto";
    int n_threads = 0;
};

/// `row,outcome,returns,events,time,` state columns, extras and derivatives.
std::string output_header(const row_source& rows, const evaluation& what);

/// One line per row, in order. \error scene_error for the first bad row, device_error
std::vector<std::string> evaluate(const row_source& rows, const evaluation& what);

/// 17 significant digits; nothing for NaN.
std::string number_text(double x);

}  // namespace hopscotch
