#include "host/store/map_file.hpp"

#include "host/store/group_file.hpp"
#include "host/store/tile_file.hpp"

#include <algorithm>
#include <cstdio>
#include <set>
#include <sstream>

namespace hopscotch {

namespace {

/// CF separates flag meanings by blanks.
std::string as_one_word(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c <= ' '; }, '_');
    return name.empty() ? "_" : name;
}

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

void describe(hdf5_file& file, const std::string& name, const std::string& unit,
              const std::string& long_name) {
    if (!long_name.empty()) file.set_attribute(name, "long_name", long_name);
    file.set_attribute(name, "units", unit.empty() ? "1" : unit);
}

std::string colour_words(const std::vector<std::pair<int, std::string>>& flags,
                         const std::vector<attractor_row>& attractors) {
    std::string words;
    for (const auto& [value, name] : flags) {
        const auto row = std::find_if(attractors.begin(), attractors.end(),
                                      [value = value](const auto& r) { return r.label == value; });
        char text[16];
        std::snprintf(text, sizeof text, "%s#%06x", words.empty() ? "" : " ",
                      row == attractors.end() ? 0U : row->colour & 0xffffffU);
        words += text;
    }
    return words;
}

bool holds_labels(const layer& each) { return each.holds_labels || each.name == "label"; }

void write_flags(hdf5_file& file, const layer& each, const std::vector<attractor_row>& attractors) {
    typed_numbers values{stored_as(each.type), {}};
    std::string meanings;
    for (const auto& [value, name] : each.flags) {
        values.values.push_back(value);
        meanings += (meanings.empty() ? "" : " ") + as_one_word(name);
    }
    file.set_attribute(each.name, "flag_values", values);
    file.set_attribute(each.name, "flag_meanings", meanings);
    if (holds_labels(each)) {
        file.set_attribute(each.name, "flag_colors", colour_words(each.flags, attractors));
    }
}

void make_layer(hdf5_file& file, const map_description& map, const layer& each) {
    std::vector<std::uint64_t> shape;
    for (const axis& along : map.layout.axes) shape.push_back(along.size());
    const hdf5_type type = stored_as(each.type);
    if (map.tile_directory.empty()) {
        file.make_dataset(each.name,
                          chunked_dataset{type, shape, full_tile(map.layout), each.fill});
    } else {
        file.make_dataset(each.name,
                          virtual_dataset{type, shape, each.fill,
                                          parts_of(map.layout, map.tile_directory, each.name)});
    }
}

void write_layer(hdf5_file& file, const map_description& map, const layer& each) {
    make_layer(file, map, each);
    for (unsigned i = 0; i < map.layout.axes.size(); ++i) {
        file.attach_scale(each.name, map.layout.axes[i].name, i);
    }
    describe_layer(file, each, map.attractors);
    if (!map.tile_directory.empty()) file.let_go(each.name);
}

std::string optional_text(hdf5_file& file, const std::string& object, const std::string& name) {
    return file.has_attribute(object, name) ? file.attribute_text(object, name) : std::string();
}

axis read_axis(hdf5_file& file, const std::string& name) {
    axis result;
    result.name = name;
    result.unit = optional_text(file, name, "units");
    result.long_name = optional_text(file, name, "long_name");
    const std::string scale = optional_text(file, name, "scale");
    if (!scale.empty()) result.scale = scale;
    result.values = file.read_doubles(name);
    return result;
}

number_type number_type_of(const hdf5_file& file, const std::string& name) {
    switch (file.type_of(name)) {
        case hdf5_type::int8:
            return number_type::int8;
        case hdf5_type::int16:
            return number_type::int16;
        case hdf5_type::int32:
            return number_type::int32;
        case hdf5_type::float64:
            return number_type::float64;
        default:
            break;
    }
    throw store_error(file.place() + ": " + name, "not a number type of a layer",
                      "a map that another version has written?");
}

layer read_layer(hdf5_file& file, const std::string& name) {
    layer result;
    result.name = name;
    result.type = number_type_of(file, name);
    result.unit = optional_text(file, name, "units");
    result.long_name = optional_text(file, name, "long_name");
    result.fill = file.attribute_numbers(name, "_FillValue").at(0);
    if (file.has_attribute(name, "flag_values")) {
        const std::vector<double> values = file.attribute_numbers(name, "flag_values");
        const std::vector<std::string> meanings =
            words_of(optional_text(file, name, "flag_meanings"));
        for (std::size_t i = 0; i < std::min(values.size(), meanings.size()); ++i) {
            result.flags.emplace_back(static_cast<int>(values[i]), meanings[i]);
        }
    }
    return result;
}

/// Of virtual layers: where the tile files lie, and their shape, which is the first one's.
void read_tile_files(hdf5_file& file, map_description& map) {
    if (!file.has("/tiles")) {
        throw store_error(file.place(), "an index over the maps of a sweep, and no map itself",
                          "one of its maps, with --point or from the folder beside it");
    }
    map.tile_directory = file.attribute_text("/tiles", "directory");
    const std::vector<std::uint64_t> extents = file.read_words("/tiles/extent");
    const auto rank = static_cast<std::ptrdiff_t>(map.layout.axes.size());
    map.layout.tile.assign(extents.begin(), extents.begin() + rank);
}

