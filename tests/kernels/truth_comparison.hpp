// Arguments and error measures shared by the arithmetic tests: everything is judged by real50.
#pragma once

#include "analysis/truth/real50.hpp"
#include "kernels/lanes/scalar.hpp"

#include <cmath>
#include <random>
#include <vector>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// Distance of `got` from `want` in units of the last place of the double next to `want`.
inline double error_in_ulp(double got, const real50& want) {
    const double near = to_double(want);
    if (std::isnan(near) || std::isnan(got))
        return std::isnan(near) && std::isnan(got) ? 0.0 : 1e300;
    if (std::isinf(near) || std::isinf(got)) return near == got ? 0.0 : 1e300;
    int binary_exponent = 0;
    std::frexp(near, &binary_exponent);
    const real50 ulp(std::ldexp(1.0, binary_exponent > -1021 ? binary_exponent - 53 : -1074));
    return to_double(abs(real50(got) - want) / ulp);
}

/// Reproducible arguments: the generator is fixed, and so is what is drawn from it.
class argument_source {
public:
    double uniform(double lowest, double highest) {
        const double share = std::ldexp(static_cast<double>(bits_() >> 11), -53);
        return lowest + share * (highest - lowest);
    }
    /// Either sign, logarithmically distributed size.
    double magnitude(double smallest, double largest) {
        const double size = std::exp(uniform(std::log(smallest), std::log(largest)));
        return (bits_() & 1) != 0 ? -size : size;
    }
    std::vector<double> dense(double lowest, double highest, int n) {
        std::vector<double> result;
        for (int i = 0; i < n; ++i) result.push_back(uniform(lowest, highest));
        return result;
    }
    std::vector<double> magnitudes(double smallest, double largest, int n) {
        std::vector<double> result;
        for (int i = 0; i < n; ++i) result.push_back(magnitude(smallest, largest));
        return result;
    }

private:
    std::mt19937_64 bits_{20240229};
};

/// The doubles on either side of whole multiples of pi/2, where sine or cosine nearly vanishes.
inline std::vector<double> next_to_quarter_turns(int n, double largest) {
    std::vector<double> result;
    for (int i = 1; i <= n; ++i) {
        const double turns = i <= n / 2 ? i : std::floor(std::pow(largest, 2.0 * i / n - 1.0));
        const double near = to_double(half_pi<real50>() * turns);
        if (near <= largest) result.insert(result.end(), {near, std::nextafter(near, 0.0)});
    }
    return result;
}

/// Largest error in ulp of a generic function object over these arguments.
template <class Function>
double worst_error(const Function& function, const std::vector<double>& arguments) {
    double worst = 0.0;
    for (const double x : arguments) {
        const double error = error_in_ulp(function(x), function(real50(x)));
        if (!(error <= worst)) worst = error;
    }
    return worst;
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
