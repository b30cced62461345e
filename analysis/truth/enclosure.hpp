// `enclosure`: the arithmetic in which traps are proved. A number that depends on where an orbit
// starts in a set: its value at the set's centre, its values over the whole set and its derivatives
// over the whole set, each as an interval that certainly holds them. A model run in it gives the
// derivative of its return map over a set, not at a point.
//
// Dual numbers over it, dual<enclosure, N>, hold the derivatives in the same form, with bounds of
// the second derivatives: what they have too much falls with the square of the set.
//
// A start is x = centre + B (u0 + v) with v in a ball or a box about 0 (`start_set`). Every number
// is kept in mean-value form: the range is cut down to  value at v = 0 + slopes . v,  so that what
// depends on the same start cancels. Comparisons that differ within the set give masks that are
// neither true nor false; `select` then knows the hull of its branches and no derivative, unless
// the model says by `select_form` that both are the same function.
#pragma once

#include "analysis/truth/interval.hpp"
#include "kernels/contract/info.hpp"
#include "kernels/elementary/constants.hpp"
#include "kernels/elementary/sin_cos.hpp"
#include "kernels/events/bracketed_root.hpp"
#include "kernels/lanes/dual.hpp"

#include <array>
#include <concepts>
#include <cstdint>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// Directions that slopes are kept for: a start's columns, and unknowns of roots within roots.
inline constexpr int most_slopes = most_columns + 2;

/// Where v lies: in the ball of that radius, or in the box of half widths `reach`; for the unknown
/// of a root being enclosed, within `reach` of its middle.
struct start_set {
    int n_columns = 0;
    int n = 0;  // directions in use
    bool is_ball = false;
    double radius = 0.0;
    std::array<double, most_slopes> reach{};
};

/// Why the enclosures of an orbit prove nothing.
enum class doubt : std::uint8_t {
    event_not_unique,  // signs do not bound a root over the whole set
    is_integrated,     // the remainder of an integrator's step is not enclosed
    endless,           // loops that might have to go on
    inconsistent,      // two bounds exclude each other: an error of this program
};

/// Thrown out of a model's functions; whoever runs one in enclosures catches it.
struct doubtful {
    doubt reason;
};

/// Makes a start set current for the thread while it lives.
class enclosing {
public:
    explicit enclosing(const start_set& set);
    ~enclosing();
    enclosing(const enclosing&) = delete;
    enclosing& operator=(const enclosing&) = delete;
};

/// One more direction, for the unknown of a root while it is being enclosed.
class unknown_direction {
public:
    unknown_direction();
    ~unknown_direction();
    unknown_direction(const unknown_direction&) = delete;
    unknown_direction& operator=(const unknown_direction&) = delete;
    bool exists() const { return exists_; }
    std::size_t index() const { return index_; }

private:
    std::size_t index_;
    bool exists_;
};

[[noreturn]] void note_doubt(doubt reason);

/// Neither, either or both of true and false.
struct possibility {
    bool can_hold = false;
    bool can_fail = true;

    constexpr bool is_certain() const { return can_hold != can_fail; }
};

/// The mask of enclosures: a comparison over the whole set and at its centre.
struct enclosure_mask {
    possibility over;
    possibility centre;

    enclosure_mask() = default;
    enclosure_mask(bool holds)  // NOLINT(google-explicit-constructor): masks start from bool
        : over{holds, !holds}, centre{holds, !holds} {}
    enclosure_mask(possibility over_set, possibility at_centre)
        : over(over_set), centre(at_centre) {}

    bool is_certain() const { return over.is_certain(); }
};

enclosure_mask operator&(const enclosure_mask& a, const enclosure_mask& b);
enclosure_mask operator|(const enclosure_mask& a, const enclosure_mask& b);
enclosure_mask operator!(const enclosure_mask& a);
/// True where it may hold: what might be needed is computed.
bool any(const enclosure_mask& a);
bool all(const enclosure_mask& a);

struct enclosure {
    interval centre;  // at v = 0
    interval range;
    int n_slopes = 0;  // the others are zero
    std::array<interval, most_slopes> slope{};

    enclosure() = default;
    enclosure(double x)  // NOLINT(google-explicit-constructor): constants mix with lanes
        : centre(interval::point(x)), range(interval::point(x)) {}
    /// Column i of a start: `value` at v = 0, slopes row i of B.
    static enclosure of_start(const interval& value, const double* slopes);
    /// The unknown of a root, anywhere in `range` about the number `middle`.
    static enclosure of_unknown(const unknown_direction& direction, double middle,
                                const interval& range);
    /// From its parts.
    static enclosure of_root(const interval& centre, const interval& range, int n_slopes,
                             const std::array<interval, most_slopes>& slopes);
    /// The range is known, but not how it depends on the start.
    static enclosure of_range(const interval& centre, const interval& range);

    bool is_constant() const { return n_slopes == 0; }

    friend enclosure operator+(const enclosure& a, const enclosure& b);
    friend enclosure operator-(const enclosure& a, const enclosure& b);
    friend enclosure operator*(const enclosure& a, const enclosure& b);
    friend enclosure operator/(const enclosure& a, const enclosure& b);
    friend enclosure operator-(const enclosure& a);
    enclosure& operator+=(const enclosure& b) { return *this = *this + b; }
    enclosure& operator-=(const enclosure& b) { return *this = *this - b; }
    enclosure& operator*=(const enclosure& b) { return *this = *this * b; }

