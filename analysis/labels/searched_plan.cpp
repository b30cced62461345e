// From the attractors found at every parameter point to one table of labels.
#include "analysis/labels/searched_plan.hpp"

#include "analysis/labels/label_colours.hpp"
#include "analysis/labels/own_labels.hpp"
#include "analysis/labels/point_search.hpp"
#include "host/run/no_ellipsoid.hpp"
#include "host/scene/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace hopscotch {
namespace {

/// What an attractor is called by over all parameter points: its kind, period, and place among
/// those of the same kind and period at its point.
struct attractor_class {
    bool is_late = false;  // found by the second search only
    bool is_chaotic = false;
    int period = 0;
    int index = 0;

    auto rank() const { return std::tuple(is_late, is_chaotic, period, index); }
    bool operator<(const attractor_class& other) const { return rank() < other.rank(); }
};

/// Where one attractor stands in the search.
struct place {
    std::size_t point;
    std::size_t attractor;
};

std::map<std::size_t, std::vector<double>> starts_by_point(const scene& scene,
                                                           const plan_points& points,
                                                           std::span<const std::uint64_t> cells) {
    std::map<std::size_t, std::vector<double>> starts;
    for (const std::uint64_t cell : cells) {
        const std::vector<std::uint64_t> coordinates = coordinates_of(scene, cell);
        const cell_start start = start_of(scene, coordinates);
        auto& at = starts[points.point_of(coordinates)];
        at.insert(at.end(), start.columns.begin(), start.columns.end());
    }
    return starts;
}

/// The classes of a point's attractors, in their order.
std::vector<attractor_class> classes_at(const attractor_search& found) {
    std::vector<attractor_class> classes;
    std::map<std::tuple<bool, bool, int>, int> seen;
    for (const found_attractor& attractor : found.attractors) {
        attractor_class next{attractor.is_late, attractor.kind == attractor_kind::chaotic,
                             attractor.period, 0};
        next.index = ++seen[{next.is_late, next.is_chaotic, next.period}];
        classes.push_back(next);
    }
    return classes;
}

std::string name_of(const attractor_class& of, bool is_only) {
    std::string name = of.is_chaotic    ? "chaotic"
                       : of.period == 1 ? "fixed point"
                                        : fmt::format("period {}", of.period);
    if (is_only && !of.is_late) return name;
    const int index = of.index;
    if (of.is_late) return fmt::format("{} (late {})", name, index);
    return of.period == 1 ? fmt::format("{} {}", name, index) : fmt::format("{} ({})", name, index);
}

std::string trap_text(const found_attractor& found, std::size_t point, bool has_points) {
    std::string text;
    if (found.kind == attractor_kind::chaotic) {
        text = fmt::format("boxes over sampled states; exponent {:.6g} +- {:.2g} per return",
                           found.exponent, found.exponent_error);
    } else if (found.traps.empty()) {
        text = "none: too weakly attracting";
    } else {
        text =
            fmt::format("{} ellipsoid{}, contraction {}", found.traps.size(),
                        found.traps.size() == 1 ? "" : "s",
                        found.is_proved ? "proved by enclosures" : "checked by exact derivatives");
    }
    return has_points ? fmt::format("{}; at parameter point {}", text, point) : text;
}

void set_multipliers(attractor_row& row, std::span<const std::complex<double>> multipliers) {
    for (const std::complex<double>& multiplier : multipliers) {
        row.multipliers_real.push_back(multiplier.real());
        row.multipliers_imaginary.push_back(multiplier.imag());
    }
}

/// A chaotic set has its largest exponent in the place of multipliers.
attractor_row row_of(const found_attractor& found) {
    attractor_row row;
    row.period = found.period;
    row.points = found.points;
    set_multipliers(row, found.multipliers);
    if (found.kind == attractor_kind::chaotic) {
        row.multipliers_real = {found.exponent};
        row.multipliers_imaginary = {0.0};
    }
    return row;
}

attractor_row row_of(const periodic_orbit& orbit) {
    attractor_row row;
    row.name = orbit.period == 1 ? "fixed point" : fmt::format("period {}", orbit.period);
    row.period = orbit.period;
    row.points = orbit.points;
    set_multipliers(row, orbit.multipliers);
    constexpr double neutral = 1e-6;
    const bool is_neutral =
        !orbit.multipliers.empty() && std::abs(std::abs(orbit.multipliers[0]) - 1.0) < neutral;
    row.trap = is_neutral ? "none: neutral, one of a family of orbits" : "none: unstable";
    return row;
}

class label_table {
public:
    label_table(const found_everywhere& found, label_plan& plan) : found_(found), plan_(plan) {
        for (std::size_t point = 0; point < found.at.size(); ++point) {
            classes_.push_back(classes_at(found.at[point]));
            for (std::size_t i = 0; i < classes_[point].size(); ++i) {
                examples_.try_emplace(classes_[point][i], place{point, i});
            }
        }
        int label = plan.attractors.empty() ? 0 : plan.attractors.back().label;
        for (const auto& [of, example] : examples_) labels_[of] = ++label;
    }

