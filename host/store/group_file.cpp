// Tables to datasets and back.
#include "host/store/group_file.hpp"

#include "host/store/map_file.hpp"

#include <algorithm>
#include <set>

namespace hopscotch {
namespace {

/// Whole rows of about a megabyte.
std::vector<std::uint64_t> chunk_for(const std::vector<std::uint64_t>& shape, number_type type) {
    constexpr std::uint64_t enough = 1 << 20;
    std::vector<std::uint64_t> chunk = shape;
    std::uint64_t row = bytes_of(type);
    for (std::size_t i = 1; i < shape.size(); ++i) row *= shape[i];
    chunk[0] = std::clamp<std::uint64_t>(enough / row, 1, shape[0]);
    return chunk;
}

void write_dimension(hdf5_file& file, const std::string& path, const table_dimension& along) {
    std::vector<double> places(along.size);
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = static_cast<double>(i);
    file.write(path, hdf5_type::int32, {along.size}, places);
    file.make_scale(path, along.name);
}

void write_table(hdf5_file& file, const std::string& group, const number_table& table) {
    const std::string path = group + "/" + table.name;
    std::vector<std::uint64_t> shape;
    std::uint64_t n = 1;
    for (const table_dimension& along : table.dimensions) {
        shape.push_back(along.size);
        n *= along.size;
    }
    if (n != table.values.size()) {
        throw store_error(
            file.place() + ": " + path,
            std::to_string(table.values.size()) + " numbers for " + std::to_string(n) + " places",
            "");
    }
    file.make_dataset(
        path, chunked_dataset{stored_as(table.type), shape, chunk_for(shape, table.type), 0.0});
    file.write_all(path, table.values);
    for (unsigned i = 0; i < table.dimensions.size(); ++i) {
        file.attach_scale(path, group + "/" + table.dimensions[i].name, i);
    }
    file.set_attribute(path, "long_name", table.long_name);
}

}  // namespace

void write_group(hdf5_file& file, const table_group& group) {
    file.make_group(group.name);
    for (const auto& [name, text] : group.attributes) file.set_text(group.name, name, text);
    std::set<std::string> written;
    for (const number_table& table : group.tables) {
        for (const table_dimension& along : table.dimensions) {
            if (!written.insert(along.name).second) continue;
            write_dimension(file, group.name + "/" + along.name, along);
        }
        write_table(file, group.name, table);
    }
}

table_group read_group(hdf5_file& file, const std::string& name) {
    table_group group{name, {}, {}};
    for (const std::string& attribute : file.attribute_names(name)) {
        if (file.is_text_attribute(name, attribute)) {
            group.attributes.emplace_back(attribute, file.attribute_text(name, attribute));
        }
    }
    for (const std::string& member : file.members(name)) {
        const std::string path = name + "/" + member;
        if (file.chunk_of(path).empty()) continue;  // a dimension
        number_table table{member,
                           file.attribute_text(path, "long_name"),
                           number_type::float64,
                           {},
                           file.read_doubles(path)};
        if (file.type_of(path) == hdf5_type::int32) table.type = number_type::int32;
        const std::vector<std::string> along = file.scales_of(path);
        const std::vector<std::uint64_t> shape = file.shape_of(path);
        for (std::size_t i = 0; i < shape.size(); ++i) {
            table.dimensions.push_back({along[i], shape[i]});
        }
        group.tables.push_back(std::move(table));
    }
    return group;
}

}  // namespace hopscotch
