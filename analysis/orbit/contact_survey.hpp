// What one orbit meets at its contact: how near its bodies come without touching, how far apart,
// and how hard they hit. A Watch on the orbit in double; included only by generated units.
#pragma once

#include "analysis/orbit/orbit_functions.hpp"
#include "analysis/orbit/turning_points.hpp"
#include "kernels/contract/model.hpp"

#include <cmath>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// Collects over phases and events. Gaps within 1e-13 of a phase's largest, or within the rounding
/// of the state they come from, are contact.
template <class Model>
class contact_survey {
public:
    static constexpr bool is_active = true;

    contact_survey(const double* parameters, const int* options)
        : parameters_(parameters), options_(options) {}

    template <class Sampler>
    void phase(const char* mode, double, double duration, const Sampler& sample) {
        if constexpr (has_gap<Model>) {
            if (Model::contact.mode != mode || !(duration > 0.0) || !std::isfinite(duration)) {
                sign_ = 0;
                return;
            }
            const std::function<contact_gap(double)> gap = [&](double t) {
                double columns[most_columns];
                sample(t, columns);
                return Model::gap(columns, parameters_, options_);
            };
            const phase_course course =
                turning_points(gap, duration, rounding_of(gap, sample, duration));
            if (sign_ * course.first_sign < 0) book(gap(0.0).value, sign_ > 0);
            for (const turning_point& each : course.turning_points) {
                book(each.gap, each.is_maximum);
            }
            sign_ = course.last_sign;
        }
    }

    void event(const char* name, double, const char* mode_left, const char*, const double* before,
               const double* after, double) {
        if (Model::contact.event != name || Model::contact.mode != mode_left) return;
        sign_ = 0;
        const double speed = impact_speed_of<Model>(before, after, parameters_, options_);
        found.impact_speed = std::fmax(found.impact_speed, speed);
    }

    orbit_survey found;

private:
    template <class Sampler>
    static double rounding_of(const std::function<contact_gap(double)>& gap, const Sampler& sample,
                              double duration) {
        constexpr int n_samples = 8;
        double largest = 0.0;
        double reach = 0.0;
        for (int i = 0; i <= n_samples; ++i) {
            const double t = duration * i / n_samples;
            double columns[most_columns] = {};
            sample(t, columns);
            for (std::size_t c = 0; c < Model::info.trace_columns.size(); ++c) {
                reach = std::fmax(reach, std::fabs(columns[c]));
            }
            largest = std::fmax(largest, std::fabs(gap(t).value));
        }
        return std::fmax(1e-13 * largest, 0x1p-50 * reach);
    }

    void book(double gap, bool is_maximum) {
        double& smallest = is_maximum ? found.hop_height : found.clearance;
        smallest = std::fmin(smallest, gap);
    }

    const double* parameters_;
    const int* options_;
    int sign_ = 0;  // of the gap's rate at the end of the phase before; 0 after a contact
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