    friend enclosure_mask operator<(const enclosure& a, const enclosure& b);
    friend enclosure_mask operator<=(const enclosure& a, const enclosure& b);
    friend enclosure_mask operator>(const enclosure& a, const enclosure& b) { return b < a; }
    friend enclosure_mask operator>=(const enclosure& a, const enclosure& b) { return b <= a; }
    friend enclosure_mask operator==(const enclosure& a, const enclosure& b);
};

template <>
struct lane_traits<enclosure> {
    using mask = enclosure_mask;
    using primal = enclosure;  // roots and decisions keep their derivatives
    static constexpr int width = 1;
    static constexpr bool is_binary64 = false;
    static constexpr double rounding = 0x1p-53;
    static constexpr double root_rounding = 0x1p-26;
};

template <>
struct mathematical_constants<enclosure> {
    static enclosure pi();
    static enclosure ln2();
    static enclosure sqrt2();
};

inline enclosure primal(const enclosure& x) { return x; }
inline double to_double(const enclosure& x) { return x.centre.middle(); }

enclosure fma(const enclosure& a, const enclosure& b, const enclosure& c);
enclosure sqrt(const enclosure& x);
enclosure abs(const enclosure& x);
enclosure floor(const enclosure& x);
enclosure nearest(const enclosure& x);
enclosure copysign(const enclosure& magnitude, const enclosure& sign);
enclosure select(const enclosure_mask& condition, const enclosure& yes, const enclosure& no);
enclosure select_form(const enclosure_mask& condition, const enclosure& yes, const enclosure& no);
enclosure chained_slope(const enclosure& derivative, const enclosure& slope);
enclosure negate_where(const enclosure_mask& condition, const enclosure& x);
enclosure larger(const enclosure& a, const enclosure& b);
enclosure smaller(const enclosure& a, const enclosure& b);

template <int N>
dual<enclosure, N> larger(const dual<enclosure, N>& a, const dual<enclosure, N>& b) {
    return dual<enclosure, N>::with_slopes(larger(a.value, b.value), [&](int i) {
        return select(a.value < b.value, b.slope[i], a.slope[i]);
    });
}
template <int N>
dual<enclosure, N> smaller(const dual<enclosure, N>& a, const dual<enclosure, N>& b) {
    return dual<enclosure, N>::with_slopes(smaller(a.value, b.value), [&](int i) {
        return select(b.value < a.value, b.slope[i], a.slope[i]);
    });
}

sine_cosine<enclosure> sin_cos(const enclosure& x);
enclosure sin(const enclosure& x);
enclosure cos(const enclosure& x);
enclosure tan(const enclosure& x);
enclosure exp(const enclosure& x);
enclosure expm1(const enclosure& x);
enclosure log(const enclosure& x);
enclosure log1p(const enclosure& x);
enclosure atan(const enclosure& x);
enclosure atan2(const enclosure& y, const enclosure& x);
enclosure asin(const enclosure& x);
enclosure acos(const enclosure& x);
enclosure sinh(const enclosure& x);
enclosure cosh(const enclosure& x);
enclosure tanh(const enclosure& x);
enclosure asinh(const enclosure& x);
enclosure atanh(const enclosure& x);
enclosure cbrt(const enclosure& x);

/// The root of a rising function over the whole set, with its derivatives.
///
/// \param value_at  the function, in enclosures
/// \error           throws doubt::event_not_unique where its signs to both sides do not hold over
///                  the whole set; the whole line where not every start wants the root
enclosure enclosed_root_of(enclosure (*value_at)(const void* function, const enclosure& x),
                           const void* function, const bracket<enclosure>& within,
                           const enclosure& guess, const enclosure_mask& wanted);

/// What bracketed_root does in this arithmetic. That the bracket holds exactly one root, the
/// model's own claim, makes two signs a proof; a Newton step over the interval between them gives
/// the derivatives.
template <class Function>
enclosure root_by_arithmetic(const Function& rising, const bracket<enclosure>& within,
                             const enclosure& guess, const enclosure_mask& wanted) {
    const auto value_at = [](const void* function, const enclosure& x) -> enclosure {
        return (*static_cast<const Function*>(function))(x).value;
    };
    return enclosed_root_of(value_at, &rising, within, guess, wanted);
}

/// Two times between which a function that is positive at 0 first falls through zero, and does so
/// once, for every start of the set.
///
/// \param to  where the search ends
/// \error     throws doubt::event_not_unique where such times are not found
bracket<enclosure> first_fall_bracket(enclosure (*value_at)(const void* function,
                                                            const enclosure& x),
                                      const void* function, const enclosure& to);

/// (a template in the time, too: no other arithmetic is to convert to this one)
template <class Function, std::same_as<enclosure> Time>
bracket<enclosure> bracket_of_first_fall(const Function& falling, const Time& to,
                                         const enclosure_mask& /*wanted*/) {
    const auto value_at = [](const void* function, const enclosure& x) -> enclosure {
        return (*static_cast<const Function*>(function))(x).value;
    };
    return first_fall_bracket(value_at, &falling, to);
}

/// A step of an integrator leaves a remainder that these enclosures do not hold.
template <std::same_as<enclosure> Real>
void note_truncation(const Real&) {
    note_doubt(doubt::is_integrated);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
