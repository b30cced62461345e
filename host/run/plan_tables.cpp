// Plans to tables and back.
#include "host/run/plan_tables.hpp"

#include "host/run/plan_digest.hpp"
#include "host/store/store_error.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace hopscotch {
namespace {

constexpr std::size_t most_numbers = std::size_t{1} << 23;
constexpr const char* no_point_axes = "none";

std::uint64_t n_points_of(const scene& scene, const label_plan& plan) {
    std::uint64_t n = 1;
    for (const std::size_t axis : plan.point_axes) n *= scene.axes[axis].cells;
    return n;
}

std::string names_of_axes(const scene& scene, const label_plan& plan) {
    std::vector<std::string> names;
    for (const std::size_t axis : plan.point_axes) names.push_back(scene.axes[axis].name);
    return names.empty() ? no_point_axes : fmt::format("{}", fmt::join(names, " "));
}

/// Adds tables whose dimensions fit together.
class table_writer {
public:
    table_writer(table_group& group, std::uint64_t n_points, std::uint64_t n_columns)
        : group_(group), n_points_(n_points), n_columns_(n_columns) {}

    void add_intervals(const std::string& kind, const std::string& along, int n,
                       const std::vector<trap_interval>& intervals, const std::string& meaning) {
        if (intervals.empty()) return;
        std::vector<double> labels;
        std::vector<double> ends;
        for (const trap_interval& each : intervals) {
            labels.push_back(each.label);
            ends.insert(ends.end(), {each.lowest, each.highest});
        }
        const table_dimension slot{along, static_cast<std::uint64_t>(n)};
        add(kind + "_label", "label of " + meaning, number_type::int32, {point(), slot},
            std::move(labels));
        add(kind + "_ends", "ends of " + meaning, number_type::float64, {point(), slot, {"end", 2}},
            std::move(ends));
    }

    void add_placed(const std::vector<placed_attractor>& placed) {
        if (placed.empty()) return;
        std::vector<double> points;
        std::vector<double> labels;
        std::vector<double> n_points;
        std::vector<double> places;
        for (const placed_attractor& each : placed) {
            points.push_back(static_cast<double>(each.point));
            labels.push_back(each.label);
            n_points.push_back(static_cast<double>(each.points.size() / n_columns_));
            places.insert(places.end(), each.points.begin(), each.points.end());
        }
        if (places.empty()) return;
        const table_dimension orbit{"orbit", placed.size()};
        const std::uint64_t n = places.size() / n_columns_;
        add("placed_point", "parameter point of an orbit", number_type::int32, {orbit},
            std::move(points));
        add("placed_label", "label of the orbit", number_type::int32, {orbit}, std::move(labels));
        add("placed_n_points", "points of the orbit", number_type::int32, {orbit},
            std::move(n_points));
        add("placed_points", "points of the orbits, orbit after orbit", number_type::float64,
            {{"place", n}, column()}, std::move(places));
    }

    void add_ellipsoids(const label_plan& plan) {
        if (plan.ellipsoids.empty()) return;
        std::vector<double> labels;
        std::vector<double> centres;
        std::vector<double> shapes;
        for (const trap_ellipsoid& trap : plan.ellipsoids) {
            labels.push_back(trap.label);
            centres.insert(centres.end(), trap.centre, trap.centre + n_columns_);
            shapes.insert(shapes.end(), trap.shape, trap.shape + n_columns_ * n_columns_);
        }
        const table_dimension slot{"ellipsoid", static_cast<std::uint64_t>(plan.n_ellipsoids)};
        add("ellipsoid_label", "label of a trap ellipsoid", number_type::int32, {point(), slot},
            std::move(labels));
        add("centre", "point of the orbit in the ellipsoid's middle", number_type::float64,
            {point(), slot, column()}, std::move(centres));
        add("shape", "A of the ellipsoid |A (x - centre)| <= 1", number_type::float64,
            {point(), slot, {"row", n_columns_}, column()}, std::move(shapes));
    }

