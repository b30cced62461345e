#include "host/store/tile_file.hpp"

#include "host/store/atomic_file.hpp"
#include "host/store/hdf5_file.hpp"
#include "host/store/map_file.hpp"

#include <cstdio>

namespace hopscotch {

namespace {

std::vector<std::byte> image_of(const std::string& place, const map_layout& layout,
                                const std::string& fingerprint, const compressed_tile& tile) {
    const hdf5_guard guard;
    hdf5_file file = hdf5_file::create_in_memory(place);
    const std::vector<std::uint64_t> shape = full_tile(layout);
    const std::vector<std::uint64_t> corner(shape.size(), 0);
    std::vector<std::uint64_t> sums;
    std::vector<std::uint64_t> checks;
    for (std::size_t i = 0; i < layout.layers.size(); ++i) {
        const layer& each = layout.layers[i];
        file.make_dataset(each.name, {stored_as(each.type), shape, shape, each.fill});
        file.write_chunk(each.name, corner, tile.chunks.at(i));
        sums.push_back(tile.summary.sums.at(i).low);
        sums.push_back(tile.summary.sums.at(i).high);
        checks.push_back(cyclic_check(tile.chunks[i]));
    }
    file.set_attribute("/", "fingerprint", fingerprint);
    file.set_words("/", "tile", std::vector<std::uint64_t>{tile.box.index});
    file.set_words("/", "origin", tile.box.origin);
    file.set_words("/", "extent", tile.box.extent);
    file.set_words("/", "checksum", sums);
    file.set_words("/", "chunk_check", checks);
    file.set_attribute("/", "seconds", typed_numbers{hdf5_type::float64, {tile.summary.seconds}});
    return file.image();
}

[[noreturn]] void fail(const std::string& place, const std::string& reason) {
    throw store_error(place, "damaged tile: " + reason, "run again with --resume");
}

compressed_tile parse(const std::vector<std::byte>& image, const std::string& place,
                      const map_layout& layout, const std::string& fingerprint,
                      std::uint64_t index) {
    const hdf5_guard guard;
    hdf5_file file = hdf5_file::open_image(image, place);
    if (file.attribute_text("/", "fingerprint") != fingerprint) {
        throw store_error(place, another_scene, "remove it");
    }
    compressed_tile tile{box_of(layout, index), {}, {}};
    if (file.attribute_words("/", "origin") != tile.box.origin ||
        file.attribute_words("/", "extent") != tile.box.extent) {
        throw store_error(place,
                          "its place in the map is not that of tile " + std::to_string(index),
                          "remove it");
    }
    const std::vector<std::uint64_t> sums = file.attribute_words("/", "checksum");
    const std::vector<std::uint64_t> checks = file.attribute_words("/", "chunk_check");
    if (sums.size() != 2 * layout.layers.size() || checks.size() != layout.layers.size()) {
        fail(place, "it has other layers");
    }
    const std::vector<std::uint64_t> corner(tile.box.origin.size(), 0);
    for (std::size_t i = 0; i < layout.layers.size(); ++i) {
        auto chunk = file.read_chunk(layout.layers[i].name, corner);
        if (!chunk) fail(place, "layer " + layout.layers[i].name + " is empty");
        if (cyclic_check(*chunk) != checks[i]) {
            fail(place, "layer " + layout.layers[i].name + " does not agree with its checksum");
        }
        tile.chunks.push_back(std::move(*chunk));
        tile.summary.sums.push_back({sums[2 * i], sums[2 * i + 1]});
    }
    tile.summary.seconds = file.attribute_numbers("/", "seconds").at(0);
    return tile;
}

}  // namespace

std::filesystem::path tile_path(const std::filesystem::path& directory, std::uint64_t tile) {
    char name[48];
    std::snprintf(name, sizeof name, "tile_%09llu.h5", static_cast<unsigned long long>(tile));
    return directory / name;
}

std::optional<std::uint64_t> tile_of(const std::filesystem::path& file) {
    unsigned long long tile = 0;
    if (std::sscanf(file.filename().c_str(), "tile_%llu.h5", &tile) != 1) return std::nullopt;
    if (tile_path({}, tile) != file.filename()) return std::nullopt;
    return tile;
}

void write_tile(const std::filesystem::path& directory, const map_layout& layout,
                const std::string& fingerprint, const compressed_tile& tile) {
    const std::filesystem::path path = tile_path(directory, tile.box.index);
    write_atomically(path, image_of(path.string(), layout, fingerprint, tile));
}

compressed_tile read_tile(const std::filesystem::path& directory, const map_layout& layout,
                          const std::string& fingerprint, std::uint64_t tile) {
    const std::filesystem::path path = tile_path(directory, tile);
    const std::vector<std::byte> image = read_bytes(path);
    if (image.empty()) fail(path.string(), "the file is empty");
    return parse(image, path.string(), layout, fingerprint, tile);
}

tile_data checked_tile(const map_layout& layout, const compressed_tile& tile,
                       const std::string& place) {
    tile_data result{tile.box, {}};
    for (std::size_t i = 0; i < layout.layers.size(); ++i) {
        const std::string& name = layout.layers[i].name;
        try {
            result.layers.push_back(decode_chunk(layout, tile.box, i, tile.chunks.at(i)));
        } catch (const std::runtime_error& error) {
            fail(place, "layer " + name + ": " + error.what());
        }
        if (sum_of(layout, tile.box, i, result.layers.back()) != tile.summary.sums.at(i)) {
            fail(place, "layer " + name + " does not agree with its checksum");
        }
    }
    return result;
}

}  // namespace hopscotch
