// Times array functions over the first-level cache.
#include "bench/operation_times.hpp"

#include "bench/elementary.hpp"
#include "bench/operations.hpp"
#include "bench/report.hpp"

#include <cmath>
#include <random>

namespace hopscotch::bench {

extern const elementary_functions elementary_scalar;
extern const elementary_functions elementary_avx2;
extern const elementary_functions elementary_avx512;
extern const operation_functions operations_scalar;
extern const operation_functions operations_avx2;
extern const operation_functions operations_avx512;

namespace {

static_assert(n_counted_functions == std::size(elementary_names));

constexpr std::size_t n_elements = 1152;
constexpr int n_passes = 50;
constexpr int n_rounds = 9;

struct alignas(64) arrays {
    std::array<double, n_elements> x, y, out;
};

const elementary_functions& functions_of(backend which) {
    if (which == backend::avx512) return elementary_avx512;
    return which == backend::avx2 ? elementary_avx2 : elementary_scalar;
}

const operation_functions& operations_of(backend which) {
    if (which == backend::avx512) return operations_avx512;
    return which == backend::avx2 ? operations_avx2 : operations_scalar;
}

}  // namespace

double operation_times::costly_floor(const counted_work& work) const {
    double ns = work.outside_divisions * division + work.outside_square_roots * square_root;
    for (std::size_t i = 0; i < functions.size(); ++i) ns += work.functions[i] * functions[i];
    return ns;
}

double operation_times::whole_floor(const counted_work& work) const {
    return costly_floor(work) + work.outside_fused * fused + work.outside_sums * plain +
           0.5 * (work.outside_comparisons + work.outside_selections) * comparison_and_selection +
           work.outside_roundings * rounding;
}

operation_times measure_operations(backend which) {
    static arrays data;
    std::mt19937_64 bits(7);
    // next to 1, so that nothing overflows or becomes denormal
    for (double& x : data.x) x = 1.0 + std::ldexp(static_cast<double>(bits() >> 12), -60);
    for (double& y : data.y) y = std::ldexp(static_cast<double>(bits() >> 12), -60);
    std::vector<std::function<void()>> pieces;
    const auto add = [&](auto function) {
        pieces.emplace_back([function] {
            for (int pass = 0; pass < n_passes; ++pass) {
                function(data.x.data(), data.y.data(), data.out.data(), n_elements);
            }
        });
    };
    for (const operation_function one : operations_of(which).table) add(one);
    for (const array_function one : functions_of(which).table) add(one);
    const auto seconds = alternate(pieces, n_rounds);
    const auto ns = [&](std::size_t piece, int repeats) {
        return 1e9 * quantile(seconds[piece], 0.0) /
               (static_cast<double>(n_elements) * n_passes * repeats);
    };
    operation_times times;
    const auto of = [&](operation one) {
        return ns(static_cast<std::size_t>(one), operation_repeats);
    };
    times.fused = of(operation::fused);
    times.plain = of(operation::plain);
    times.comparison_and_selection = of(operation::comparison_and_selection);
    times.rounding = of(operation::rounding);
    times.division = of(operation::division);
    times.square_root = of(operation::square_root);
    for (std::size_t i = 0; i < times.functions.size(); ++i) {
        times.functions[i] = ns(n_operations + i, 1);
    }
    return times;
}

}  // namespace hopscotch::bench