    void add_chaotic(const std::vector<chaotic_set>& sets) {
        if (sets.empty()) return;
        std::vector<double> points;
        std::vector<double> labels;
        std::vector<double> along;
        std::vector<double> n_boxes;
        std::vector<double> lowest;
        std::vector<double> highest;
        std::vector<double> boxes;
        for (const chaotic_set& set : sets) {
            points.push_back(static_cast<double>(set.point));
            labels.push_back(set.label);
            along.push_back(static_cast<double>(set.cover.boxes_along()));
            n_boxes.push_back(static_cast<double>(set.cover.n_boxes()));
            lowest.insert(lowest.end(), set.cover.lowest().begin(), set.cover.lowest().end());
            highest.insert(highest.end(), set.cover.highest().begin(), set.cover.highest().end());
            const std::vector<double> places = set.cover.box_places();
            boxes.insert(boxes.end(), places.begin(), places.end());
        }
        if (boxes.empty()) return;
        const table_dimension set{"set", sets.size()};
        const auto whole = number_type::int32;
        const auto number = number_type::float64;
        add("chaotic_point", "parameter point of a chaotic set", whole, {set}, std::move(points));
        add("chaotic_label", "label of a chaotic set", whole, {set}, std::move(labels));
        add("chaotic_boxes_along", "boxes along every column of its hull", whole, {set},
            std::move(along));
        add("chaotic_n_boxes", "boxes of the set", whole, {set}, std::move(n_boxes));
        add("chaotic_lowest", "lower corner of its hull", number, {set, column()},
            std::move(lowest));
        add("chaotic_highest", "upper corner of its hull", number, {set, column()},
            std::move(highest));
        const std::uint64_t n = boxes.size() / n_columns_;
        add("chaotic_box", "places of the boxes along every column, set after set", whole,
            {{"box", n}, column()}, std::move(boxes));
    }

private:
    table_dimension point() const { return {"point", n_points_}; }
    table_dimension column() const { return {"column", n_columns_}; }

    void add(std::string name, std::string meaning, number_type type,
             std::vector<table_dimension> dimensions, std::vector<double> values) {
        group_.tables.push_back(
            {std::move(name), std::move(meaning), type, std::move(dimensions), std::move(values)});
    }

    table_group& group_;
    std::uint64_t n_points_;
    std::uint64_t n_columns_;
};

[[noreturn]] void misfit(const std::string& what) {
    throw store_error(traps_group, what + " does not fit the map", "a file of another version?");
}

class table_reader_of_plan {
public:
    table_reader_of_plan(const table_group& group, std::uint64_t n_points, std::uint64_t n_columns)
        : group_(group), n_points_(n_points), n_columns_(n_columns) {}

    /// Intervals per point, and all of them.
    std::pair<int, std::vector<trap_interval>> intervals(const std::string& kind) const {
        const number_table* const labels = group_.table(kind + "_label");
        if (labels == nullptr) return {};
        const std::uint64_t n = per_point(*labels);
        const std::vector<double>& ends = values(kind + "_ends", n_points_ * n * 2);
        std::vector<trap_interval> result;
        for (std::size_t i = 0; i < n_points_ * n; ++i) {
            result.push_back({ends[2 * i], ends[2 * i + 1], whole(labels->values[i])});
        }
        return {static_cast<int>(n), std::move(result)};
    }

    void read_placed(label_plan& plan) const {
        const number_table* const labels = group_.table("placed_label");
        if (labels == nullptr) return;
        const std::size_t n = labels->values.size();
        const std::vector<double>& points = values("placed_point", n);
        const std::vector<double>& n_points = values("placed_n_points", n);
        double n_all = 0.0;
        for (const double each : n_points) n_all += each;
        const std::vector<double>& places =
            values("placed_points", static_cast<std::uint64_t>(n_all) * n_columns_);
        auto at = places.begin();
        for (std::size_t i = 0; i < n; ++i) {
            const auto end = at + static_cast<std::ptrdiff_t>(n_points[i]) *
                                      static_cast<std::ptrdiff_t>(n_columns_);
            plan.placed.push_back({static_cast<std::size_t>(points[i]),
                                   static_cast<std::int16_t>(labels->values[i]),
                                   {at, end}});
            at = end;
        }
    }

    void read_ellipsoids(label_plan& plan) const {
        const number_table* const labels = group_.table("ellipsoid_label");
        if (labels == nullptr) return;
        const std::uint64_t n = per_point(*labels);
        const std::vector<double>& centres = values("centre", n_points_ * n * n_columns_);
        const std::vector<double>& shapes =
            values("shape", n_points_ * n * n_columns_ * n_columns_);
        plan.n_ellipsoids = static_cast<int>(n);
        for (std::size_t i = 0; i < n_points_ * n; ++i) {
            trap_ellipsoid trap{};
            trap.label = whole(labels->values[i]);
            trap.n_columns = trap.label == 0 ? 1 : static_cast<std::int32_t>(n_columns_);
            std::copy_n(&centres[i * n_columns_], n_columns_, trap.centre);
            std::copy_n(&shapes[i * n_columns_ * n_columns_], n_columns_ * n_columns_, trap.shape);
            plan.ellipsoids.push_back(trap);
        }
    }

