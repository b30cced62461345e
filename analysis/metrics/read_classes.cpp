#include "analysis/metrics/read_classes.hpp"

#include "host/map/rows.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>

#include <fmt/format.h>

namespace hopscotch::metrics {
namespace {

/// What a cell says before classes have numbers: a value of the layer, or why there is none.
struct cell_code {
    enum kind : std::uint8_t { value, outcome_kind, undecided, outside, not_computed };
    kind what = undecided;
    int number = 0;

    auto operator<=>(const cell_code&) const = default;
};

bool is_undecided(outcome end) {
    return end == outcome::budget || end == outcome::not_finite || end == outcome::unresolved_event;
}

/// A name as a file's list of flag meanings spells it.
std::string one_word(std::string name) {
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
}

/// Classes are numbered as they are met; `finish` brings them into canonical order.
class class_table {
public:
    class_table(const map_reader& map, const layer& what, fall_rule falls)
        : map_(map), what_(what), falls_(falls), is_outcome_(what.name == "outcome") {
        table_.fill(unknown);
    }

    cell_code code_of(double value, const double* end) const {
        if (value == what_.fill) return {cell_code::not_computed};
        const int number = static_cast<int>(value);
        if (is_outcome_) return code_of_outcome(static_cast<outcome>(number));
        if (what_.name != "label" || number != 0) return {cell_code::value, number};
        if (end == nullptr || *end == 255.0) return {cell_code::undecided};
        const auto how = static_cast<outcome>(static_cast<int>(*end));
        if (how == outcome::ok || how == outcome::attracted) return {cell_code::undecided};
        return code_of_outcome(how);
    }

    class_index index_of(const cell_code& code) {
        if (code.what >= cell_code::undecided) return no_class;
        const bool is_end = code.what == cell_code::outcome_kind;
        std::uint16_t& known = table_[static_cast<std::size_t>(
            is_end ? code.number : n_outcomes + code.number - lowest_value)];
        if (known == unknown) {
            if (codes_.size() == no_class) {
                throw store_error("layer " + what_.name, "it has more than 254 different values",
                                  "--layer label");
            }
            known = static_cast<std::uint16_t>(codes_.size());
            codes_.push_back(code);
        }
        return static_cast<class_index>(known);
    }

    void finish(class_grid& grid) const;

private:
    static constexpr std::uint16_t unknown = 0xffff;
    static constexpr int n_outcomes = 256;
    static constexpr int lowest_value = -32768;

    cell_code code_of_outcome(outcome end) const {
        if (end == outcome::invalid_start) return {cell_code::outside};
        if (is_undecided(end)) return {cell_code::undecided};
        if (!is_failure(end) || falls_ == fall_rule::separate) {
            return {cell_code::outcome_kind, static_cast<int>(end)};
        }
        if (falls_ == fall_rule::left_out) return {cell_code::undecided};
        return {cell_code::outcome_kind, static_cast<int>(outcome::fell)};
    }

    basin_class described(const cell_code& code) const {
        basin_class result;
        result.value = code.number;
        result.is_outcome = code.what == cell_code::outcome_kind;
        if (result.is_outcome) {
            const auto end = static_cast<outcome>(code.number);
            result.is_fall = is_failure(end);
            const bool is_union = result.is_fall && falls_ == fall_rule::together;
            const auto known = static_cast<std::size_t>(code.number) < outcome_names.size();
            result.name = is_union ? "failure" : known ? std::string(name_of(end)) : "unknown";
            return result;
        }
        for (const auto& [value, name] : what_.flags) {
            if (value == code.number) result.name = name;
        }
        for (const attractor_row& row : map_.attractors()) {
            const bool is_meant = what_.name == "label" || one_word(row.name) == result.name;
            if (row.label == code.number && is_meant) result.name = row.name;
        }
        if (result.name.empty()) result.name = fmt::format("{} {}", what_.name, code.number);
        return result;
    }

