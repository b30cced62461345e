#include "host/store/compressed_tile.hpp"

#include "host/map/numbers.hpp"
#include "host/map/rows.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <stdexcept>

namespace hopscotch {

namespace {

struct free_compressor {
    void operator()(libdeflate_compressor* each) const { libdeflate_free_compressor(each); }
};
struct free_decompressor {
    void operator()(libdeflate_decompressor* each) const { libdeflate_free_decompressor(each); }
};

/// This thread's compressor of that level (about a megabyte, made once).
libdeflate_compressor* compressor_for(int level) {
    thread_local std::array<std::unique_ptr<libdeflate_compressor, free_compressor>, 10> kept;
    auto& compressor = kept[static_cast<std::size_t>(std::clamp(level, 0, 9))];
    if (!compressor) compressor.reset(libdeflate_alloc_compressor(std::clamp(level, 0, 9)));
    if (!compressor) throw std::bad_alloc();
    return compressor.get();
}

libdeflate_decompressor* decompressor() {
    thread_local std::unique_ptr<libdeflate_decompressor, free_decompressor> kept(
        libdeflate_alloc_decompressor());
    if (!kept) throw std::bad_alloc();
    return kept.get();
}

std::vector<std::byte> deflated(const std::vector<std::byte>& bytes, int level) {
    libdeflate_compressor* compressor = compressor_for(level);
    std::vector<std::byte> result(libdeflate_zlib_compress_bound(compressor, bytes.size()));
    result.resize(libdeflate_zlib_compress(compressor, bytes.data(), bytes.size(), result.data(),
                                           result.size()));
    result.shrink_to_fit();
    return result;
}

std::vector<std::byte> inflated(std::span<const std::byte> bytes, std::size_t size) {
    std::vector<std::byte> result(size);
    if (libdeflate_zlib_decompress(decompressor(), bytes.data(), bytes.size(), result.data(), size,
                                   nullptr) != LIBDEFLATE_SUCCESS) {
        throw std::runtime_error("its compressed bytes do not decode");
    }
    return result;
}

/// HDF5's shuffle filter: first all lowest bytes, then all second bytes ...
template <std::size_t Width>
std::vector<std::byte> shuffled(const std::vector<std::byte>& bytes) {
    const std::size_t n = bytes.size() / Width;
    std::vector<std::byte> result(bytes.size());
    for (std::size_t plane = 0; plane < Width; ++plane) {
        const std::byte* from = bytes.data() + plane;
        std::byte* to = result.data() + plane * n;
        for (std::size_t i = 0; i < n; ++i) to[i] = from[i * Width];
    }
    return result;
}

template <std::size_t Width>
std::vector<std::byte> unshuffled(const std::vector<std::byte>& bytes) {
    const std::size_t n = bytes.size() / Width;
    std::vector<std::byte> result(bytes.size());
    for (std::size_t plane = 0; plane < Width; ++plane) {
        const std::byte* from = bytes.data() + plane * n;
        std::byte* to = result.data() + plane;
        for (std::size_t i = 0; i < n; ++i) to[i * Width] = from[i];
    }
    return result;
}

void make_all_nans_equal(std::vector<std::byte>& bytes) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i + sizeof(double) <= bytes.size(); i += sizeof(double)) {
        double value;
        std::memcpy(&value, &bytes[i], sizeof value);
        if (value != value) std::memcpy(&bytes[i], &nan, sizeof nan);
    }
}

std::uint64_t cells_of_full_tile(const map_layout& layout) {
    std::uint64_t cells = 1;
    for (const std::uint64_t each : full_tile(layout)) cells *= each;
    return cells;
}

/// The box's values placed into a full tile whose other cells hold the fill value.
std::vector<std::byte> padded(const map_layout& layout, const tile_box& box, const layer& layer,
                              const std::vector<std::byte>& values) {
    const std::uint64_t cells = cells_of_full_tile(layout);
    if (box.n_cells() == cells) return values;
    const std::size_t width = bytes_of(layer.type);
    std::vector<std::byte> result(cells * width);
    fill_numbers(layer.type, result.data(), 0, cells, layer.fill);
    const std::size_t row_bytes = box.extent.back() * width;
    const std::vector<std::uint64_t> shape = full_tile(layout);
    const std::byte* from = values.data();
    for_each_row(box.extent, [&](const std::vector<std::uint64_t>& position) {
        std::memcpy(&result[offset_in(shape, position) * width], from, row_bytes);
        from += row_bytes;
    });
    return result;
}

