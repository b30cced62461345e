// What does one elementary function cost per element on each target, next to the C library's?
// Arguments in the first-level cache, one thread; sin_cos gives both and adds them, the same for
// libm.
#include "bench/elementary.hpp"
#include "bench/report.hpp"
#include "host/run/backends.hpp"

#include <array>
#include <cmath>
#include <random>

#include <fmt/format.h>

namespace hopscotch::bench {

extern const elementary_functions elementary_scalar;
extern const elementary_functions elementary_avx2;
extern const elementary_functions elementary_avx512;

namespace {

constexpr std::size_t n_elements = 1024;
constexpr int n_passes = 200;
constexpr int n_rounds = 15;

template <class Function>
void over(const double* x, const double* y, double* out, std::size_t n, Function function) {
    for (std::size_t i = 0; i < n; ++i) out[i] = function(x[i], y[i]);
}

const elementary_functions libm{{
    [](const double* x, const double* y, double* out, std::size_t n) {
        over(x, y, out, n, [](double a, double) { return std::sin(a) + std::cos(a); });
    },
    [](const double* x, const double* y, double* out, std::size_t n) {
        over(x, y, out, n, [](double a, double) { return std::exp(a); });
    },
    [](const double* x, const double* y, double* out, std::size_t n) {
        over(x, y, out, n, [](double a, double) { return std::log(a); });
    },
    [](const double* x, const double* y, double* out, std::size_t n) {
        over(x, y, out, n, [](double a, double b) { return std::atan2(a, b); });
    },
    [](const double* x, const double* y, double* out, std::size_t n) {
        over(x, y, out, n, [](double a, double) { return std::cbrt(a); });
    },
}};

struct implementation {
    std::string_view name;
    const elementary_functions* functions;
};

std::vector<implementation> implementations() {
    std::vector<implementation> usable{{"libm", &libm}, {"scalar", &elementary_scalar}};
    if (reason_against(backend::avx2).empty()) usable.push_back({"avx2", &elementary_avx2});
    if (reason_against(backend::avx512).empty()) usable.push_back({"avx512", &elementary_avx512});
    return usable;
}

struct alignas(64) arrays {
    std::array<double, n_elements> x, y, out;
};

/// Arguments that the models meet: angles, rates and lengths of order one to a hundred, of either
/// sign where the function takes them.
void fill(arrays& data, std::string_view function) {
    std::mt19937_64 bits(7);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * std::ldexp(static_cast<double>(bits() >> 11), -53);
    };
    const bool is_positive = function == "log";
    for (double& x : data.x) x = is_positive ? uniform(1e-3, 100.0) : uniform(-50.0, 50.0);
    for (double& y : data.y) y = uniform(-50.0, 50.0);
}

void measure(std::size_t which, const std::vector<implementation>& all) {
    static arrays data;
    fill(data, elementary_names[which]);
    std::vector<std::function<void()>> pieces;
    for (const implementation& each : all) {
        const array_function function = each.functions->table[which];
        pieces.emplace_back([function] {
            for (int pass = 0; pass < n_passes; ++pass) {
                function(data.x.data(), data.y.data(), data.out.data(), n_elements);
            }
        });
    }
    const auto seconds = alternate(pieces, n_rounds);
    constexpr double n_calls = static_cast<double>(n_elements) * n_passes;
    std::string text = fmt::format("{:<8}", elementary_names[which]);
    const double libm_ns = 1e9 * median(seconds.front()) / n_calls;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double ns = 1e9 * median(seconds[i]) / n_calls;
        json_line("elementary")
            .add("function", elementary_names[which])
            .add("implementation", all[i].name)
            .add("ns_per_element", ns)
            .add("times_faster_than_libm", libm_ns / ns)
            .print();
        text += fmt::format("  {} {:6.2f}", all[i].name, ns);
    }
    fmt::print("{}  ns per element\n", text);
}

}  // namespace
}  // namespace hopscotch::bench

int main() {
    using namespace hopscotch::bench;
    stay_on_this_core();
    const auto all = implementations();
    for (std::size_t which = 0; which < std::size(elementary_names); ++which) measure(which, all);
}
