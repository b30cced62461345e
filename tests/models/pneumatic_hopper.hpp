// Raibert's pneumatic hopper as a test sets it up: hops and where they settle.
#pragma once

#include "kernels/models/raibert_pneumatic.hpp"
#include "tests/models/orbit_runner.hpp"

#include <gtest/gtest.h>

#include <string>

namespace hopscotch::testing_models::pneumatic_hopper {

using names = std::vector<std::pair<std::string, std::string>>;

inline names with(names base, const names& more) {
    base.insert(base.end(), more.begin(), more.end());
    return base;
}

inline orbit_answer hop(const std::string& section, const std::string& start, const names& set,
                        std::uint32_t returns = 1, arithmetic kind = arithmetic::plain,
                        bool derivative = false) {
    return run_row<raibert_pneumatic>({section, {start}, set, {}, returns, derivative}, kind);
}

}  // namespace hopscotch::testing_models::pneumatic_hopper
