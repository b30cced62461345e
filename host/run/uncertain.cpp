// Moves the starts of a request, runs it again, compares.
#include "host/run/uncertain.hpp"

#include "host/run/requests.hpp"
#include "host/scene/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hopscotch {
namespace {

/// What orbits are compared by.
struct answers {
    explicit answers(std::uint64_t n) : label(n), outcome(n), returns(n), events(n), motion(n) {}

    void bind(ensemble_request& request, const scene& scene) {
        if (scene.question.has_labels) request.label = label.data();
        request.outcome = outcome.data();
        request.returns = returns.data();
        if (is_chaos_map(scene)) {
            request.exponents.motion = motion.data();
        } else {
            request.events = events.data();
        }
    }

    std::vector<std::int16_t> label;
    std::vector<std::uint8_t> outcome;
    std::vector<std::uint32_t> returns;
    std::vector<std::uint32_t> events;
    std::vector<std::uint8_t> motion;
};

/// The same cells, no results wanted.
ensemble_request without_results(ensemble_request request) {
    request.label = nullptr;
    request.outcome = nullptr;
    request.returns = request.events = nullptr;
    request.time = nullptr;
    std::fill(std::begin(request.state), std::end(request.state), nullptr);
    std::fill(std::begin(request.extras), std::end(request.extras), nullptr);
    exponent_request& exponents = request.exponents;
    std::fill(std::begin(exponents.exponents), std::end(exponents.exponents), nullptr);
    exponents.rate = exponents.standard_error = nullptr;
    exponents.returns = nullptr;
    exponents.motion = nullptr;
    return request;
}

/// x moved, or x where that would leave what is admissible. Zeros, infinities and numbers that the
/// model derives (NaN) stay: they switch terms off.
double moved(double x, double by, const range& valid) {
    const double y = x + by;
    return std::isfinite(x) && valid.holds(y) ? y : x;
}

/// A request whose starts are moved in one way, with the tables that it points to.
class moved_request {
public:
    moved_request(const scene& scene, const ensemble_request& from, double tolerance)
        : scene_(scene), request_(without_results(from)), tolerance_(tolerance) {}

    ensemble_request& request() { return request_; }

    void move_axis(const scene_axis& axis, double sign) {
        const auto index = static_cast<std::size_t>(axis.index);
        const bool is_column = axis.kind == axis_kind::column;
        const range& valid = is_column ? scene_.start_section().columns[index].valid
                                       : scene_.info().parameters[index].valid;
        const double scale = axis.scale == axis_scale::log
                                 ? 0.0
                                 : std::max(std::abs(axis.lowest), std::abs(axis.highest));
        move(is_column ? request_.columns[index] : request_.parameters[index], scale, sign, valid);
    }

    /// All numbers that are no axes, with alternating signs.
    void move_fixed(double sign) {
        for (std::size_t c = 0; c < scene_.start.size(); ++c, sign = -sign) {
            if (is_axis(axis_kind::column, c)) continue;
            move_constant(request_.columns[c], sign, scene_.start_section().columns[c].valid);
        }
        for (std::size_t p = 0; p < scene_.parameters.size(); ++p, sign = -sign) {
            if (is_axis(axis_kind::parameter, p)) continue;
            move_constant(request_.parameters[p], sign, scene_.info().parameters[p].valid);
        }
    }

private:
    bool is_axis(axis_kind kind, std::size_t index) const {
        return std::any_of(scene_.axes.begin(), scene_.axes.end(), [&](const scene_axis& axis) {
            return axis.kind == kind && static_cast<std::size_t>(axis.index) == index;
        });
    }

    void move_constant(column_source& source, double sign, const range& valid) {
        if (source.values[0] == 0.0) return;
        move(source, 0.0, sign, valid);
    }

    void move(column_source& source, double scale, double sign, const range& valid) {
        std::vector<double>& table = tables_.emplace_back(source.size);
        for (std::uint64_t i = 0; i < source.size; ++i) {
            const double x = source.values[i];
            table[i] = moved(x, sign * displacement_of(x, scale, tolerance_), valid);
        }
        source.values = table.data();
    }

