// The clock-driven hopper in scaled units: one stride with its Jacobian, periodic points, branches
// and what an orbit does. What the tests of its page (models/openloop_hopper.md) share.
#pragma once

#include "tests/models/model_orbits.hpp"
#include "kernels/models/openloop_hopper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace hopscotch::testing_models::openloop_machine {

using orbit = orbit_answer;

struct machine {
    double w = 30.0, zeta = 0.2, thrust = 1.55, on = 0.08, period = 0.26;
    int guard = 0;

    std::vector<std::string> texts() const {
        return {print_real(w), print_real(zeta), print_real(thrust), print_real(on),
                print_real(period)};
    }
    int variant() const { return 2 * guard + (zeta < 1.0 ? 0 : 1); }
};

inline machine long_thrust(double period = 0.26) { return {.period = period}; }

inline machine short_thrust(double period = 0.15) {
    return {.thrust = 3.8, .on = 0.02, .period = period};
}

using runner = orbit_answer (*)(const orbit_row&);

inline const orbit_functions& table() { return testing_models::orbits_of<openloop_hopper>(); }

/// Calls call(row) with the orbit of a machine from a start.
template <class Call>
auto with_row(const machine& m, int section, const std::vector<std::string>& columns,
              std::uint32_t returns, const Call& call) {
    const std::vector<std::string> parameters = m.texts();
    const int options[] = {m.guard};
    orbit_row row;
    row.section = section;
    row.options = options;
    row.variant = m.variant();
    row.columns = columns;
    row.parameters = parameters;
    row.returns = returns;
    return call(row);
}

inline orbit run_texts(runner run, const machine& m, int section,
                       const std::vector<std::string>& columns, std::uint32_t returns,
                       bool derivative = false) {
    return with_row(m, section, columns, returns, [&](orbit_row& row) {
        row.derivative = derivative;
        return run(row);
    });
}

inline orbit run(const machine& m, int section, double first, double second,
                 std::uint32_t returns = 1, bool derivative = false,
                 runner how = table().run_double) {
    return run_texts(how, m, section, {print_real(first), print_real(second)}, returns, derivative);
}

/// A stroboscopic state in scaled units, and its return with the Jacobian.
struct point {
    double height, velocity;
};

struct image {
    point to;
    double j[4];
    outcome end;
    double trace() const { return j[0] + j[3]; }
    double det() const { return j[0] * j[3] - j[1] * j[2]; }
    double fold() const { return 1.0 - trace() + det(); }
    double flip() const { return 1.0 + trace() + det(); }
    double larger() const {  // of two real multipliers, the one of larger modulus
        const double root = std::sqrt(trace() * trace() / 4 - det());
        return trace() / 2 + (trace() < 0 ? -root : root);
    }
};

inline image map(const machine& m, point from, std::uint32_t returns = 1) {
    const double w = m.w;
    const orbit a = run(m, 0, from.height / (w * w), from.velocity / w, returns, true);
    image result{{std::stod(a.columns[0]) * w * w, std::stod(a.columns[1]) * w}, {}, a.end};
    const double scale[] = {1.0, w, 1.0 / w, 1.0};
    for (std::size_t i = 0; i < 4; ++i) result.j[i] = std::stod(a.derivative[i]) * scale[i];
    return result;
}

/// Newton's method for a periodic point.
inline point periodic_point(const machine& m, point x, std::uint32_t returns = 1) {
    for (int i = 0; i < 30; ++i) {
        const image f = map(m, x, returns);
        const double a = f.j[0] - 1, d = f.j[3] - 1, det = a * d - f.j[1] * f.j[2];
        const double r = f.to.height - x.height, s = f.to.velocity - x.velocity;
        const double dh = -(d * r - f.j[1] * s) / det, dv = -(a * s - f.j[2] * r) / det;
        x = {x.height + dh, x.velocity + dv};
        if (std::abs(dh) + std::abs(dv) < 1e-13) break;
    }
    return x;
}

struct seen_event {
    std::string name;
    double time;
    double before[4];
};

struct recorder final : orbit_observer {
    std::vector<seen_event> events;
    double stance = 0.0;
    double lowest_force = 0.0;
    double velocity_squared = 0.0;  // integral over stance
    void phase(const char* mode, double, double duration, const sampler& at) override {
        if (std::string(mode) == "air") return;
        stance += duration;
        double c[4];
        const int n = 200;
        for (int i = 0; i <= n; ++i) {  // Simpson's rule
            at.state_at(duration * i / n, c);
            lowest_force = std::min(lowest_force, c[3]);
            const double weight = i == 0 || i == n ? 1 : i % 2 ? 4 : 2;
            velocity_squared += weight * c[1] * c[1] * duration / n / 3;
        }
    }
    void event(const char* name, double time, const char*, const char*, const double* before,
               const double*, double) override {
        events.push_back({name, time, {before[0], before[1], before[2], before[3]}});
    }
    std::string word() const {
        std::string letters;
        for (const auto& e : events) {
            letters += e.name == "take-off"    ? 'T'
                       : e.name == "landing"   ? 'L'
                       : e.name == "thrust on" ? '+'
                                               : '-';
        }
        return letters;
    }
    double take_off_speed() const {
        double fastest = 0.0;
        for (const auto& e : events) {
            if (e.name == "take-off") fastest = std::max(fastest, e.before[1]);
        }
        return fastest;
    }
};

inline recorder watch(const machine& m, double y, double v, std::uint32_t returns = 1,
                      int section = 0) {
    recorder seen;
    with_row(m, section, {print_real(y), print_real(v)}, returns,
             [&](const orbit_row& row) { table().trace(row, seen); });
    return seen;
}

inline recorder watch(const machine& m, point x) {
    return watch(m, x.height / (m.w * m.w), x.velocity / m.w);
}

inline double column(const orbit& a, std::size_t i) { return std::stod(a.columns[i]); }

}  // namespace hopscotch::testing_models::openloop_machine
