// Roots of event functions over a whole start set: bounds from signs, derivatives from the implicit
// function theorem over those bounds.
#include "analysis/truth/enclosure.hpp"

#include <cmath>
#include <optional>

namespace hopscotch::inline HOPSCOTCH_TARGET {
namespace {

constexpr int most_steps = 200;
constexpr int most_widenings = 60;
constexpr double ulp = 0x1p-52;

/// The function of which a root is enclosed, with its unknown as one more direction.
class root_problem {
public:
    root_problem(enclosure (*value_at)(const void*, const enclosure&), const void* function)
        : value_at_(value_at), function_(function) {}

    bool has_room() const { return unknown_.exists(); }
    enclosure at(double x) const { return at(x, interval::point(x)); }
    enclosure at(double middle, const interval& range) const {
        return value_at_(function_, enclosure::of_unknown(unknown_, middle, range));
    }
    /// The derivative with respect to the unknown.
    interval rate(const enclosure& value) const { return value.slope[unknown_.index()]; }
    int n_outer() const { return static_cast<int>(unknown_.index()); }

private:
    enclosure (*value_at_)(const void*, const enclosure&);
    const void* function_;
    unknown_direction unknown_;
};

struct approximate_root {
    double x;
    double value_size;  // how well the function is known there
    double rate;
};

/// Newton's method at the set's centre, safeguarded by bisection.
std::optional<approximate_root> root_at_centre(const root_problem& problem, double low, double high,
                                               double guess) {
    if (!(low <= high) || !std::isfinite(low) || !std::isfinite(high)) return std::nullopt;
    double x = guess >= low && guess <= high ? guess : low + 0.5 * (high - low);
    double value_size = 0.0;
    double rate = 1.0;
    for (int i = 0; i < most_steps; ++i) {
        const enclosure f = problem.at(x);
        if (f.centre.is_nan() || !f.centre.is_bounded()) return std::nullopt;
        const double value = f.centre.middle();
        rate = problem.rate(f).middle();
        value_size = f.centre.size();
        if (f.centre.holds(0.0)) break;
        (value < 0.0 ? low : high) = x;
        const double newton = x - value / rate;
        const bool is_good = newton > low && newton < high && i % 4 != 3;
        const double next = is_good ? newton : low + 0.5 * (high - low);
        if (next == x || next == low || next == high) break;
        x = next;
    }
    return approximate_root{x, value_size, std::abs(rate)};
}

/// Widens [x - left, x + right] until the function is certainly below zero on its left end and
/// above on its right one, where `part` of an enclosure is looked at.
template <class Part>
std::optional<interval> bounded_by_signs(const root_problem& problem, double x, double left,
                                         double right, const interval& low, const interval& high,
                                         const Part& part) {
    interval bounds;
    bool has_left = false;
    bool has_right = false;
    for (int i = 0; i < most_widenings && !has_left; ++i, left *= 1.5) {
        bounds.low = x - left;
        // the root is not left of its bracket, or the bracket is wrong; inside it the sign decides
        if (bounds.low <= low.low) {
            bounds.low = low.low;
            if (part(problem.at(bounds.low)).low > 0.0) return std::nullopt;
            has_left = true;
        } else if (bounds.low <= high.low) {
            has_left = part(problem.at(bounds.low)).high < 0.0;
        }
    }
    for (int i = 0; i < most_widenings && !has_right; ++i, right *= 1.5) {
        bounds.high = x + right;
        if (bounds.high >= high.high) {
            bounds.high = high.high;
            if (part(problem.at(bounds.high)).high < 0.0) return std::nullopt;
            has_right = true;
        } else if (bounds.high >= low.high) {
            has_right = part(problem.at(bounds.high)).low > 0.0;
        }
    }
    if (!has_left || !has_right || !(bounds.low <= bounds.high)) return std::nullopt;
    // at a multiple root the first widths are those of the bracket: halve them while signs allow
    if (bounds.low == low.low) {
        double closer = 0.5 * (bounds.low + x);
        for (int i = 0; i < most_widenings && part(problem.at(closer)).high < 0.0; ++i) {
            bounds.low = closer;
            closer = 0.5 * (bounds.low + x);
        }
    }
    if (bounds.high == high.high) {
        double closer = 0.5 * (bounds.high + x);
        for (int i = 0; i < most_widenings && part(problem.at(closer)).low > 0.0; ++i) {
            bounds.high = closer;
            closer = 0.5 * (bounds.high + x);
        }
    }
    return bounds;
}

/// Derivatives of the root over its bounds; the bounds shrink once they are known.
enclosure with_derivatives(const root_problem& problem, double x, const interval& at_centre,
                           interval range) {
    enclosure root;
    for (int pass = 0; pass < 2; ++pass) {
        const enclosure f = problem.at(x, range);
        const interval rate = problem.rate(f);
        std::array<interval, most_slopes> slopes{};
        const int n = problem.n_outer();
        bool is_known = !rate.holds(0.0) && rate.is_bounded();
        for (int i = 0; i < n && is_known; ++i) {
            const auto k = static_cast<std::size_t>(i);
            slopes[k] = f.slope[k].is_zero() ? interval{} : -(f.slope[k] / rate);
            is_known = slopes[k].is_bounded();
        }
        if (!is_known) return enclosure::of_range(at_centre, range);
        root = enclosure::of_root(at_centre, range, n, slopes);
        const double width = range.high - range.low;
        if (root.range.high - root.range.low > 0.9 * width || !root.range.holds(x)) break;
        range = root.range;
    }
    return root;
}

/// Nothing is known; where no start needs the root, that does no harm.
enclosure undecided(const enclosure_mask& wanted) {
    if (!wanted.over.can_fail) note_doubt(doubt::event_not_unique);
    return enclosure::of_range(interval::entire(), interval::entire());
}

enclosure solved(const root_problem& problem, const bracket<enclosure>& within,
                 const enclosure& guess, const enclosure_mask& wanted) {
    const interval& low = within.low.range;
    const interval& high = within.high.range;
    if (!problem.has_room() || low.is_nan() || high.is_nan()) return undecided(wanted);
    const auto found =
        root_at_centre(problem, within.low.centre.middle(), within.high.centre.middle(),
                       guess.centre.is_bounded() ? guess.centre.middle() : 0.0);
    if (!found) return undecided(wanted);
    const double least = 4.0 * ulp * std::abs(found->x) + 1e-300;
    const double rate = found->rate > 0.0 ? found->rate : 1.0;
    const double close = 2.0 * found->value_size / rate + least;
    const auto at_centre =
        bounded_by_signs(problem, found->x, close, close, within.low.centre, within.high.centre,
                         [](const enclosure& f) { return f.centre; });
    if (!at_centre) return undecided(wanted);

    const interval over = problem.at(found->x).range;
    if (over.is_nan() || !over.is_bounded()) return undecided(wanted);
    const auto range =
        bounded_by_signs(problem, found->x, 1.02 * std::max(over.high, 0.0) / rate + close,
                         1.02 * std::max(-over.low, 0.0) / rate + close, low, high,
                         [](const enclosure& f) { return f.range; });
    if (!range) return undecided(wanted);
    return with_derivatives(problem, found->x, *at_centre, hull(*range, *at_centre));
}

}  // namespace

bracket<enclosure> first_fall_bracket(enclosure (*value_at)(const void*, const enclosure&),
                                      const void* function, const enclosure& to) {
    constexpr int most_pieces = 2000;
    const root_problem problem(value_at, function);
    const double end = to.range.low;
    double from = 0.0;
    double step = end;
    for (int i = 0; i < most_pieces && problem.has_room() && from < end && end < interval::huge;
         ++i) {
        const double until = std::min(from + step, end);
        if (!(until > from)) break;
        const enclosure f = problem.at(0.5 * (from + until), {from, until});
        if (f.range.low > 0.0) {  // no fall up to here
            from = until;
            step *= 2.0;
            continue;
        }
        const bool falls = problem.rate(f).high < 0.0;
        if (falls && problem.at(until).range.high < 0.0 && problem.at(from).range.low > 0.0) {
            return {enclosure(from), enclosure(until)};
        }
        step *= 0.5;
    }
    note_doubt(doubt::event_not_unique);
}

enclosure enclosed_root_of(enclosure (*value_at)(const void* function, const enclosure& x),
                           const void* function, const bracket<enclosure>& within,
                           const enclosure& guess, const enclosure_mask& wanted) {
    if (!wanted.over.can_hold) return guess;
    const root_problem problem(value_at, function);
    enclosure root = solved(problem, within, guess, wanted);
    root.n_slopes = std::min(root.n_slopes, problem.n_outer());  // its unknown ends here
    return root;
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