    void fill() {
        add_rows();
        std::size_t most = 0;
        for (const attractor_search& at : found_.at) most = std::max(most, n_traps(at));
        plan_.n_ellipsoids = static_cast<int>(most);
        plan_.ellipsoids.assign(most * found_.at.size(), no_ellipsoid());
        for (std::size_t point = 0; point < found_.at.size(); ++point) fill_point(point, most);
    }

private:
    static std::size_t n_traps(const attractor_search& at) {
        std::size_t n = 0;
        for (const found_attractor& attractor : at.attractors) n += attractor.traps.size();
        return n;
    }

    void fill_point(std::size_t point, std::size_t most) {
        std::size_t slot = point * most;
        const auto& attractors = found_.at[point].attractors;
        for (std::size_t i = 0; i < attractors.size(); ++i) {
            const int label = labels_.at(classes_[point][i]);
            for (trap_ellipsoid trap : attractors[i].traps) {
                trap.label = label;
                plan_.ellipsoids[slot++] = trap;
            }
            if (attractors[i].kind != attractor_kind::chaotic) continue;
            plan_.chaotic.push_back({point, static_cast<std::int16_t>(label), attractors[i].cover});
        }
    }

    void add_rows() {
        std::map<std::tuple<bool, int>, int> n_alike;
        for (const auto& [of, example] : examples_) ++n_alike[{of.is_chaotic, of.period}];
        for (const auto& [of, example] : examples_) {
            const found_attractor& found = found_.at[example.point].attractors[example.attractor];
            attractor_row row = row_of(found);
            row.label = labels_.at(of);
            row.name = name_of(of, n_alike[{of.is_chaotic, of.period}] == 1);
            row.trap = trap_text(found, example.point, found_.at.size() > 1);
            plan_.attractors.push_back(std::move(row));
        }
        int next = 1;  // the first colour, grey, is for the resting state
        for (attractor_row& row : plan_.attractors) {
            const bool is_rest = row.label == plan_.died_label;
            row.colour = colour_of(is_rest ? 1 : ++next);
        }
    }

    const found_everywhere& found_;
    label_plan& plan_;
    std::vector<std::vector<attractor_class>> classes_;  // [point][attractor]
    std::map<attractor_class, place> examples_;
    std::map<attractor_class, int> labels_;
};

}  // namespace

found_everywhere search_everywhere(const scene& scene, std::span<const std::uint64_t> searched) {
    found_everywhere found{plan_points(scene, axes_of_points(scene)), {}};
    const plan_points& points = found.points;
    found.at.resize(points.size());
    const search_limits limits = limits_of(scene, points.size());
    const std::size_t n_samples = samples_of(scene, points.size());
    const auto again = starts_by_point(scene, points, searched);
#pragma omp parallel for schedule(dynamic)
    for (std::size_t point = 0; point < points.size(); ++point) {
        found.at[point] =
            search_point(scene, points, point, points.starts_at(point, n_samples), limits);
        const auto more = again.find(point);
        if (more == again.end()) continue;
        search_limits thorough = limits;
        thorough.returns *= 4;
        thorough.longest_period *= 4;
        found.at[point] = search_point(scene, points, point, more->second, thorough,
                                       std::move(found.at[point].attractors));
    }
    return found;
}

label_plan plan_by_search(const scene& scene, std::span<const std::uint64_t> searched) {
    const found_everywhere found = search_everywhere(scene, searched);
    label_plan plan;
    plan.decided_by = decision::ellipsoids;
    plan.point_axes = found.points.axes();
    plan.searched.assign(searched.begin(), searched.end());
    for (const column_info& column : scene.end_section().columns) {
        plan.point_columns.emplace_back(column.name);
    }
    add_own_labels(scene, plan);
    label_table(found, plan).fill();
    if (found.at.size() == 1) {
        for (const periodic_orbit& orbit : found.at[0].unstable) {
            plan.unstable.push_back(row_of(orbit));
        }
    }
    return plan;
}

}  // namespace hopscotch
