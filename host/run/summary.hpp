// What a run says at its end: as text for the user, as JSON beside the map for scripts.
#pragma once

#include "host/run/estimate.hpp"
#include "host/run/run_report.hpp"

#include <string>

namespace hopscotch {

std::string text_of(const scene& scene, const run_report& report);
std::string json_of(const scene& scene, const run_report& report);
std::string text_of(const scene& scene, const run_estimate& estimate);

/// "1.50 GiB", "12 bytes".
std::string bytes_text(std::uint64_t bytes);

}  // namespace hopscotch
