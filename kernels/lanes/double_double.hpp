// `double_double<T>`: an unevaluated sum of two doubles (or packs) with about 31 decimal digits.
// Audits recompute disputed cells in it. Sums, products, quotients and roots have relative errors
// of a few 2^-106; each is also right for infinities, which the models use for "never".
#pragma once

#include "kernels/elementary/constants.hpp"
#include "kernels/elementary/error_free.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

template <binary64_lane T>
struct double_double {
    T high, low;

    double_double() = default;
    HOPSCOTCH_DEVICE double_double(double x)  // NOLINT(google-explicit-constructor)
        : high(x), low(0.0) {}
    HOPSCOTCH_DEVICE double_double(const T& x)  // NOLINT(google-explicit-constructor)
        requires(!std::same_as<T, double>)
        : high(x), low(0.0) {}
    /// The parts as they are: |low| at most half an ulp of high.
    HOPSCOTCH_DEVICE double_double(const T& high_part, const T& low_part)
        : high(high_part), low(low_part) {}
    HOPSCOTCH_DEVICE explicit double_double(const two_part<T>& x) : high(x.high), low(x.low) {}

    /// `precise` where the plain result is finite, else the plain result.
    HOPSCOTCH_DEVICE static double_double guarded(const T& plain, const two_part<T>& precise) {
        const auto finite = abs(plain) < infinity<T>();
        return {select(finite, precise.high, plain), select(finite, precise.low, T(0.0))};
    }

    /// Relative error below 3 2^-106, cancellation included (Joldes, Muller, Popescu 2017).
    friend HOPSCOTCH_DEVICE double_double operator+(const double_double& a,
                                                    const double_double& b) {
        const two_part<T> highs = two_sum(a.high, b.high);
        const two_part<T> lows = two_sum(a.low, b.low);
        const two_part<T> sum = fast_two_sum(highs.high, highs.low + lows.high);
        return guarded(highs.high, fast_two_sum(sum.high, sum.low + lows.low));
    }
    friend HOPSCOTCH_DEVICE double_double operator-(const double_double& a) {
        return {-a.high, -a.low};
    }
    friend HOPSCOTCH_DEVICE double_double operator-(const double_double& a,
                                                    const double_double& b) {
        return a + (-b);
    }
    friend HOPSCOTCH_DEVICE double_double operator*(const double_double& a,
                                                    const double_double& b) {
        const two_part<T> product = two_product(a.high, b.high);
        const T cross = fma(a.low, b.high, fma(a.high, b.low, a.low * b.low));
        return guarded(product.high, fast_two_sum(product.high, product.low + cross));
    }
    friend HOPSCOTCH_DEVICE double_double operator/(const double_double& a,
                                                    const double_double& b) {
        const T first = a.high / b.high;
        const double_double rest = a - b * double_double(first, T(0.0));
        const T second = rest.high / b.high;
        const double_double left = rest - b * double_double(second, T(0.0));
        const two_part<T> sum = fast_two_sum(first, second);
        const two_part<T> result = fast_two_sum(sum.high, sum.low + left.high / b.high);
        const double_double quotient = guarded(first, result);
        return select(abs(b.high) < infinity<T>(), quotient, double_double(first, T(0.0)));
    }
    HOPSCOTCH_DEVICE double_double& operator+=(const double_double& b) { return *this = *this + b; }
    HOPSCOTCH_DEVICE double_double& operator-=(const double_double& b) { return *this = *this - b; }
    HOPSCOTCH_DEVICE double_double& operator*=(const double_double& b) { return *this = *this * b; }

