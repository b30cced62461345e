// The planar mirror-law juggler with the solvable law (15), from apex to apex. Its flights are
// parabolas, which a solver of order five integrates exactly: the yardstick's cost is its event
// location. Source: models/mirror_juggler.md section 4; Rizzi and Koditschek 1994.
#include "bench/yardstick_solvers.hpp"

#include <cmath>

namespace hopscotch::bench {
namespace {

struct mirror_planar_system {
    using state = std::array<double, 4>;  // x, z, vx, vz
    static constexpr int n_guards = 1;
    static constexpr double time_scale = 0.05;

    explicit mirror_planar_system(const double* p)
        : restitution(p[0]),
          gravity(p[1]),
          gain_offset(p[2]),
          energy_gain(p[3]),
          target_x(p[4]),
          target_height(p[5]),
          position_gain(p[6]),
          velocity_gain(p[7]),
          shoulder_radius(p[8]),
          bar_length(p[9]),
          floor_height(p[10]) {}

    next_phase start(const double* columns, state& y) {
        y = {columns[0], columns[1], columns[2], 0.0};
        gain = gain_offset + energy_gain * gravity * (target_height - columns[1]);
        const double regulation =
            position_gain * (columns[0] - target_x) + velocity_gain * columns[2];
        angle = std::atan2(regulation, columns[0]);
        descends = true;
        const bool above = std::atan2(y[1], y[0]) > angle;
        return columns[0] > shoulder_radius && above && gain > -1.0 ? next_phase::goes_on
                                                                    : next_phase::ended;
    }
    void rates(double, const double* y, double* rate) const {
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = 0.0;
        rate[3] = -gravity;
    }
    void guards(double, const double* y, double* value) const {
        // the bar mirrors the ball's angle about that of contact
        value[0] = descends ? (1.0 + gain) * (std::atan2(y[1], y[0]) - angle) : y[3];
    }
    bool starts_above(int) const { return true; }
    double stop_time() const { return unbounded_time; }
    next_phase event(int, double, state& y) {
        if (!descends) {
            return y[0] > shoulder_radius ? next_phase::returned : next_phase::ended;
        }
        descends = false;
        const double reach = std::hypot(y[0], y[1]);
        // x and z fall or rise all the way to the contact
        if (y[0] <= shoulder_radius || y[1] < floor_height || reach > bar_length) {
            return next_phase::ended;
        }
        const double turning = (y[0] * y[3] - y[1] * y[2]) / reach;
        const double push = (1.0 + restitution) * (1.0 + gain) * turning;
        y[2] += push * std::sin(angle);
        y[3] -= push * std::cos(angle);
        return y[3] > 0.0 ? next_phase::goes_on : next_phase::ended;
    }
    void result(const state& y, double* columns) const {
        for (int c = 0; c < 3; ++c) columns[c] = y[static_cast<std::size_t>(c)];
    }

    double restitution, gravity, gain_offset, energy_gain, target_x, target_height, position_gain,
        velocity_gain, shoulder_radius, bar_length, floor_height;
    double gain = 0.0, angle = 0.0;
    bool descends = true;
};

const bool known =
    compare_with<mirror_planar_system>({.name = "mirror_planar, solvable law",
                                        .model = "mirror_planar",
                                        .section = "apex",
                                        .options = {{"law", "solvable"}},
                                        .starts = {{0.35, 0.65}, {0.35, 0.65}, {-0.3, 0.3}}});

}  // namespace
}  // namespace hopscotch::bench