    void read_chaotic(label_plan& plan) const {
        const number_table* const labels = group_.table("chaotic_label");
        if (labels == nullptr) return;
        const std::size_t n = labels->values.size();
        const std::vector<double>& points = values("chaotic_point", n);
        const std::vector<double>& along = values("chaotic_boxes_along", n);
        const std::vector<double>& n_boxes = values("chaotic_n_boxes", n);
        const std::vector<double>& lowest = values("chaotic_lowest", n * n_columns_);
        const std::vector<double>& highest = values("chaotic_highest", n * n_columns_);
        double n_all = 0.0;
        for (const double each : n_boxes) n_all += each;
        const std::vector<double>& boxes =
            values("chaotic_box", static_cast<std::uint64_t>(n_all) * n_columns_);
        std::size_t at = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t size = static_cast<std::size_t>(n_boxes[i]) * n_columns_;
            plan.chaotic.push_back(
                {static_cast<std::size_t>(points[i]), static_cast<std::int16_t>(labels->values[i]),
                 state_cover(std::span(lowest).subspan(i * n_columns_, n_columns_),
                             std::span(highest).subspan(i * n_columns_, n_columns_),
                             static_cast<std::uint64_t>(along[i]),
                             std::span(boxes).subspan(at, size))});
            at += size;
        }
    }

private:
    static std::int32_t whole(double value) { return static_cast<std::int32_t>(value); }

    std::uint64_t per_point(const number_table& labels) const {
        if (labels.values.empty() || labels.values.size() % n_points_ != 0) misfit(labels.name);
        return labels.values.size() / n_points_;
    }
    const std::vector<double>& values(const std::string& name, std::uint64_t n) const {
        const number_table* const table = group_.table(name);
        if (table == nullptr || table->values.size() != n) misfit(name);
        return table->values;
    }

    const table_group& group_;
    std::uint64_t n_points_;
    std::uint64_t n_columns_;
};

const std::string& attribute(const table_group& group, std::string_view name) {
    const std::string* const text = group.attribute(name);
    if (text == nullptr) misfit("attribute " + std::string(name));
    return *text;
}

}  // namespace

std::optional<table_group> tables_of(const scene& scene, const label_plan& plan) {
    const bool is_by_intervals = plan.decided_by == decision::intervals;
    const bool is_searched = is_by_intervals || plan.decided_by == decision::ellipsoids;
    if (!is_searched || plan.of_cell) return std::nullopt;
    std::vector<std::string> columns;
    for (const column_info& column : scene.end_section().columns) columns.emplace_back(column.name);
    table_group group{traps_group,
                      {{"decided_by", is_by_intervals ? "intervals" : "ellipsoids"},
                       {"died_label", fmt::format("{}", plan.died_label)},
                       {"point_axes", names_of_axes(scene, plan)},
                       {"columns", fmt::format("{}", fmt::join(columns, " "))},
                       {"plan_digest", plan_digest(plan)}},
                      {}};
    table_writer writer(group, n_points_of(scene, plan), columns.size());
    writer.add_intervals("interval", "interval", plan.n_traps, plan.traps, "a trap interval");
    writer.add_intervals("immediate", "side", plan.n_immediate, plan.immediate,
                         "an immediate one-sided basin");
    writer.add_placed(plan.placed);
    writer.add_ellipsoids(plan);
    writer.add_chaotic(plan.chaotic);
    std::size_t n_numbers = 0;
    for (const number_table& table : group.tables) n_numbers += table.values.size();
    if (n_numbers > most_numbers) return std::nullopt;
    return group;
}

label_plan plan_from(const scene& scene, const table_group& group) {
    label_plan plan;
    plan.decided_by =
        attribute(group, "decided_by") == "intervals" ? decision::intervals : decision::ellipsoids;
    const std::string died = attribute(group, "died_label");
    std::from_chars(died.data(), died.data() + died.size(), plan.died_label);
    const std::string names = " " + attribute(group, "point_axes") + " ";
    for (std::size_t axis = 0; axis < scene.axes.size(); ++axis) {
        if (names.find(" " + scene.axes[axis].name + " ") != std::string::npos) {
            plan.point_axes.push_back(axis);
        }
    }
    for (const column_info& column : scene.end_section().columns) {
        plan.point_columns.emplace_back(column.name);
    }
    const table_reader_of_plan reader(group, n_points_of(scene, plan), plan.point_columns.size());
    std::tie(plan.n_traps, plan.traps) = reader.intervals("interval");
    std::tie(plan.n_immediate, plan.immediate) = reader.intervals("immediate");
    reader.read_placed(plan);
    reader.read_ellipsoids(plan);
    reader.read_chaotic(plan);
    return plan;
}

}  // namespace hopscotch
