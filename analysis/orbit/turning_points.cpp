// Recursive halving over Chebyshev interpolants of the gap's rate.
#include "analysis/orbit/turning_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hopscotch {
namespace {

constexpr int degree = 16;
constexpr int n_nodes = degree + 1;
constexpr double resolution = 1e-11;  // of the largest rate
constexpr int most_halvings = 48;
constexpr double end_margin = 1e-9;  // of the phase
using coefficients = std::array<double, n_nodes>;

/// cos(pi i / degree).
const std::array<double, 2 * degree>& cosines() {
    static const auto table = [] {
        std::array<double, 2 * degree> made{};
        for (int i = 0; i < 2 * degree; ++i) made[std::size_t(i)] = std::cos(M_PI * i / degree);
        return made;
    }();
    return table;
}

/// Of the polynomial through values at the nodes cos(pi j / degree).
coefficients interpolated(const coefficients& values) {
    coefficients result{};
    for (int k = 0; k <= degree; ++k) {
        double sum = 0.5 * (values[0] + (k % 2 == 0 ? values[degree] : -values[degree]));
        for (int j = 1; j < degree; ++j) {
            sum += values[std::size_t(j)] * cosines()[std::size_t(j * k % (2 * degree))];
        }
        result[std::size_t(k)] = sum * (k == 0 || k == degree ? 1.0 : 2.0) / degree;
    }
    return result;
}

coefficients derived(const coefficients& c) {
    coefficients d{};
    for (int k = degree; k >= 1; --k) {
        const double after = k + 1 <= degree - 1 ? d[std::size_t(k + 1)] : 0.0;
        d[std::size_t(k - 1)] = after + 2.0 * k * c[std::size_t(k)];
    }
    d[0] *= 0.5;
    return d;
}

/// The constant term outweighs all others: no zero on the part.
bool has_no_zero(const coefficients& c, double error) {
    double others = error;
    for (int k = 1; k <= degree; ++k) others += std::fabs(c[std::size_t(k)]);
    return std::fabs(c[0]) > others;
}

/// A rate of exactly zero counts as rising, at whichever end of a part it is met.
int sign_of(double rate) { return rate >= 0.0 ? 1 : -1; }

class rate_search {
public:
    rate_search(const std::function<contact_gap(double)>& gap, std::vector<turning_point>& found)
        : gap_(gap), found_(found) {}

    void search(double from, double to, int halvings = most_halvings) {
        coefficients values;
        for (int j = 0; j <= degree; ++j) {
            const double at = 0.5 * (from + to + (to - from) * cosines()[std::size_t(j)]);
            values[std::size_t(j)] = gap_(j == 0 ? to : j == degree ? from : at).rate;
            largest_ = std::max(largest_, std::fabs(values[std::size_t(j)]));
        }
        const coefficients c = interpolated(values);
        const double error = resolution * largest_;
        const bool is_resolved = std::fabs(c[degree]) + std::fabs(c[degree - 1]) <= error;
        if (is_resolved && has_no_zero(c, error)) return;
        const bool is_monotone = is_resolved && has_no_zero(derived(c), degree * degree * error);
        if (is_monotone || halvings == 0) {
            return bracket(from, to, sign_of(values[degree]), sign_of(values[0]));
        }
        const double middle = 0.5 * (from + to);
        search(from, middle, halvings - 1);
        search(middle, to, halvings - 1);
    }

private:
    void bracket(double low, double high, int sign_low, int sign_high) {
        if (sign_low == sign_high) return;
        while (true) {
            const double middle = 0.5 * (low + high);
            if (middle <= low || middle >= high) break;
            (sign_of(gap_(middle).rate) == sign_low ? low : high) = middle;
        }
        found_.push_back({high, gap_(high).value, sign_low > 0});
    }

    const std::function<contact_gap(double)>& gap_;
    std::vector<turning_point>& found_;
    double largest_ = 0.0;
};

/// The time nearest to an end, by halving steps towards it, at which the gap is open.
double first_open(const std::function<contact_gap(double)>& gap, double end, double inwards,
                  double rounding) {
    for (int halvings = most_halvings; halvings > 0; --halvings) {
        const double at = end + std::ldexp(inwards, -halvings);
        if (gap(at).value > rounding) return halvings == most_halvings ? end : at;
    }
    return end + inwards;
}

}  // namespace

phase_course turning_points(const std::function<contact_gap(double)>& gap, double duration,
                            double rounding) {
    phase_course course;
    const double begin = first_open(gap, 0.0, duration, rounding);
    const double end = first_open(gap, duration, -duration, rounding);
    if (!(begin < end)) return course;
    const double margin = end_margin * (end - begin);
    course.first_sign = sign_of(gap(begin + margin).rate);
    course.last_sign = sign_of(gap(end - margin).rate);
    rate_search(gap, course.turning_points).search(begin, end);
    std::erase_if(course.turning_points, [&](const turning_point& each) {
        return each.time <= begin + margin || each.time >= end - margin;
    });
    return course;
}

}  // namespace hopscotch
