// Tables and layers, one after the other.
#include "host/device/device_layout.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace hopscotch {
namespace {

constexpr std::size_t alignment = 256;  // rows of a device's memory

constexpr std::size_t rounded_up(std::size_t bytes) {
    return (bytes + alignment - 1) / alignment * alignment;
}

/// The pointer moved back by n numbers that are not there: never read before it is moved on again.
template <class Number>
Number* moved_back(std::byte* address, std::uint64_t n) {
    return reinterpret_cast<Number*>(reinterpret_cast<std::uintptr_t>(address) -
                                     static_cast<std::uintptr_t>(n * sizeof(Number)));
}

/// function(pointer, first, n) for every table of numbers that the request reads: numbers
/// [first, first + n) are needed.
template <class Request, class Function>
void for_each_table(Request& request, std::uint64_t first_point, std::uint64_t n_points,
                    const Function& function) {
    const auto of_source = [&](auto& source) {
        if (source.values != nullptr) function(source.values, std::uint64_t{0}, source.size);
    };
    for (auto& column : request.columns) of_source(column);
    for (auto& parameter : request.parameters) of_source(parameter);
    of_source(request.trap_point);
    const auto of_traps = [&](auto& traps, int n) {
        const auto per_point = static_cast<std::uint64_t>(n);
        if (n > 0) function(traps, first_point * per_point, n_points * per_point);
    };
    of_traps(request.traps, request.n_traps);
    of_traps(request.ellipsoids, request.n_ellipsoids);
}

/// function(pointer) for every layer that is wanted.
template <class Request, class Function>
void for_each_layer(Request& request, const Function& function) {
    const auto of_layer = [&](auto& layer) {
        if (layer != nullptr) function(layer);
    };
    of_layer(request.label);
    of_layer(request.outcome);
    of_layer(request.returns);
    of_layer(request.events);
    of_layer(request.time);
    for (auto& layer : request.state) of_layer(layer);
    for (auto& layer : request.extras) of_layer(layer);
    for (auto& layer : request.exponents.exponents) of_layer(layer);
    of_layer(request.exponents.rate);
    of_layer(request.exponents.standard_error);
    of_layer(request.exponents.returns);
    of_layer(request.exponents.motion);
}

}  // namespace

device_layout::device_layout(const ensemble_request& request) : request_(request) {
    if (const column_source& points = request.trap_point; points.values != nullptr) {
        const auto [lowest, highest] =
            std::minmax_element(points.values, points.values + points.size);
        first_point_ = static_cast<std::uint64_t>(*lowest);
        n_points_ = static_cast<std::uint64_t>(*highest) - first_point_ + 1;
    }
    for_each_table(request, first_point_, n_points_, [&](const auto* from, auto, auto n) {
        table_bytes_ += rounded_up(n * sizeof(*from));
    });
}

void device_layout::put_tables(std::byte* to) const {
    for_each_table(request_, first_point_, n_points_, [&](const auto* from, auto first, auto n) {
        std::memcpy(to, from + first, n * sizeof(*from));
        to += rounded_up(n * sizeof(*from));
    });
}

std::size_t device_layout::layer_bytes(std::uint64_t n_cells) const {
    std::size_t bytes = 0;
    for_each_layer(request_,
                   [&](const auto* layer) { bytes += rounded_up(n_cells * sizeof(*layer)); });
    return bytes;
}

std::uint64_t device_layout::cells_within(std::size_t bytes) const {
    std::size_t per_cell = 0;
    std::size_t padding = 0;
    for_each_layer(request_, [&](const auto* layer) {
        per_cell += sizeof(*layer);
        padding += alignment;
    });
    if (per_cell == 0) return request_.n_cells;
    return bytes < padding ? 0 : (bytes - padding) / per_cell;
}

ensemble_request device_layout::on_device(std::byte* tables, std::byte* layers,
                                          cell_piece piece) const {
    ensemble_request result = request_;
    for_each_table(result, first_point_, n_points_, [&](auto*& table, auto first, auto n) {
        using number = std::remove_reference_t<decltype(*table)>;
        table = moved_back<number>(tables, first);
        tables += rounded_up(n * sizeof(number));
    });
    for_each_layer(result, [&](auto*& layer) {
        using number = std::remove_reference_t<decltype(*layer)>;
        layer = moved_back<number>(layers, piece.first);
        layers += rounded_up(piece.n * sizeof(number));
    });
    return result;
}

void device_layout::take_layers(const std::byte* layers, cell_piece piece) const {
    for_each_layer(request_, [&](auto* layer) {
        std::memcpy(layer + piece.first, layers, piece.n * sizeof(*layer));
        layers += rounded_up(piece.n * sizeof(*layer));
    });
}

}  // namespace hopscotch