    friend HOPSCOTCH_DEVICE mask_of<T> operator<(const double_double& a, const double_double& b) {
        return (a.high < b.high) | ((a.high == b.high) & (a.low < b.low));
    }
    friend HOPSCOTCH_DEVICE mask_of<T> operator<=(const double_double& a, const double_double& b) {
        return (a.high < b.high) | ((a.high == b.high) & (a.low <= b.low));
    }
    friend HOPSCOTCH_DEVICE mask_of<T> operator>(const double_double& a, const double_double& b) {
        return b < a;
    }
    friend HOPSCOTCH_DEVICE mask_of<T> operator>=(const double_double& a, const double_double& b) {
        return b <= a;
    }
    friend HOPSCOTCH_DEVICE mask_of<T> operator==(const double_double& a, const double_double& b) {
        return (a.high == b.high) & (a.low == b.low);
    }

    /// Not rounded once: the error is that of a product and a sum.
    friend HOPSCOTCH_DEVICE double_double fma(const double_double& a, const double_double& b,
                                              const double_double& c) {
        return a * b + c;
    }
    friend HOPSCOTCH_DEVICE double_double sqrt(const double_double& x) {
        const T root = sqrt(x.high);
        const double_double square(two_product(root, root));
        const T correction = (x - square).high / (root + root);
        const auto ordinary = (root > T(0.0)) & (root < infinity<T>());
        return select(ordinary, double_double(fast_two_sum(root, correction)),
                      double_double(root, T(0.0)));
    }
    friend HOPSCOTCH_DEVICE double_double select(const mask_of<T>& condition,
                                                 const double_double& yes,
                                                 const double_double& no) {
        return {select(condition, yes.high, no.high), select(condition, yes.low, no.low)};
    }
    friend HOPSCOTCH_DEVICE double_double negate_where(const mask_of<T>& condition,
                                                       const double_double& x) {
        return {negate_where(condition, x.high), negate_where(condition, x.low)};
    }
    friend HOPSCOTCH_DEVICE double_double abs(const double_double& x) {
        return negate_where(copysign(T(1.0), x.high) < T(0.0), x);
    }
    friend HOPSCOTCH_DEVICE double_double copysign(const double_double& magnitude,
                                                   const double_double& sign) {
        return negate_where(copysign(T(1.0), sign.high) < T(0.0), abs(magnitude));
    }
    friend HOPSCOTCH_DEVICE double_double floor(const double_double& x) {
        const T whole = floor(x.high);
        const T low = select(whole == x.high, floor(x.low), T(0.0));
        return guarded(whole, fast_two_sum(whole, low));
    }
    /// Nearest integer; a tie goes to the even one below 2^52 and may go either way above.
    friend HOPSCOTCH_DEVICE double_double nearest(const double_double& x) {
        const T whole = nearest(x.high);
        const T offset = x.high - whole;
        const T up = select((offset == T(0.5)) & (x.low > T(0.0)), T(1.0), T(0.0));
        const T down = select((offset == T(-0.5)) & (x.low < T(0.0)), T(-1.0), T(0.0));
        const T low = select(whole == x.high, nearest(x.low), up + down);
        return guarded(whole, fast_two_sum(whole, low));
    }
    friend HOPSCOTCH_DEVICE double_double primal(const double_double& x) { return x; }
    /// The nearest double.
    friend HOPSCOTCH_DEVICE T to_double(const double_double& x) { return x.high; }
};

template <class T>
struct lane_traits<double_double<T>> {
    using mask = mask_of<T>;
    using primal = double_double<T>;
    static constexpr int width = width_of<T>;
    static constexpr bool is_binary64 = false;
    static constexpr double rounding = 0x1p-104;
    static constexpr double root_rounding = 0x1p-52;
};

template <class T>
struct mathematical_constants<double_double<T>> {
    using type = double_double<T>;
    HOPSCOTCH_DEVICE static type pi() {
        return {T(0x1.921fb54442d18p+1), T(0x1.1a62633145c07p-53)};
    }
    HOPSCOTCH_DEVICE static type ln2() { return {T(ln2_parts::high), T(ln2_parts::low)}; }
    HOPSCOTCH_DEVICE static type sqrt2() {
        return {T(0x1.6a09e667f3bcdp+0), T(-0x1.bdd3413b26456p-54)};
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET

#include "kernels/elementary/double_double.hpp"  // its elementary functions
