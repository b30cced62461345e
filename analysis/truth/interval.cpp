// Interval operations. The rounding error of a sum, product, quotient or root is known exactly (by
// an error-free transformation), and its sign says which bound has to move by one ulp.
#include "analysis/truth/interval.hpp"

#include "kernels/elementary/elementary.hpp"

#include <cmath>
#include <numbers>

namespace hopscotch::inline HOPSCOTCH_TARGET {
namespace {

constexpr double infinite = interval::huge;
constexpr double largest = std::numeric_limits<double>::max();
constexpr double error_underflows = 1e-280;  // below it an error term may be lost

double down(double rounded, double error) { return error < 0.0 ? just_below(rounded) : rounded; }
double up(double rounded, double error) { return error > 0.0 ? just_above(rounded) : rounded; }

bool is_finite(double x) { return x - x == 0.0; }

/// Bounds of a rounded result with its exact error; overflow leaves the finite side finite.
double lower(double rounded, double error, bool from_finite) {
    if (is_finite(rounded)) return down(rounded, error);
    return from_finite && rounded == infinite ? largest : rounded;
}
double upper(double rounded, double error, bool from_finite) {
    if (is_finite(rounded)) return up(rounded, error);
    return from_finite && rounded == -infinite ? -largest : rounded;
}

double sum_error(double a, double b, double sum) {
    const double virtual_b = sum - a;
    return (a - (sum - virtual_b)) + (b - virtual_b);
}
double sum_below(double a, double b) {
    const double sum = a + b;
    return lower(sum, sum_error(a, b, sum), is_finite(a) && is_finite(b));
}
double sum_above(double a, double b) {
    const double sum = a + b;
    return upper(sum, sum_error(a, b, sum), is_finite(a) && is_finite(b));
}

double product_below(double a, double b) {
    const double product = a * b;
    if (a == 0.0 || b == 0.0) return product;
    if (std::abs(product) < error_underflows) return just_below(product);
    return lower(product, std::fma(a, b, -product), is_finite(a) && is_finite(b));
}
double product_above(double a, double b) { return -product_below(-a, b); }

double quotient_below(double a, double b) {
    const double quotient = a / b;
    if (a == 0.0 || !is_finite(a) || !is_finite(b)) return quotient;
    if (std::abs(quotient) < error_underflows || std::abs(a) < error_underflows) {
        return just_below(quotient);
    }
    const double rest = std::fma(-quotient, b, a);  // a - q b: the error is rest / b
    return lower(quotient, b > 0.0 ? rest : -rest, true);
}
double quotient_above(double a, double b) { return -quotient_below(-a, b); }

/// NaN bounds: not a number if an operand was none, else nothing is known.
interval checked(double low, double high, const interval& a, const interval& b) {
    if (low == low && high == high) return {low, high};
    return a.is_nan() || b.is_nan() ? interval::nan() : interval::entire();
}

/// Two ulps: more than the stated error of every elementary function.
double widened_down(double x) { return just_below(just_below(x)); }
double widened_up(double x) { return just_above(just_above(x)); }

template <class Function>
interval rising(const interval& x, const Function& f) {
    if (x.is_nan()) return x;
    const double low = f(x.low);
    const double high = f(x.high);
    if (low != low || high != high) return interval::entire();
    return {widened_down(low), widened_up(high)};
}

/// Restricts a function to [lowest, highest]: outside it is not a number.
template <class Function>
interval rising_within(const interval& x, double lowest, double highest, const Function& f) {
    if (x.is_nan() || x.high < lowest || x.low > highest) return interval::nan();
    if (x.low < lowest || x.high > highest) return interval::entire();
    return rising(x, f);
}

/// Is one of the points offset + n period inside x, or too near its ends to tell?
bool meets(const interval& x, double offset, double period) {
    const double margin = 1e-14 * (1.0 + x.size() / period);
    const double first = std::ceil((x.low - offset) / period - margin);
    const double last = std::floor((x.high - offset) / period + margin);
    return first <= last;
}

constexpr double pi_near = std::numbers::pi;
constexpr double farthest_angle = 1e9;  // reduction stays far more precise than `margin` up to here

}  // namespace

interval operator+(const interval& a, const interval& b) {
    return checked(sum_below(a.low, b.low), sum_above(a.high, b.high), a, b);
}
interval operator-(const interval& a) { return {-a.high, -a.low}; }
interval operator-(const interval& a, const interval& b) { return a + (-b); }

interval operator*(const interval& a, const interval& b) {
    if (a.is_nan() || b.is_nan()) return interval::nan();
    if (!a.is_bounded() || !b.is_bounded()) {
        const double sum = a.low * b.low + a.low * b.high + a.high * b.low + a.high * b.high;
        if (sum != sum) return interval::entire();  // 0 infinity, or both signs of it
    }
    // which bounds meet is decided by signs
    if (a.low >= 0.0) {
        if (b.low >= 0.0) return {product_below(a.low, b.low), product_above(a.high, b.high)};
        if (b.high <= 0.0) return {product_below(a.high, b.low), product_above(a.low, b.high)};
        return {product_below(a.high, b.low), product_above(a.high, b.high)};
    }
    if (a.high <= 0.0) {
        if (b.low >= 0.0) return {product_below(a.low, b.high), product_above(a.high, b.low)};
        if (b.high <= 0.0) return {product_below(a.high, b.high), product_above(a.low, b.low)};
        return {product_below(a.low, b.high), product_above(a.low, b.low)};
    }
    if (b.low >= 0.0) return {product_below(a.low, b.high), product_above(a.high, b.high)};
    if (b.high <= 0.0) return {product_below(a.high, b.low), product_above(a.low, b.low)};
    return {std::min(product_below(a.low, b.high), product_below(a.high, b.low)),
            std::max(product_above(a.low, b.low), product_above(a.high, b.high))};
}

interval operator/(const interval& a, const interval& b) {
    if (a.is_nan() || b.is_nan()) return interval::nan();
    if (b.holds(0.0)) {
        // one-sided: only one infinity can come out
        const bool has_sign = a.low > 0.0 || a.high < 0.0;
        if (!has_sign || b.is_zero() || (b.low < 0.0 && b.high > 0.0)) return interval::entire();
        const double nearest = a.low > 0.0 ? a.low : a.high;
        const double farthest = b.low == 0.0 ? b.high : b.low;
        if ((nearest > 0.0) == (farthest > 0.0))
            return {quotient_below(nearest, farthest), infinite};
        return {-infinite, quotient_above(nearest, farthest)};
    }
    const double low = std::min({quotient_below(a.low, b.low), quotient_below(a.low, b.high),
                                 quotient_below(a.high, b.low), quotient_below(a.high, b.high)});
    const double high = std::max({quotient_above(a.low, b.low), quotient_above(a.low, b.high),
                                  quotient_above(a.high, b.low), quotient_above(a.high, b.high)});
    const bool is_doubtful = !a.is_bounded() && !b.is_bounded();  // infinity / infinity
    return is_doubtful ? interval::entire() : checked(low, high, a, b);
}

interval abs(const interval& a) {
    if (a.is_nan() || a.low >= 0.0) return a;
    if (a.high <= 0.0) return -a;
    return {0.0, a.size()};
}

interval square(const interval& a) {
    const interval size = abs(a);
    if (size.is_nan()) return size;
    return {product_below(size.low, size.low), product_above(size.high, size.high)};
}

interval sqrt(const interval& a) {
    if (a.is_nan() || a.high < 0.0) return interval::nan();
    if (a.low < 0.0) return interval::entire();
    const auto residual = [](double x, double root) {
        return is_finite(x) && x > error_underflows ? std::fma(-root, root, x) : 0.0;
    };
    const double low = std::sqrt(a.low);
    const double high = std::sqrt(a.high);
    const bool low_is_tiny = a.low > 0.0 && a.low <= error_underflows;
    const bool high_is_tiny = a.high > 0.0 && a.high <= error_underflows;
    return {low_is_tiny ? just_below(low) : down(low, residual(a.low, low)),
            high_is_tiny ? just_above(high) : up(high, residual(a.high, high))};
}

interval hull(const interval& a, const interval& b) {
    if (a.is_nan() && b.is_nan()) return a;
    if (a.is_nan() || b.is_nan()) return interval::entire();
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

interval product_of_slopes(const interval& a, const interval& slope) {
    if (a.is_zero() || slope.is_zero()) return {};
    if (a.is_nan() || slope.is_nan() || a.is_entire() || slope.is_entire()) {
        return interval::entire();
    }
    return a * slope;
}

interval sin(const interval& x) {
    if (x.is_nan()) return x;
    if (x.is_zero()) return x;
    if (!(x.size() < farthest_angle)) return {-1.0, 1.0};
    const double at_low = hopscotch::sin(x.low);
    const double at_high = hopscotch::sin(x.high);
    const bool has_top = meets(x, 0.5 * pi_near, 2.0 * pi_near);
    const bool has_bottom = meets(x, -0.5 * pi_near, 2.0 * pi_near);
    const double low = has_bottom ? -1.0 : widened_down(std::min(at_low, at_high));
    const double high = has_top ? 1.0 : widened_up(std::max(at_low, at_high));
    return {std::max(low, -1.0), std::min(high, 1.0)};
}

interval cos(const interval& x) {
    if (x.is_nan()) return x;
    if (x.is_zero()) return interval::point(1.0);
    if (!(x.size() < farthest_angle)) return {-1.0, 1.0};
    const double at_low = hopscotch::cos(x.low);
    const double at_high = hopscotch::cos(x.high);
    const bool has_top = meets(x, 0.0, 2.0 * pi_near);
    const bool has_bottom = meets(x, pi_near, 2.0 * pi_near);
    const double low = has_bottom ? -1.0 : widened_down(std::min(at_low, at_high));
    const double high = has_top ? 1.0 : widened_up(std::max(at_low, at_high));
    return {std::max(low, -1.0), std::min(high, 1.0)};
}

interval tan(const interval& x) {
    if (x.is_nan()) return x;
    if (!(x.size() < farthest_angle) || meets(x, 0.5 * pi_near, pi_near)) return interval::entire();
    return rising(x, [](double t) { return hopscotch::tan(t); });
}

interval exp(const interval& x) {
    if (x.is_zero()) return interval::point(1.0);
    const interval e = rising(x, [](double t) { return hopscotch::exp(t); });
    return {std::max(e.low, 0.0), e.high};
}
interval expm1(const interval& x) {
    if (x.is_zero()) return x;
    const interval e = rising(x, [](double t) { return hopscotch::expm1(t); });
    return {std::max(e.low, -1.0), e.high};
}
interval log(const interval& x) {
    if (x.low == 1.0 && x.high == 1.0) return {};
    return rising_within(x, 0.0, infinite, [](double t) { return hopscotch::log(t); });
}
interval log1p(const interval& x) {
    if (x.is_zero()) return x;
    return rising_within(x, -1.0, infinite, [](double t) { return hopscotch::log1p(t); });
}
interval atan(const interval& x) {
    if (x.is_zero()) return x;
    return rising(x, [](double t) { return hopscotch::atan(t); });
}

interval atan2(const interval& y, const interval& x) {
    if (y.is_nan() || x.is_nan()) return interval::nan();
    const bool meets_axis = y.low <= 0.0 && y.high >= 0.0 && !y.is_point();
    const bool holds_origin = y.holds(0.0) && x.holds(0.0);
    constexpr double turn = 3.1415926535897936;  // above pi
    if ((meets_axis && x.low < 0.0 && !(y.low == 0.0 && !std::signbit(y.low))) ||
        (holds_origin && !(x.is_point() && y.is_point()))) {
        return {-turn, turn};
    }
    // on every edge of the box the angle is monotone, and inside it has no extremum
    const double a = hopscotch::atan2(y.low, x.low);
    const double b = hopscotch::atan2(y.low, x.high);
    const double c = hopscotch::atan2(y.high, x.low);
    const double d = hopscotch::atan2(y.high, x.high);
    const double low = std::min({a, b, c, d});
    const double high = std::max({a, b, c, d});
    return {low == 0.0 ? low : widened_down(low), high == 0.0 ? high : widened_up(high)};
}

interval asin(const interval& x) {
    return rising_within(x, -1.0, 1.0, [](double t) { return hopscotch::asin(t); });
}
interval acos(const interval& x) {
    return -rising_within(x, -1.0, 1.0, [](double t) { return -hopscotch::acos(t); });
}
interval sinh(const interval& x) {
    if (x.is_zero()) return x;
    return rising(x, [](double t) { return hopscotch::sinh(t); });
}
interval cosh(const interval& x) {
    const interval c = rising(abs(x), [](double t) { return hopscotch::cosh(t); });
    return {std::max(c.low, 1.0), c.high};
}
interval tanh(const interval& x) {
    if (x.is_zero()) return x;
    return rising(x, [](double t) { return hopscotch::tanh(t); });
}
interval asinh(const interval& x) {
    if (x.is_zero()) return x;
    return rising(x, [](double t) { return hopscotch::asinh(t); });
}
interval atanh(const interval& x) {
    if (x.is_zero()) return x;
    return rising_within(x, -1.0, 1.0, [](double t) { return hopscotch::atanh(t); });
}
interval cbrt(const interval& x) {
    if (x.is_zero()) return x;
    return rising(x, [](double t) { return hopscotch::cbrt(t); });
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