/// Attractors' names as they are, where CF's one-word meanings stand for them.
void restore_label_names(map_description& map) {
    const std::size_t index = layer_index(map.layout, "label");
    if (index == map.layout.layers.size()) return;
    for (auto& [value, name] : map.layout.layers[index].flags) {
        for (const attractor_row& row : map.attractors) {
            if (row.label == value) name = row.name;
        }
    }
}

}  // namespace

void describe_axis(hdf5_file& file, const axis& each) {
    describe(file, each.name, each.unit, each.long_name);
    file.set_attribute(each.name, "scale", each.scale);
}

void write_axis(hdf5_file& file, const axis& each) {
    file.write(each.name, {each.size()}, std::span<const double>(each.values));
    file.make_scale(each.name, each.name);
    describe_axis(file, each);
}

void describe_layer(hdf5_file& file, const layer& each,
                    const std::vector<attractor_row>& attractors) {
    describe(file, each.name, each.unit, each.long_name);
    file.set_attribute(each.name, "_FillValue", typed_numbers{stored_as(each.type), {each.fill}});
    if (!each.flags.empty()) write_flags(file, each, attractors);
}

hdf5_type stored_as(number_type type) {
    switch (type) {
        case number_type::int8:
            return hdf5_type::int8;
        case number_type::int16:
            return hdf5_type::int16;
        case number_type::int32:
            return hdf5_type::int32;
        case number_type::float64:
            break;
    }
    return hdf5_type::float64;
}

map_description completed(map_description map, const std::string& place) {
    std::set<std::string> names;
    if (map.layout.axes.empty()) throw store_error(place, "the map has no axis", "");
    for (const axis& each : map.layout.axes) {
        if (each.values.empty()) throw store_error(place, "axis " + each.name + " has no cell", "");
        if (!names.insert(each.name).second) {
            throw store_error(place, "two axes are named " + each.name, "");
        }
    }
    for (layer& each : map.layout.layers) {
        if (!names.insert(each.name).second) {
            throw store_error(place, "layer " + each.name + " has the name of an axis or layer",
                              "leave it out of output.layers");
        }
        if (!holds_labels(each) || !each.flags.empty() || map.attractors.empty()) continue;
        each.flags.emplace_back(0, "none");
        for (const attractor_row& row : map.attractors) {
            if (row.label != 0) each.flags.emplace_back(row.label, row.name);
        }
    }
    if (attribute_of(map.attributes, "Conventions").empty()) {
        map.attributes.insert(map.attributes.begin(), {"Conventions", cf_conventions});
    }
    return map;
}

void write_description(hdf5_file& file, const map_description& map) {
    for (const auto& [name, value] : map.attributes) {
        if (name == "Conventions") {
            file.set_attribute("/", name, value);
        } else {
            file.set_text("/", name, value);
        }
    }
    for (const axis& each : map.layout.axes) write_axis(file, each);
    for (const layer& each : map.layout.layers) write_layer(file, map, each);
    if (!map.attractors.empty()) write_attractors(file, map.attractors, map.point_columns);
    for (const table_group& group : map.groups) write_group(file, group);
}

map_description read_description(hdf5_file& file) {
    map_description map;
    std::vector<std::string> axis_names;
    for (const std::string& name : file.members("/")) {
        if (!file.is_dataset(name)) continue;
        const std::vector<std::uint64_t> chunk = file.chunk_of(name);
        if (chunk.empty() && !file.is_virtual(name)) continue;  // an axis
        axis_names = file.scales_of(name);
        map.layout.tile = chunk;
        map.layout.layers.push_back(read_layer(file, name));
        if (chunk.empty()) file.let_go(name);
    }
    if (map.layout.layers.empty()) {
        throw store_error(file.place(), "holds no layer of a map", "is it a map file");
    }
    for (const std::string& name : axis_names) map.layout.axes.push_back(read_axis(file, name));
    if (map.layout.tile.empty()) read_tile_files(file, map);
    for (const std::string& name : file.attribute_names("/")) {
        if (file.is_text_attribute("/", name)) {
            map.attributes.emplace_back(name, file.attribute_text("/", name));
        }
    }
    if (file.has("/attractors")) map.attractors = read_attractors(file, map.point_columns);
    restore_label_names(map);
    return map;
}

std::vector<virtual_part> parts_of(const map_layout& layout, const std::string& tile_directory,
                                   const std::string& layer) {
    std::vector<virtual_part> parts;
    for (std::uint64_t tile = 0; tile < layout.n_tiles(); ++tile) {
        const tile_box box = box_of(layout, tile);
        parts.push_back({tile_path(tile_directory, tile).string(), layer, box.origin, box.extent,
                         full_tile(layout), box.extent});
    }
    return parts;
}

std::string attribute_of(const attribute_list& attributes, std::string_view name) {
    for (const auto& [key, value] : attributes) {
        if (key == name) return value;
    }
    return {};
}

void set_attribute(attribute_list& attributes, const std::string& name, const std::string& value) {
    for (auto& [key, old] : attributes) {
        if (key == name) {
            old = value;
            return;
        }
    }
    attributes.emplace_back(name, value);
}

}  // namespace hopscotch
