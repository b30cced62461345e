// Decimal numbers in input files.
#include "host/cli/decimal.hpp"

#include <charconv>
#include <cmath>
#include <string>

namespace hopscotch {
namespace {

/// What lies outside a double's range is infinite or zero: which of them, its decimal exponent
/// says.
double beyond_range(std::string_view text) {
    const bool is_negative = text.front() == '-';
    long position = 0;  // of the first digit that is not zero, counted from the decimal point
    bool has_point = false;
    bool has_digit = false;
    std::size_t i = is_negative ? 1 : 0;
    for (; i < text.size() && text[i] != 'e' && text[i] != 'E'; ++i) {
        if (text[i] == '.')
            has_point = true;
        else if (has_digit || text[i] != '0') {
            has_digit = true;
            position += has_point ? 0 : 1;
        } else if (has_point) {
            --position;
        }
    }
    double exponent = 0.0;
    if (i < text.size()) {
        const bool has_plus = text[i + 1] == '+';
        std::from_chars(text.data() + i + (has_plus ? 2 : 1), text.data() + text.size(), exponent);
    }
    const double size = exponent + static_cast<double>(position) > 0.0 ? HUGE_VAL : 0.0;
    return is_negative ? -size : size;
}

}  // namespace

std::optional<double> parse_decimal(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    if (text.empty()) return std::nullopt;
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, value);
    if (stop != end || failure == std::errc::invalid_argument) return std::nullopt;
    if (failure == std::errc::result_out_of_range) return beyond_range(text);
    if (std::isnan(value)) return std::nullopt;
    return value;
}

}  // namespace hopscotch
