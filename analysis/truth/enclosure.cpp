// Mean-value arithmetic over a start set. Every operation computes centre, range and slopes from
// those of its operands, then cuts the range down to what centre and slopes allow.
#include "analysis/truth/enclosure.hpp"

#include "kernels/elementary/elementary.hpp"

#include <cmath>

namespace hopscotch::inline HOPSCOTCH_TARGET {
namespace {

struct thread_context {
    start_set set;
    int undecided_loops = 0;  // how often a loop or guard went on because it might have to
};
thread_local thread_context context;

constexpr int most_undecided = 2000;

/// Ends the orbit: nothing that follows could prove anything.
[[noreturn]] void raise(doubt reason) { throw doubtful{reason}; }

/// Bound of |slopes . v| over the start set.
double deviation(const enclosure& x) {
    const start_set& set = context.set;
    double square = 0.0;
    double sum = 0.0;
    for (int i = 0; i < x.n_slopes; ++i) {
        const interval& slope = x.slope[static_cast<std::size_t>(i)];
        if (slope.is_zero()) continue;
        const double size = slope.size();
        if (!(size < interval::huge)) return interval::huge;
        if (set.is_ball && i < set.n_columns) {
            square = just_above(square + just_above(size * size));
        } else {
            const double reach = set.reach[static_cast<std::size_t>(i)];
            sum = just_above(sum + just_above(size * reach));
        }
    }
    if (square > 0.0)
        sum = just_above(sum + just_above(just_above(std::sqrt(square)) * set.radius));
    return sum;
}

/// Drops trailing zero slopes and cuts the range down to the mean-value form.
enclosure& settle(enclosure& x) {
    while (x.n_slopes > 0 && x.slope[static_cast<std::size_t>(x.n_slopes - 1)].is_zero()) {
        --x.n_slopes;
    }
    if (x.centre.is_nan() || x.range.is_nan()) return x;
    const double reach = deviation(x);
    if (!(reach < interval::huge)) return x;
    const interval mean = x.centre + interval{-reach, reach};
    const interval cut{std::max(mean.low, x.range.low), std::min(mean.high, x.range.high)};
    if (cut.low <= cut.high) {
        x.range = cut;
    } else {
        raise(doubt::inconsistent);  // cannot happen: both hold the value
    }
    return x;
}

template <class Slope>
enclosure with_slopes(const interval& centre, const interval& range, int n, const Slope& slope) {
    enclosure result;
    result.centre = centre;
    result.range = range;
    result.n_slopes = n;
    for (int i = 0; i < n; ++i) result.slope[static_cast<std::size_t>(i)] = slope(i);
    return settle(result);
}

const interval& slope_of(const enclosure& x, int i) { return x.slope[static_cast<std::size_t>(i)]; }

/// f(x) from its values and the derivative over the range.
enclosure chain(const enclosure& x, const interval& centre, const interval& range,
                const interval& derivative) {
    return with_slopes(centre, range, x.n_slopes,
                       [&](int i) { return product_of_slopes(derivative, slope_of(x, i)); });
}

/// Range known, how it depends on the start not.
enclosure without_slopes(const interval& centre, const interval& range) {
    enclosure result;
    result.centre = centre;
    result.range = range;
    if (range.is_point() || range.is_nan()) return result;
    result.n_slopes = context.set.n;
    for (int i = 0; i < result.n_slopes; ++i) {
        result.slope[static_cast<std::size_t>(i)] = interval::entire();
    }
    return result;
}

bool is_same(const interval& a, const interval& b) { return a.low == b.low && a.high == b.high; }
bool is_same(const enclosure& a, const enclosure& b) {
    if (&a == &b) return true;
    if (!is_same(a.centre, b.centre) || !is_same(a.range, b.range)) return false;
    if (a.n_slopes != b.n_slopes) return false;
    for (int i = 0; i < a.n_slopes; ++i) {
        if (!is_same(slope_of(a, i), slope_of(b, i))) return false;
        if (!slope_of(a, i).is_bounded()) return false;
    }
    return a.is_constant() ? a.range.is_point() : false;
}

possibility certain(bool holds) { return {holds, !holds}; }
constexpr possibility either{true, true};

/// a < b (or a <= b) of intervals that are not correlated.
possibility less(const interval& a, const interval& b, bool or_equal) {
    if (a.is_nan() || b.is_nan()) return certain(false);
    if (or_equal ? a.high <= b.low : a.high < b.low) return certain(true);
    if (or_equal ? a.low > b.high : a.low >= b.high) return certain(false);
    return either;
}

enclosure_mask compare(const enclosure& a, const enclosure& b, bool or_equal) {
    if (&a == &b) return enclosure_mask(or_equal && !a.range.is_nan());
    const possibility centre = less(a.centre, b.centre, or_equal);
    possibility over = less(a.range, b.range, or_equal);
    if (!over.is_certain() && (!a.is_constant() || !b.is_constant())) {
        const enclosure difference = a - b;  // what both share cancels
        over = less(difference.range, interval::point(0.0), or_equal);
    }
    if (over.is_certain()) return {over, over};
    return {over, centre};
}

}  // namespace

enclosing::enclosing(const start_set& set) {
    context = {};
    context.set = set;
    context.set.n = set.n_columns;
}
enclosing::~enclosing() { context = {}; }

void note_doubt(doubt reason) { raise(reason); }

unknown_direction::unknown_direction()
    : index_(static_cast<std::size_t>(context.set.n)), exists_(context.set.n < most_slopes) {
    if (exists_) ++context.set.n;
}
unknown_direction::~unknown_direction() {
    if (exists_) --context.set.n;
}

enclosure_mask operator&(const enclosure_mask& a, const enclosure_mask& b) {
    const auto both = [](const possibility& x, const possibility& y) {
        return possibility{x.can_hold && y.can_hold, x.can_fail || y.can_fail};
    };
    return {both(a.over, b.over), both(a.centre, b.centre)};
}
enclosure_mask operator!(const enclosure_mask& a) {
    return {{a.over.can_fail, a.over.can_hold}, {a.centre.can_fail, a.centre.can_hold}};
}
enclosure_mask operator|(const enclosure_mask& a, const enclosure_mask& b) { return !(!a & !b); }
bool any(const enclosure_mask& a) {
    if (a.over.is_certain()) return a.over.can_hold;
    if (++context.undecided_loops > most_undecided) raise(doubt::endless);
    return true;
}
bool all(const enclosure_mask& a) { return !any(!a); }

enclosure enclosure::of_start(const interval& value, const double* slopes) {
    const int n = context.set.n_columns;
    return with_slopes(value, interval::entire(), n,
                       [&](int i) { return interval::point(slopes[i]); });
}
enclosure enclosure::of_range(const interval& centre, const interval& range) {
    return without_slopes(centre, range);
}
enclosure enclosure::of_unknown(const unknown_direction& direction, double middle,
                                const interval& range) {
    const std::size_t k = direction.index();
    context.set.reach[k] =
        std::max(just_above(range.high - middle), just_above(middle - range.low));
    if (range.is_point()) context.set.reach[k] = 0.0;
    enclosure x;
    x.centre = interval::point(middle);
    x.range = range;
    x.n_slopes = static_cast<int>(k) + 1;
    x.slope[k] = interval::point(1.0);
    return x;
}
enclosure enclosure::of_root(const interval& centre, const interval& range, int n_slopes,
                             const std::array<interval, most_slopes>& slopes) {
    return with_slopes(centre, range, n_slopes,
                       [&](int i) { return slopes[static_cast<std::size_t>(i)]; });
}

enclosure operator+(const enclosure& a, const enclosure& b) {
    return with_slopes(a.centre + b.centre, a.range + b.range, std::max(a.n_slopes, b.n_slopes),
                       [&](int i) { return slope_of(a, i) + slope_of(b, i); });
}
enclosure operator-(const enclosure& a) {
    return with_slopes(-a.centre, -a.range, a.n_slopes, [&](int i) { return -slope_of(a, i); });
}
enclosure operator-(const enclosure& a, const enclosure& b) {
    // x - x is how models ask whether x is finite
    if (&a == &b && a.range.is_bounded()) return enclosure(0.0);
    return with_slopes(a.centre - b.centre, a.range - b.range, std::max(a.n_slopes, b.n_slopes),
                       [&](int i) { return slope_of(a, i) - slope_of(b, i); });
}
enclosure operator*(const enclosure& a, const enclosure& b) {
    if (&a == &b) {
        return chain(a, square(a.centre), square(a.range), interval::point(2.0) * a.range);
    }
    return with_slopes(a.centre * b.centre, a.range * b.range, std::max(a.n_slopes, b.n_slopes),
                       [&](int i) {
                           return product_of_slopes(a.range, slope_of(b, i)) +
                                  product_of_slopes(b.range, slope_of(a, i));
                       });
}
enclosure operator/(const enclosure& a, const enclosure& b) {
    const interval quotient = a.range / b.range;
    if (b.range.holds(0.0)) return without_slopes(a.centre / b.centre, quotient);
    const interval inverse = interval::point(1.0) / b.range;
    enclosure result =
        with_slopes(a.centre / b.centre, quotient, std::max(a.n_slopes, b.n_slopes), [&](int i) {
            const interval rest = slope_of(a, i) - product_of_slopes(quotient, slope_of(b, i));
            return product_of_slopes(inverse, rest);
        });
    return result;
}
enclosure fma(const enclosure& a, const enclosure& b, const enclosure& c) { return a * b + c; }

enclosure_mask operator<(const enclosure& a, const enclosure& b) { return compare(a, b, false); }
enclosure_mask operator<=(const enclosure& a, const enclosure& b) { return compare(a, b, true); }
enclosure_mask operator==(const enclosure& a, const enclosure& b) {
    if (&a == &b && !a.range.is_nan()) return enclosure_mask(true);
    if (a.range.is_point() && b.range.is_point()) return enclosure_mask(a.range.low == b.range.low);
    return (a <= b) & (b <= a);
}

enclosure sqrt(const enclosure& x) {
    const interval root = sqrt(x.range);
    return chain(x, sqrt(x.centre), root, interval::point(0.5) / root);
}
enclosure abs(const enclosure& x) {
    if (x.range.low >= 0.0) return x;
    if (x.range.high <= 0.0) return -x;
    return chain(x, abs(x.centre), abs(x.range), {-1.0, 1.0});
}

namespace {
template <class Function>
enclosure step_function(const enclosure& x, const Function& f) {
    if (x.range.is_nan()) return x;
    const auto over = [&](const interval& i) { return interval{f(i.low), f(i.high)}; };
    return without_slopes(over(x.centre), over(x.range));
}
}  // namespace
enclosure floor(const enclosure& x) {
    return step_function(x, [](double t) { return std::floor(t); });
}
enclosure nearest(const enclosure& x) {
    return step_function(x, [](double t) { return std::nearbyint(t); });
}

enclosure copysign(const enclosure& magnitude, const enclosure& sign) {
    const auto sign_of = [](const interval& x) {
        const bool low = std::signbit(x.low);
        const bool high = std::signbit(x.high);
        return low == high ? certain(low) : either;
    };
    const enclosure size = abs(magnitude);
    return select(enclosure_mask(sign_of(sign.range), sign_of(sign.centre)), -size, size);
}

namespace {
/// What select knows where the set takes both branches.
enclosure both_branches(const enclosure_mask& condition, const enclosure& yes, const enclosure& no,
                        bool is_continuous) {
    const possibility& centre = condition.centre;
    const interval at_centre = !centre.can_fail   ? yes.centre
                               : !centre.can_hold ? no.centre
                                                  : hull(yes.centre, no.centre);
    const interval range = hull(yes.range, no.range);
    if (!is_continuous) return without_slopes(at_centre, range);
    return with_slopes(at_centre, range, std::max(yes.n_slopes, no.n_slopes),
                       [&](int i) { return hull(slope_of(yes, i), slope_of(no, i)); });
}
}  // namespace

enclosure select(const enclosure_mask& condition, const enclosure& yes, const enclosure& no) {
    if (!condition.over.can_fail) return yes;
    if (!condition.over.can_hold) return no;
    if (is_same(yes, no)) return yes;
    return both_branches(condition, yes, no, false);
}
enclosure select_form(const enclosure_mask& condition, const enclosure& yes, const enclosure& no) {
    if (!condition.over.can_fail) return yes;
    if (!condition.over.can_hold) return no;
    return both_branches(condition, yes, no, true);
}
enclosure chained_slope(const enclosure& derivative, const enclosure& slope) {
    return slope.range.is_zero() ? enclosure(0.0) : derivative * slope;
}
enclosure negate_where(const enclosure_mask& condition, const enclosure& x) {
    return select(condition, -x, x);
}
enclosure larger(const enclosure& a, const enclosure& b) {
    enclosure result = select_form(a < b, b, a);
    result.range.low = std::max(result.range.low, std::max(a.range.low, b.range.low));
    return result;
}
enclosure smaller(const enclosure& a, const enclosure& b) {
    enclosure result = select_form(b < a, b, a);
    result.range.high = std::min(result.range.high, std::min(a.range.high, b.range.high));
    return result;
}

enclosure mathematical_constants<enclosure>::pi() {
    enclosure x;
    x.centre = x.range = {0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1};
    return x;
}
enclosure mathematical_constants<enclosure>::ln2() {
    enclosure x;
    x.centre = x.range = {0x1.62e42fefa39efp-1, 0x1.62e42fefa39f0p-1};
    return x;
}
enclosure mathematical_constants<enclosure>::sqrt2() {
    enclosure x;
    x.centre = x.range = {0x1.6a09e667f3bccp+0, 0x1.6a09e667f3bcdp+0};
    return x;
}

// ---- elementary functions: values over the range, derivative over the range

namespace {
const interval one = interval::point(1.0);
}

sine_cosine<enclosure> sin_cos(const enclosure& x) {
    const interval sine = sin(x.range);
    const interval cosine = cos(x.range);
    return {chain(x, sin(x.centre), sine, cosine), chain(x, cos(x.centre), cosine, -sine)};
}
enclosure sin(const enclosure& x) { return sin_cos(x).sin; }
enclosure cos(const enclosure& x) { return sin_cos(x).cos; }
enclosure tan(const enclosure& x) {
    const interval value = tan(x.range);
    return chain(x, tan(x.centre), value, one + square(value));
}
enclosure exp(const enclosure& x) {
    const interval value = exp(x.range);
    return chain(x, exp(x.centre), value, value);
}
enclosure expm1(const enclosure& x) {
    return chain(x, expm1(x.centre), expm1(x.range), exp(x.range));
}
enclosure log(const enclosure& x) { return chain(x, log(x.centre), log(x.range), one / x.range); }
enclosure log1p(const enclosure& x) {
    return chain(x, log1p(x.centre), log1p(x.range), one / (one + x.range));
}
enclosure atan(const enclosure& x) {
    return chain(x, atan(x.centre), atan(x.range), one / (one + square(x.range)));
}
enclosure atan2(const enclosure& y, const enclosure& x) {
    const interval angle = atan2(y.range, x.range);
    const interval centre = atan2(y.centre, x.centre);
    const interval radius = square(x.range) + square(y.range);
    const bool is_cut = angle.low < -3.1415926 && angle.high > 3.1415926;
    if (radius.holds(0.0) || is_cut) return without_slopes(centre, angle);
    const interval along = x.range / radius;
    const interval across = -y.range / radius;
    return with_slopes(centre, angle, std::max(x.n_slopes, y.n_slopes), [&](int i) {
        return product_of_slopes(along, slope_of(y, i)) + product_of_slopes(across, slope_of(x, i));
    });
}
enclosure asin(const enclosure& x) {
    return chain(x, asin(x.centre), asin(x.range), one / sqrt(one - square(x.range)));
}
enclosure acos(const enclosure& x) {
    return chain(x, acos(x.centre), acos(x.range), -one / sqrt(one - square(x.range)));
}
enclosure sinh(const enclosure& x) {
    return chain(x, sinh(x.centre), sinh(x.range), cosh(x.range));
}
enclosure cosh(const enclosure& x) {
    return chain(x, cosh(x.centre), cosh(x.range), sinh(x.range));
}
enclosure tanh(const enclosure& x) {
    return chain(x, tanh(x.centre), tanh(x.range), one / square(cosh(x.range)));
}
enclosure asinh(const enclosure& x) {
    return chain(x, asinh(x.centre), asinh(x.range), one / sqrt(one + square(x.range)));
}
enclosure atanh(const enclosure& x) {
    return chain(x, atanh(x.centre), atanh(x.range), one / (one - square(x.range)));
}
enclosure cbrt(const enclosure& x) {
    const interval root = cbrt(x.range);
    return chain(x, cbrt(x.centre), root, one / (interval::point(3.0) * square(root)));
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
