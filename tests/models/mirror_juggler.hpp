// What the tests of the planar and of the spatial mirror-law juggler share: a row set up from
// texts, and first contacts against a dense scan of the gap between ball and bar.
#pragma once

#include "analysis/orbit/orbit_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace hopscotch::testing_models::mirror_juggler {

/// Denormal numbers included, which std::stod refuses.
inline double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

using runner = orbit_answer (*)(const orbit_row&);

enum law { original, solvable, level };

/// Calls with a row of decimals.
template <class Call>
auto with_texts(int law, int energy, const std::vector<std::string>& columns,
                const std::vector<std::string>& parameters, std::uint32_t returns, bool derivative,
                const Call& call) {
    const int options[] = {law, energy};
    orbit_row row;
    row.options = options;
    row.variant = law;
    row.columns = columns;
    row.parameters = parameters;
    row.returns = returns;
    row.derivative = derivative;
    return call(row);
}

/// When the ball leaves the bar's reach: it has fallen to the floor, or is over the shoulder
/// (infinity: never).
struct reach {
    double fall, pass;
};

/// First time before its end at which the gap is closed, by 20000 samples and bisection.
template <class Gap>
std::optional<double> scanned_contact(const Gap& gap, const reach& within) {
    const double end = std::fmin(within.fall, within.pass);
    const int n = 20000;
    for (int k = 1; k <= n; ++k) {
        if (gap(end * k / n) > 0) continue;
        double low = end * (k - 1) / n, high = end * k / n;
        for (int b = 0; b < 50; ++b) {
            (gap((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
        }
        return high;
    }
    return std::nullopt;
}

/// How many orbits the scan and the map agreed on.
struct tally {
    int contacts = 0, misses = 0;

    /// The map's first contact (its extra `flight_time`) is the scan's, and where the scan sees
    /// none the ball falls or passes the shoulder.
    template <class Gap>
    void compare(const orbit_answer& answer, const Gap& gap, const reach& within) {
        const std::optional<double> contact = scanned_contact(gap, within);
        if (!contact) {
            ++misses;
            EXPECT_EQ(answer.end,
                      within.pass <= within.fall ? outcome::over_shoulder : outcome::fell);
        } else if (answer.end == outcome::ok || answer.end == outcome::downward) {
            ++contacts;
            EXPECT_NEAR(number(answer.extras[0]), *contact, 1e-10);
        } else {
            EXPECT_NE(answer.end, outcome::fell);
        }
    }
};

}  // namespace hopscotch::testing_models::mirror_juggler
