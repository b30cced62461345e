// What `hopscotch analyse` says: a table for people, JSON for scripts.
#pragma once

#include "analysis/metrics/analysis.hpp"

#include <string>

namespace hopscotch {

/// Two merged boundaries count as one if they agree within `cells`; a map is large enough for the
/// verdict if its shortest axis has ten times as many.
struct wada_tolerance {
    double cells = 8.0;

    bool is_decidable(const metrics::class_grid& grid) const;
};

std::string analysis_text(const metrics::map_analysis& analysis, wada_tolerance wada);
std::string analysis_json(const metrics::map_analysis& analysis, wada_tolerance wada,
                          const std::string& file);

/// How lengths are measured along an axis: "value (m)" or "ln(value)".
std::string length_text(const axis& along);

}  // namespace hopscotch