/// The inverse of `padded`.
std::vector<std::byte> cut(const map_layout& layout, const tile_box& box, const layer& layer,
                           std::vector<std::byte> full) {
    if (box.n_cells() == cells_of_full_tile(layout)) return full;
    const std::size_t width = bytes_of(layer.type);
    std::vector<std::byte> result(box.n_cells() * width);
    const std::size_t row_bytes = box.extent.back() * width;
    const std::vector<std::uint64_t> shape = full_tile(layout);
    std::byte* to = result.data();
    for_each_row(box.extent, [&](const std::vector<std::uint64_t>& position) {
        std::memcpy(to, &full[offset_in(shape, position) * width], row_bytes);
        to += row_bytes;
    });
    return result;
}

template <class T>
value_counts counts_of(const std::vector<std::byte>& values) {
    constexpr int lowest = std::numeric_limits<T>::min();
    constexpr int highest = std::numeric_limits<T>::max();
    std::vector<std::uint64_t> table(static_cast<std::size_t>(highest - lowest + 1), 0);
    for (std::size_t i = 0; i < values.size() / sizeof(T); ++i) {
        T value;
        std::memcpy(&value, &values[i * sizeof(T)], sizeof(T));
        ++table[static_cast<std::size_t>(value - lowest)];
    }
    value_counts counts;
    for (int value = lowest; value <= highest; ++value) {
        const std::uint64_t n = table[static_cast<std::size_t>(value - lowest)];
        if (n > 0) counts.emplace(value, n);
    }
    return counts;
}

void require_all_layers(const map_layout& layout, const tile_data& tile) {
    if (tile.layers.size() == layout.layers.size()) return;
    throw std::invalid_argument("tile " + std::to_string(tile.box.index) + " has " +
                                std::to_string(tile.layers.size()) + " of " +
                                std::to_string(layout.layers.size()) + " layers");
}

}  // namespace

tile_summary summarise(const map_layout& layout, const tile_data& tile) {
    require_all_layers(layout, tile);
    tile_summary summary;
    for (std::size_t i = 0; i < layout.layers.size(); ++i) {
        summary.sums.push_back(sum_of(layout, tile.box, i, tile.layers[i]));
        const number_type type = layout.layers[i].type;
        if (type == number_type::int8) {
            summary.counts.push_back(counts_of<std::int8_t>(tile.layers[i]));
        } else if (type == number_type::int16) {
            summary.counts.push_back(counts_of<std::int16_t>(tile.layers[i]));
        } else {
            summary.counts.emplace_back();
        }
    }
    return summary;
}

compressed_tile compress(const map_layout& layout, const tile_data& tile, int level,
                         double seconds) {
    compressed_tile result{tile.box, {}, summarise(layout, tile)};
    result.summary.seconds = seconds;
    for (std::size_t i = 0; i < layout.layers.size(); ++i) {
        const layer& each = layout.layers[i];
        std::vector<std::byte> bytes = padded(layout, tile.box, each, tile.layers[i]);
        switch (each.type) {
            case number_type::int8:
                break;
            case number_type::int16:
                bytes = shuffled<2>(bytes);
                break;
            case number_type::int32:
                bytes = shuffled<4>(bytes);
                break;
            case number_type::float64:
                make_all_nans_equal(bytes);
                bytes = shuffled<8>(bytes);
                break;
        }
        result.chunks.push_back(deflated(bytes, level));
    }
    return result;
}

std::vector<std::byte> decode_chunk(const map_layout& layout, const tile_box& box,
                                    std::size_t layer, std::span<const std::byte> chunk) {
    const struct layer& each = layout.layers.at(layer);
    std::vector<std::byte> bytes =
        inflated(chunk, cells_of_full_tile(layout) * bytes_of(each.type));
    switch (each.type) {
        case number_type::int8:
            break;
        case number_type::int16:
            bytes = unshuffled<2>(bytes);
            break;
        case number_type::int32:
            bytes = unshuffled<4>(bytes);
            break;
        case number_type::float64:
            bytes = unshuffled<8>(bytes);
            break;
    }
    return cut(layout, box, each, std::move(bytes));
}

std::uint32_t cyclic_check(std::span<const std::byte> chunk) {
    return libdeflate_crc32(0, chunk.data(), chunk.size());
}

tile_data decompress(const map_layout& layout, const compressed_tile& tile) {
    tile_data result{tile.box, {}};
    for (std::size_t i = 0; i < layout.layers.size(); ++i) {
        result.layers.push_back(decode_chunk(layout, tile.box, i, tile.chunks.at(i)));
    }
    return result;
}

}  // namespace hopscotch
