// Decimal numerals to and from every host arithmetic, without losing digits on the way: replay
// files, audit records and scenes' parameters pass through here.
#pragma once

#include "analysis/truth/real50.hpp"
#include "kernels/lanes/double_double.hpp"

#include <charconv>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace hopscotch::inline HOPSCOTCH_TARGET {

inline double_double<double> to_double_double(const real50& x) {
    const double high = to_double(x);
    const double low = to_double(x - real50(high));
    return {high, abs(high) < infinity<double>() ? low : 0.0};
}
inline real50 to_real50(const double_double<double>& x) { return real50(x.high) + real50(x.low); }
inline real50 to_real50(double x) { return real50(x); }
inline real50 to_real50(const real50& x) { return x; }

/// The value of a decimal numeral of any length, rounded once; "inf", "-inf" and "nan" too.
///
/// \error  std::invalid_argument naming the text where it is not a numeral as a whole
template <class Real>
Real parse_real(std::string_view text);

template <>
inline real50 parse_real<real50>(std::string_view text) {
    // Boost accepts prefixes and hexadecimal; the grammar is that of from_chars, so let it judge
    double approximation = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, approximation);
    if (error == std::errc::invalid_argument || stop != end)
        throw std::invalid_argument("\"" + std::string(text) + "\" is not a decimal number");
    if (approximation != approximation) return not_a_number<real50>();
    return real50(std::string(text));
}

template <>
inline double parse_real<double>(std::string_view text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc::result_out_of_range) return to_double(parse_real<real50>(text));
    if (error != std::errc() || stop != end)
        throw std::invalid_argument("\"" + std::string(text) + "\" is not a decimal number");
    return value;
}

template <>
inline double_double<double> parse_real<double_double<double>>(std::string_view text) {
    return to_double_double(parse_real<real50>(text));
}

/// A decimal numeral from which parse_real gives the value back: 17 significant digits.
inline std::string print_real(double x) { return to_string(real50(x), 17); }
/// 32 significant digits.
inline std::string print_real(const double_double<double>& x) {
    return to_string(to_real50(x), 32);
}
/// 50 significant digits.
inline std::string print_real(const real50& x) { return to_string(x, 50); }

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
