// Numbers of a layer's type in raw memory, read and written as double (exact for every type we
// store).
#pragma once

#include "host/map/layout.hpp"

#include <cstddef>
#include <cstring>

namespace hopscotch {

/// Calls visit(T{}) with T the C++ type of a number_type.
template <class Visit>
decltype(auto) with_type(number_type type, Visit&& visit) {
    switch (type) {
        case number_type::int8:
            return visit(std::int8_t{});
        case number_type::int16:
            return visit(std::int16_t{});
        case number_type::int32:
            return visit(std::int32_t{});
        case number_type::float64:
            break;
    }
    return visit(double{});
}

/// The i-th number of an array.
inline double number_at(number_type type, const std::byte* values, std::uint64_t i) {
    return with_type(type, [&]<class T>(T value) {
        std::memcpy(&value, values + i * sizeof(T), sizeof(T));
        return static_cast<double>(value);
    });
}

/// Sets n numbers from the i-th on; `value` must be representable in the type.
inline void fill_numbers(number_type type, std::byte* values, std::uint64_t i, std::uint64_t n,
                         double value) {
    with_type(type, [&]<class T>(T) {
        const T typed = static_cast<T>(value);
        for (std::uint64_t j = i; j < i + n; ++j) {
            std::memcpy(values + j * sizeof(T), &typed, sizeof(T));
        }
    });
}

}  // namespace hopscotch
