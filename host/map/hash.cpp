#include "host/map/hash.hpp"

#include "host/map/rows.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace hopscotch {

namespace {

// Odd multipliers with well spread bits (golden ratio, and the finaliser constants of splitmix64).
constexpr std::uint64_t golden = 0x9e3779b97f4a7c15;
constexpr std::uint64_t first_factor = 0xbf58476d1ce4e5b9;
constexpr std::uint64_t second_factor = 0x94d049bb133111eb;
constexpr std::uint64_t third_factor = 0xd6e8feb86659fd93;

/// A bijection of 64 bits whose every output bit depends on every input bit (splitmix64).
constexpr std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * first_factor;
    x = (x ^ (x >> 27)) * second_factor;
    return x ^ (x >> 31);
}

constexpr std::uint64_t seed_of(std::string_view text) {
    std::uint64_t seed = golden;
    for (const char c : text) seed = mixed(seed ^ static_cast<unsigned char>(c)) + golden;
    return seed;
}

/// The bits of one value, zero-extended; every NaN is the same value.
template <class Word>
std::uint64_t bits_at(const std::byte* values, std::uint64_t i) {
    Word word;
    std::memcpy(&word, values + i * sizeof(Word), sizeof(Word));
    if constexpr (sizeof(Word) == 8) {
        constexpr std::uint64_t infinity_bits = 0x7ff0000000000000;
        constexpr std::uint64_t nan_bits = 0x7ff8000000000000;
        return (word & ~(std::uint64_t{1} << 63)) > infinity_bits ? nan_bits : word;
    }
    return word;
}

void add(layer_sum& sum, std::uint64_t key, std::uint64_t bits) {
    const std::uint64_t low = mixed(key ^ bits);
    const std::uint64_t high = low * third_factor;
    sum.low += low;
    sum.high += high ^ (high >> 32);
}

/// Sum over a row; `key` belongs to its first cell. Eight independent accumulators let the compiler
/// use vector registers, and wrapping sums do not depend on their order.
template <class Word>
layer_sum sum_of_row(std::uint64_t key, const std::byte* values, std::uint64_t n) {
    constexpr std::uint64_t width = 8;
    std::array<layer_sum, width> sums{};
    std::uint64_t i = 0;
    for (; i + width <= n; i += width) {
        for (std::uint64_t j = 0; j < width; ++j) {
            add(sums[j], key + (i + j) * golden, bits_at<Word>(values, i + j));
        }
    }
    for (; i < n; ++i) add(sums[0], key + i * golden, bits_at<Word>(values, i));
    layer_sum total;
    for (const layer_sum& each : sums) total += each;
    return total;
}

layer_sum sum_of_row(number_type type, std::uint64_t key, const std::byte* values,
                     std::uint64_t n) {
    switch (type) {
        case number_type::int8:
            return sum_of_row<std::uint8_t>(key, values, n);
        case number_type::int16:
            return sum_of_row<std::uint16_t>(key, values, n);
        case number_type::int32:
            return sum_of_row<std::uint32_t>(key, values, n);
        case number_type::float64:
            return sum_of_row<std::uint64_t>(key, values, n);
    }
    return {};
}

std::vector<std::uint64_t> shape_of(const map_layout& layout) {
    std::vector<std::uint64_t> shape;
    for (const axis& each : layout.axes) shape.push_back(each.size());
    return shape;
}

/// A digest of a sequence of words and texts; the order counts.
class digest {
public:
    void word(std::uint64_t bits) {
        state_.low = mixed(state_.low ^ bits) + golden;
        state_.high = mixed(state_.high + bits * third_factor) ^ state_.low;
    }
    void text(std::string_view characters) {
        word(characters.size());
        for (const char c : characters) word(static_cast<unsigned char>(c));
    }
    const layer_sum& value() const { return state_; }

private:
    layer_sum state_{golden, third_factor};
};

}  // namespace

layer_sum sum_of(const map_layout& layout, const tile_box& box, std::size_t layer,
                 std::span<const std::byte> values) {
    const number_type type = layout.layers.at(layer).type;
    if (values.size() != box.n_cells() * bytes_of(type)) {
        throw std::invalid_argument("layer " + layout.layers[layer].name + " of tile " +
                                    std::to_string(box.index) + " has " +
                                    std::to_string(values.size()) + " bytes for " +
                                    std::to_string(box.n_cells()) + " cells");
    }
    const std::vector<std::uint64_t> shape = shape_of(layout);
    const std::uint64_t row_cells = box.extent.empty() ? 1 : box.extent.back();
    const std::uint64_t seed = seed_of(layout.layers[layer].name);
    const std::byte* row_values = values.data();
    std::vector<std::uint64_t> cell(shape.size());
    layer_sum sum;
    for_each_row(box.extent, [&](const std::vector<std::uint64_t>& position) {
        for (std::size_t i = 0; i < cell.size(); ++i) cell[i] = box.origin[i] + position[i];
        sum += sum_of_row(type, seed + offset_in(shape, cell) * golden, row_values, row_cells);
        row_values += row_cells * bytes_of(type);
    });
    return sum;
}

std::string map_hash(const map_layout& layout, std::span<const layer_sum> sums) {
    digest result;
    for (const axis& each : layout.axes) {
        result.text(each.name);
        for (const double value : each.values) result.word(std::bit_cast<std::uint64_t>(value));
    }
    for (std::size_t i = 0; i < layout.layers.size(); ++i) {
        result.text(layout.layers[i].name);
        result.word(static_cast<std::uint64_t>(layout.layers[i].type));
        result.word(sums[i].low);
        result.word(sums[i].high);
    }
    return hexadecimal(result.value());
}

std::string hexadecimal(const layer_sum& sum) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (const std::uint64_t word : {sum.high, sum.low}) {
        for (int shift = 60; shift >= 0; shift -= 4) text += digits[(word >> shift) & 15];
    }
    return text;
}

}  // namespace hopscotch
