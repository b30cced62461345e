// The clock-driven hopper's return map by name, in scaled units: settled orbits, their periods and
// exponents, and what an orbit does. What the tests of its regimes share.
#pragma once

#include "tests/models/every_model.hpp"
#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace hopscotch::testing_models::openloop_map {

constexpr double w = 30.0;

constexpr double zeta = 0.2;

inline named_map hopper(double thrust, double on, double period, double height = 0.0,
                        double velocity = 0.0) {
    return {"openloop_hopper",
            "strobe",
            {{"natural_frequency", w},
             {"damping_ratio", zeta},
             {"thrust", thrust},
             {"thrust_time", on},
             {"stride_period", period},
             {"height", height / (w * w)},
             {"velocity", velocity / w}}};
}

inline named_map long_thrust(double period, double height = 0.0, double velocity = 0.0) {
    return hopper(1.55, 0.08, period, height, velocity);
}

inline named_map short_thrust(double period, double height = 0.0, double velocity = 0.0) {
    return hopper(3.8, 0.02, period, height, velocity);
}

inline double velocity_of(const named_map& m) { return m.start[1] * w; }

/// What an orbit does: event times and letters, stance time, take-off speeds.
struct recorder final : orbit_observer {
    std::string word;
    std::vector<double> times;
    std::vector<std::array<double, 2>> states;  // before the event
    double stance = 0.0;
    void phase(const char* mode, double, double duration, const sampler&) override {
        if (std::string_view(mode) != "air") stance += duration;
    }
    void event(const char* name, double time, const char*, const char*, const double* before,
               const double*, double) override {
        const std::string_view what(name);
        word += what == "take-off"    ? 'T'
                : what == "landing"   ? 'L'
                : what == "thrust on" ? '+'
                                      : '-';
        times.push_back(time);
        states.push_back({before[0], before[1]});
    }
    /// The first event of that letter.
    std::size_t first(char letter) const { return word.find(letter); }
};

inline recorder watch(const named_map& m, std::uint32_t returns = 1) {
    recorder seen;
    m.trace(seen, returns);
    return seen;
}

/// Least number of periods, up to 32, after which the point comes back; 0 where none.
inline int period_of(const named_map& m) {
    named_map there = m;
    for (int n = 1; n <= 32; ++n) {
        there = there.after(1);
        if ((there.point() - m.point()).norm() * w * w < 1e-6) return n;
    }
    return 0;
}

/// Largest exponent in 1/s over some periods, and the sum of both (by QR).
struct exponents {
    double largest, sum;
};

inline exponents lyapunov(named_map m, int periods) {
    Eigen::Matrix2d frame = Eigen::Matrix2d::Identity();
    const Eigen::Vector2d scale(w * w, w);  // (y, v) in scaled units
    double sums[2] = {};
    for (int i = 0; i < periods; ++i) {
        const map_image f = m.image();
        frame = scale.asDiagonal() * f.jacobian * scale.cwiseInverse().asDiagonal() * frame;
        const double first = frame.col(0).norm();
        frame.col(0) /= first;
        frame.col(1) -= frame.col(0).dot(frame.col(1)) * frame.col(0);
        const double second = frame.col(1).norm();
        frame.col(1) /= second;
        sums[0] += std::log(first);
        sums[1] += std::log(second);
        m.start = f.state;
    }
    const double time = periods * m.value("stride_period");
    return {sums[0] / time, (sums[0] + sums[1]) / time};
}

}  // namespace hopscotch::testing_models::openloop_map
