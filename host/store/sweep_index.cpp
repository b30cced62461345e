#include "host/store/sweep_index.hpp"

#include "host/store/atomic_file.hpp"
#include "host/store/map_file.hpp"

#include <cstdio>
#include <limits>

namespace hopscotch {

namespace {

constexpr const char* maps_attribute = "sweep_maps";
constexpr const char* hash_column = "map_hash";

std::vector<std::uint64_t> shape_of(const std::vector<axis>& axes) {
    std::vector<std::uint64_t> shape;
    for (const axis& each : axes) shape.push_back(each.size());
    return shape;
}

std::uint64_t product(const std::vector<std::uint64_t>& factors) {
    std::uint64_t result = 1;
    for (const std::uint64_t factor : factors) result *= factor;
    return result;
}

/// Names separated by blanks, as CF and xarray read them.
std::string joined(const std::vector<axis>& axes) {
    std::string names;
    for (const axis& each : axes) names += (names.empty() ? "" : " ") + each.name;
    return names;
}

/// Every map at its point: one cell along each of the sweep's axes, all cells along the map's.
std::vector<virtual_part> parts_over_maps(const sweep_index& index, const std::string& layer) {
    const std::vector<std::uint64_t> points = shape_of(index.axes);
    const std::vector<std::uint64_t> cells = shape_of(index.layout.axes);
    std::vector<virtual_part> parts;
    for (std::uint64_t point = 0; point < product(points); ++point) {
        virtual_part part{sweep_map_path(index.directory, point).string(),
                          layer,
                          std::vector<std::uint64_t>(points.size() + cells.size(), 0),
                          std::vector<std::uint64_t>(points.size(), 1),
                          cells,
                          cells};
        std::uint64_t rest = point;
        for (std::size_t i = points.size(); i-- > 0; rest /= points[i]) {
            part.origin[i] = rest % points[i];
        }
        part.extent.insert(part.extent.end(), cells.begin(), cells.end());
        parts.push_back(std::move(part));
    }
    return parts;
}

void write_layers(hdf5_file& file, const sweep_index& index) {
    std::vector<axis> axes = index.axes;
    axes.insert(axes.end(), index.layout.axes.begin(), index.layout.axes.end());
    for (const layer& each : index.layout.layers) {
        file.make_dataset(each.name, virtual_dataset{stored_as(each.type), shape_of(axes),
                                                     each.fill, parts_over_maps(index, each.name)});
        for (unsigned i = 0; i < axes.size(); ++i) file.attach_scale(each.name, axes[i].name, i);
        describe_layer(file, each, {});
        if (!index.followers.empty()) {
            file.set_attribute(each.name, "coordinates", joined(index.followers));
        }
        file.let_go(each.name);
    }
}

/// Parameters that move together: numbers along the sweep's only axis.
void write_followers(hdf5_file& file, const sweep_index& index) {
    for (const axis& each : index.followers) {
        file.write(each.name, {each.size()}, std::span<const double>(each.values));
        file.attach_scale(each.name, index.axes[0].name, 0);
        describe_axis(file, each);
    }
}

void write_dimensions(hdf5_file& file, const sweep_index& index) {
    for (const index_dimension& each : index.dimensions) {
        if (each.texts.empty()) {
            file.write(each.name, hdf5_type::int32, {each.values.size()}, each.values);
        } else {
            file.write(each.name, each.texts);
        }
        file.make_scale(each.name, each.name);
        file.set_attribute(each.name, "long_name", each.long_name);
    }
}

std::uint64_t size_of(const index_dimension& dimension) {
    return dimension.texts.empty() ? dimension.values.size() : dimension.texts.size();
}

void write_column(hdf5_file& file, const sweep_index& index, const index_column& column) {
    std::vector<std::uint64_t> shape = shape_of(index.axes);
    std::vector<std::string> scales;
    for (const axis& each : index.axes) scales.push_back(each.name);
    for (const std::string& name : column.dimensions) {
        for (const index_dimension& each : index.dimensions) {
            if (each.name == name) shape.push_back(size_of(each));
        }
        scales.push_back(name);
    }
    if (column.type == hdf5_type::text) {
        file.write(column.name, shape, column.texts);
    } else {
        file.write(column.name, column.type, shape, column.values);
        const double fill =
            column.type == hdf5_type::float64 ? std::numeric_limits<double>::quiet_NaN() : -1.0;
        file.set_attribute(column.name, "_FillValue", typed_numbers{column.type, {fill}});
        file.set_attribute(column.name, "units", column.unit.empty() ? "1" : column.unit);
    }
    for (unsigned i = 0; i < scales.size(); ++i) file.attach_scale(column.name, scales[i], i);
    file.set_attribute(column.name, "long_name", column.long_name);
    if (!index.followers.empty()) {
        file.set_attribute(column.name, "coordinates", joined(index.followers));
    }
}

void write_all(hdf5_file& file, const sweep_index& index) {
    file.set_attribute("/", "Conventions", cf_conventions);
    for (const auto& [name, value] : index.attributes) file.set_text("/", name, value);
    file.set_text("/", maps_attribute, index.directory);
    file.set_text("/", "sweep_axes", joined(index.axes));
    for (const axis& each : index.axes) write_axis(file, each);
    for (const axis& each : index.layout.axes) write_axis(file, each);
    write_followers(file, index);
    write_layers(file, index);
    write_dimensions(file, index);
    for (const index_column& column : index.columns) write_column(file, index, column);
}

}  // namespace

std::filesystem::path sweep_map_path(const std::filesystem::path& directory, std::uint64_t point) {
    char name[48];
    std::snprintf(name, sizeof name, "map_%06llu.h5", static_cast<unsigned long long>(point));
    return directory / name;
}

void write_sweep_index(const std::filesystem::path& file, const sweep_index& index) {
    const hdf5_guard guard;
    const std::filesystem::path partial = partial_name(file);
    try {
        hdf5_file out = hdf5_file::create_virtual(partial);
        write_all(out, index);
        out.close();
        flush_to_disk(partial);
        rename_into_place(partial, file);
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove(partial, ignored);
        throw;
    }
}

std::filesystem::path sweep_directory(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return {};
    const hdf5_guard guard;
    const hdf5_file file = hdf5_file::open(path);
    if (!file.has_attribute("/", maps_attribute)) return {};
    return path.parent_path() / file.attribute_text("/", maps_attribute);
}

sweep_contents read_sweep_contents(const std::filesystem::path& path) {
    const hdf5_guard guard;
    const hdf5_file file = hdf5_file::open(path);
    sweep_contents contents;
    for (const std::string& name : file.attribute_names("/")) {
        if (file.is_text_attribute("/", name)) {
            contents.attributes.emplace_back(name, file.attribute_text("/", name));
        }
    }
    contents.hashes = file.read_texts(hash_column);
    return contents;
}

}  // namespace hopscotch