    const scene& scene_;
    ensemble_request request_;
    double tolerance_;
    std::vector<std::vector<double>> tables_;
};

/// Compares two runs of the same cells.
class comparison {
public:
    comparison(const scene& scene, const ensemble_request& first)
        : scene_(scene), first_(first), flags_(first.n_cells) {
        constexpr auto changes = static_cast<std::uint8_t>(certainty::answer_changes);
        for (std::uint64_t cell = 0; cell < first.n_cells; ++cell) {
            if (is_undecidable(static_cast<outcome>(first.outcome[cell]))) flags_[cell] = changes;
        }
    }

    void compare(const ensemble_request& second) {
        for (std::uint64_t cell = 0; cell < first_.n_cells; ++cell) {
            if (has_other_answer(second, cell)) {
                flags_[cell] = static_cast<std::uint8_t>(certainty::answer_changes);
            } else if (flags_[cell] == 0 && has_other_events(second, cell)) {
                flags_[cell] = static_cast<std::uint8_t>(certainty::events_change);
            }
        }
    }

    std::vector<std::uint8_t> flags() && { return std::move(flags_); }

private:
    static bool is_undecidable(outcome end) {
        return end == outcome::unresolved_event || end == outcome::not_finite;
    }

    bool has_other_answer(const ensemble_request& second, std::uint64_t cell) const {
        if (first_.outcome[cell] != second.outcome[cell]) return true;
        if (is_chaos_map(scene_)) {
            return first_.exponents.motion[cell] != second.exponents.motion[cell];
        }
        if (scene_.question.has_labels) return first_.label[cell] != second.label[cell];
        return scene_.question.kind == "steps_to_fall" &&
               first_.returns[cell] != second.returns[cell];
    }

    /// In a fractal basin all moved starts may happen to end alike; their numbers of returns and
    /// events give them away.
    bool has_other_events(const ensemble_request& second, std::uint64_t cell) const {
        return !is_chaos_map(scene_) && (first_.returns[cell] != second.returns[cell] ||
                                         first_.events[cell] != second.events[cell]);
    }

    const scene& scene_;
    const ensemble_request& first_;
    std::vector<std::uint8_t> flags_;
};

}  // namespace

double displacement_of(double x, double scale, double tolerance) {
    const double size = std::max(std::abs(x), scale);
    const double ulp = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
    return std::max(16.0 * ulp, 100.0 * tolerance * (0.25 + size));
}

std::vector<std::uint8_t> certainty_of(const scene& scene, const label_plan& plan,
                                       const kernel_run& run, const ensemble_request& results) {
    const bool integrates =
        scene.model->integrates != nullptr && scene.model->integrates(variant_of(scene));
    const double tolerance = integrates ? scene.accuracy.tolerance : 0.0;
    comparison compared(scene, results);
    answers found(results.n_cells);
    const auto look = [&](moved_request& again) {
        found.bind(again.request(), scene);
        run_labelled(scene, plan, run, again.request());
        compared.compare(again.request());
    };
    for (const double sign : {1.0, -1.0}) {
        for (const scene_axis& axis : scene.axes) {
            moved_request again(scene, results, tolerance);
            again.move_axis(axis, sign);
            look(again);
        }
        moved_request again(scene, results, tolerance);
        again.move_fixed(sign);
        look(again);
    }
    return std::move(compared).flags();
}

std::vector<std::uint8_t> certainty_of(const scene& scene, const label_plan& plan,
                                       const kernel_run& run,
                                       std::span<const std::uint64_t> cells) {
    std::vector<std::uint8_t> flags;
    if (plan.of_cell) {
        for (const std::uint64_t cell : cells) {
            const label_plan own = plan.of_cell(coordinates_of(scene, cell));
            flags.push_back(certainty_of(scene, own, run, std::span(&cell, 1)).front());
        }
        return flags;
    }
    cell_request request = request_of(scene, plan, cells);
    answers first(cells.size());
    first.bind(request.request, scene);
    run_labelled(scene, plan, run, request.request);
    return certainty_of(scene, plan, run, request.request);
}

}  // namespace hopscotch