    const map_reader& map_;
    const layer& what_;
    fall_rule falls_;
    bool is_outcome_;
    std::array<std::uint16_t, 65536 + n_outcomes> table_;
    std::vector<cell_code> codes_;
};

/// Values in ascending order, then outcomes by code; beyond `most_classes` the rarest ones become
/// one class, since a set of classes has 64 bits.
void class_table::finish(class_grid& grid) const {
    std::vector<std::uint64_t> counts(256, 0);
    for (const class_index cell : grid.cells) ++counts[cell];
    std::vector<std::size_t> order(codes_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (order.size() > most_classes) {
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return counts[a] > counts[b]; });
        grid.n_lumped = order.size() - (most_classes - 1);
    }
    const std::size_t n_kept = order.size() - grid.n_lumped;
    std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n_kept),
              [&](std::size_t a, std::size_t b) { return codes_[a] < codes_[b]; });
    std::array<class_index, 256> renumbered{};
    renumbered.fill(no_class);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::size_t target = std::min(i, n_kept);
        renumbered[order[i]] = static_cast<class_index>(target);
        if (target == grid.classes.size()) grid.classes.push_back(described(codes_[order[i]]));
        grid.classes[target].n_cells += counts[order[i]];
    }
    if (grid.n_lumped > 0) {
        grid.classes.back().name = fmt::format("the {} rarest", grid.n_lumped);
    }
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < grid.cells.size(); ++i) {
        grid.cells[i] = renumbered[grid.cells[i]];
    }
}

const layer& checked_layer(const map_reader& map, const std::string& name) {
    const std::vector<layer>& layers = map.layout().layers;
    const std::size_t index = layer_index(map.layout(), name);
    std::string known;
    for (const layer& each : layers) {
        const bool is_integer = each.type == number_type::int16 || each.type == number_type::int8;
        if (is_integer) known += (known.empty() ? "" : ", ") + each.name;
    }
    const std::string hint = known.empty() ? "" : "one of " + known;
    if (index == layers.size()) {
        throw store_error("layer " + name, "the map has none of that name", hint);
    }
    const number_type type = layers[index].type;
    if (type != number_type::int16 && type != number_type::int8) {
        throw store_error("layer " + name, "its values are no classes", hint);
    }
    return layers[index];
}

void check_axes(const class_grid& grid) {
    if (grid.rank() == 0) throw store_error("map", "it has a single cell", "");
    if (grid.rank() > 3) {
        throw store_error(
            "map", fmt::format("it has {} axes; metrics are defined for one to three", grid.rank()),
            "a map with cells = 1 along the others");
    }
}

}  // namespace

bool is_failure(outcome end) {
    const bool is_rest = end == outcome::stuck || end == outcome::rest;
    const bool goes_on = end == outcome::ok || end == outcome::attracted;
    return !goes_on && !is_rest && !is_undecided(end) && end != outcome::invalid_start &&
           static_cast<std::size_t>(end) < outcome_names.size();
}

std::string layer_of(const map_reader& map, const class_choice& choice) {
    if (!choice.layer.empty()) return choice.layer;
    const bool has_labels = layer_index(map.layout(), "label") < map.layout().layers.size();
    return has_labels ? "label" : "outcome";
}

class_grid read_classes(const map_reader& map, const class_choice& choice) {
    const map_layout& layout = map.layout();
    const layer& what = checked_layer(map, layer_of(map, choice));
    const bool has_outcomes =
        what.name == "label" && layer_index(layout, "outcome") < layout.layers.size();
    class_grid grid;
    for (const axis& each : layout.axes) {
        if (each.size() > 1) grid.axes.push_back(each);
    }
    check_axes(grid);
    grid.cells.assign(layout.n_cells(), no_class);

    const auto classes = std::make_unique<class_table>(map, what, choice.falls);
    std::vector<std::uint64_t> shape;
    for (const axis& each : layout.axes) shape.push_back(each.size());
    for (std::uint64_t tile = 0; tile < layout.n_tiles(); ++tile) {
        const tile_box box = box_of(layout, tile);
        const cell_range range{box.origin, box.extent, {}};
        const std::vector<double> values = map.read(what.name, range);
        std::vector<double> ends;
        if (has_outcomes) ends = map.read("outcome", range);
        std::uint64_t from = 0;
        for_each_row(box.extent, [&](const std::vector<std::uint64_t>& position) {
            std::vector<std::uint64_t> at = box.origin;
            for (std::size_t i = 0; i < at.size(); ++i) at[i] += position[i];
            const std::uint64_t to = offset_in(shape, at);
            for (std::uint64_t j = 0; j < box.extent.back(); ++j, ++from) {
                const cell_code code =
                    classes->code_of(values[from], has_outcomes ? &ends[from] : nullptr);
                grid.n_undecided += code.what == cell_code::undecided;
                grid.n_outside += code.what == cell_code::outside;
                grid.n_not_computed += code.what == cell_code::not_computed;
                grid.cells[to + j] = classes->index_of(code);
            }
        });
    }
    classes->finish(grid);
    return grid;
}

}  // namespace hopscotch::metrics
