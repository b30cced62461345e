// AVX-512 registers of floats as a Real: twice the lanes of kernels/lanes/pack.hpp, for the
// question what float32 kernels would gain. Only what models without tables of their own need.
#pragma once

#include "kernels/elementary/sin_cos.hpp"
#include "kernels/lanes/pack.hpp"

#include <immintrin.h>

namespace hopscotch::inline HOPSCOTCH_TARGET {

template <int Registers>
struct single_mask {
    __mmask16 part[Registers];

    template <class Function>
    [[gnu::always_inline]] static single_mask each(Function&& function) {
        single_mask result;
        for_each_register<Registers>([&](auto i) __attribute__((always_inline)) {
            result.part[i()] = function(i());
        });
        return result;
    }
    [[gnu::always_inline]] friend single_mask operator&(const single_mask& a,
                                                        const single_mask& b) {
        return each([&](int i) __attribute__((always_inline))->__mmask16 {
            return _kand_mask16(a.part[i], b.part[i]);
        });
    }
    [[gnu::always_inline]] friend single_mask operator|(const single_mask& a,
                                                        const single_mask& b) {
        return each([&](int i) __attribute__((always_inline))->__mmask16 {
            return _kor_mask16(a.part[i], b.part[i]);
        });
    }
    [[gnu::always_inline]] friend single_mask operator!(const single_mask& a) {
        return each([&](int i) __attribute__((always_inline))->__mmask16 {
            return _knot_mask16(a.part[i]);
        });
    }
    [[gnu::always_inline]] friend bool any(const single_mask& a) {
        unsigned joined = 0;
        for_each_register<Registers>([&](auto i)
                                         __attribute__((always_inline)) { joined |= a.part[i()]; });
        return joined != 0;
    }
    [[gnu::always_inline]] friend bool all(const single_mask& a) { return !any(!a); }
};

template <int Registers>
struct single_pack {
    __m512 part[Registers];

    single_pack() = default;
    [[gnu::always_inline]] single_pack(const single_pack& other) { copy(other); }
    [[gnu::always_inline]] single_pack& operator=(const single_pack& other) { return copy(other); }
    [[gnu::always_inline]] single_pack& copy(const single_pack& other) {
        for_each_register<Registers>([&](auto i) __attribute__((always_inline)) {
            part[i()] = other.part[i()];
        });
        return *this;
    }
    [[gnu::always_inline]] single_pack(double x) {  // NOLINT(google-explicit-constructor)
        for_each_register<Registers>([&](auto i) __attribute__((always_inline)) {
            part[i()] = _mm512_set1_ps(static_cast<float>(x));
        });
    }

    template <class Function>
    [[gnu::always_inline]] static single_pack each(Function&& function) {
        single_pack result;
        for_each_register<Registers>([&](auto i) __attribute__((always_inline)) {
            result.part[i()] = function(i());
        });
        return result;
    }
    template <int Predicate>
    [[gnu::always_inline]] static single_mask<Registers> compare(const single_pack& a,
                                                                 const single_pack& b) {
        return single_mask<Registers>::each([&](int i) __attribute__((always_inline))->__mmask16 {
            return _mm512_cmp_ps_mask(a.part[i], b.part[i], Predicate);
        });
    }

    [[gnu::always_inline]] friend single_pack operator+(const single_pack& a,
                                                        const single_pack& b) {
        return each([&](int i) __attribute__((always_inline)) { return a.part[i] + b.part[i]; });
    }
    [[gnu::always_inline]] friend single_pack operator-(const single_pack& a,
                                                        const single_pack& b) {
        return each([&](int i) __attribute__((always_inline)) { return a.part[i] - b.part[i]; });
    }
    [[gnu::always_inline]] friend single_pack operator*(const single_pack& a,
                                                        const single_pack& b) {
        return each([&](int i) __attribute__((always_inline)) { return a.part[i] * b.part[i]; });
    }
    [[gnu::always_inline]] friend single_pack operator/(const single_pack& a,
                                                        const single_pack& b) {
        return each([&](int i) __attribute__((always_inline)) { return a.part[i] / b.part[i]; });
    }
    [[gnu::always_inline]] friend single_pack operator-(const single_pack& a) {
        return each([&](int i) __attribute__((always_inline)) { return -a.part[i]; });
    }
    [[gnu::always_inline]] single_pack& operator+=(const single_pack& b) {
        return *this = *this + b;
    }
    [[gnu::always_inline]] single_pack& operator-=(const single_pack& b) {
        return *this = *this - b;
    }
    [[gnu::always_inline]] single_pack& operator*=(const single_pack& b) {
        return *this = *this * b;
    }
    [[gnu::always_inline]] friend single_mask<Registers> operator<(const single_pack& a,
                                                                   const single_pack& b) {
        return compare<_CMP_LT_OQ>(a, b);
    }
    [[gnu::always_inline]] friend single_mask<Registers> operator<=(const single_pack& a,
                                                                    const single_pack& b) {
        return compare<_CMP_LE_OQ>(a, b);
    }
    [[gnu::always_inline]] friend single_mask<Registers> operator>(const single_pack& a,
                                                                   const single_pack& b) {
        return compare<_CMP_GT_OQ>(a, b);
    }
    [[gnu::always_inline]] friend single_mask<Registers> operator>=(const single_pack& a,
                                                                    const single_pack& b) {
        return compare<_CMP_GE_OQ>(a, b);
    }
    [[gnu::always_inline]] friend single_mask<Registers> operator==(const single_pack& a,
                                                                    const single_pack& b) {
        return compare<_CMP_EQ_OQ>(a, b);
    }
    [[gnu::always_inline]] friend single_pack fma(const single_pack& a, const single_pack& b,
                                                  const single_pack& c) {
        return each([&](int i) __attribute__((always_inline)) {
            return _mm512_fmadd_ps(a.part[i], b.part[i], c.part[i]);
        });
    }
    [[gnu::always_inline]] friend single_pack sqrt(const single_pack& x) {
        return each([&](int i)
                        __attribute__((always_inline)) { return _mm512_sqrt_ps(x.part[i]); });
    }
    [[gnu::always_inline]] friend single_pack abs(const single_pack& x) {
        return each([&](int i) __attribute__((always_inline)) { return _mm512_abs_ps(x.part[i]); });
    }
    [[gnu::always_inline]] friend single_pack floor(const single_pack& x) {
        return each([&](int i) __attribute__((always_inline)) {
            return _mm512_roundscale_ps(x.part[i], _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
        });
    }
    [[gnu::always_inline]] friend single_pack nearest(const single_pack& x) {
        return each([&](int i) __attribute__((always_inline)) {
            return _mm512_roundscale_ps(x.part[i], _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
        });
    }
    [[gnu::always_inline]] friend single_pack copysign(const single_pack& magnitude,
                                                       const single_pack& sign) {
        const __m512 bit = _mm512_set1_ps(-0.0f);
        return each([&](int i) __attribute__((always_inline)) {
            return _mm512_or_ps(_mm512_andnot_ps(bit, magnitude.part[i]),
                                _mm512_and_ps(bit, sign.part[i]));
        });
    }
    [[gnu::always_inline]] friend single_pack select(const single_mask<Registers>& condition,
                                                     const single_pack& yes,
                                                     const single_pack& no) {
        return each([&](int i) __attribute__((always_inline)) {
            return _mm512_mask_blend_ps(condition.part[i], no.part[i], yes.part[i]);
        });
    }
    [[gnu::always_inline]] friend single_pack negate_where(const single_mask<Registers>& condition,
                                                           const single_pack& x) {
        return each([&](int i) __attribute__((always_inline)) {
            return _mm512_mask_xor_ps(x.part[i], condition.part[i], x.part[i],
                                      _mm512_set1_ps(-0.0f));
        });
    }
    [[gnu::always_inline]] friend single_pack primal(const single_pack& x) { return x; }
    [[gnu::always_inline]] friend single_pack power_of_two(const single_pack& n) {
        return each([&](int i) __attribute__((always_inline)) {
            return _mm512_scalef_ps(_mm512_set1_ps(1.0f), n.part[i]);
        });
    }
    [[gnu::always_inline]] friend single_pack exponent(const single_pack& x) {
        return each([&](int i)
                        __attribute__((always_inline)) { return _mm512_getexp_ps(x.part[i]); });
    }
    [[gnu::always_inline]] friend single_pack mantissa(const single_pack& x) {
        return each([&](int i) __attribute__((always_inline)) {
            return _mm512_getmant_ps(x.part[i], _MM_MANT_NORM_1_2, _MM_MANT_SIGN_src);
        });
    }
    /// Of x = 1.5 2^23 + n it is that bit of the integer n.
    template <int Bit>
    [[gnu::always_inline]] friend single_mask<Registers> has_bit(const single_pack& x) {
        return single_mask<Registers>::each([&](int i) __attribute__((always_inline))->__mmask16 {
            return _mm512_test_epi32_mask(_mm512_castps_si512(x.part[i]),
                                          _mm512_set1_epi32(1 << Bit));
        });
    }
};

template <int Registers>
struct lane_traits<single_pack<Registers>> {
    using mask = single_mask<Registers>;
    using primal = single_pack<Registers>;
    static constexpr int width = 16 * Registers;
    static constexpr bool is_binary64 = true;  // opens the elementary functions, as for `single`
    static constexpr double rounding = 0x1p-24;
    static constexpr double root_rounding = 0x1p-12;
};

/// table[index], lane by lane.
template <int Registers, int Size>
inline single_pack<Registers> gather(const double (&table)[Size],
                                     const single_pack<Registers>& index) {
    return single_pack<Registers>::each([&](int i) __attribute__((always_inline)) {
        const __m512i at = _mm512_cvttps_epi32(index.part[i]);
        const __m256 low =
            _mm512_cvtpd_ps(_mm512_i32gather_pd(_mm512_castsi512_si256(at), table, 8));
        const __m256 high =
            _mm512_cvtpd_ps(_mm512_i32gather_pd(_mm512_extracti64x4_epi64(at, 1), table, 8));
        return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
    });
}

/// Quarter turns taken off in three parts of 12, 24 and 24 bits.
template <int Registers>
inline quarter_turns<single_pack<Registers>> split_quarter_turns(const single_pack<Registers>& x) {
    using Real = single_pack<Registers>;
    constexpr double round_to_integer = 0x1.8p23;
    const Real counter = fma(x, Real(0x1.45f306p-1), Real(round_to_integer));
    const Real n = counter - Real(round_to_integer);
    const Real rest = fma(n, Real(-0x1.922p+0), x);
    const Real middle = n * Real(-0x1.2aeefp-19);
    const Real high = rest - middle;
    return {counter, high, fma(n, Real(-0x1.2aeefp-19), high - rest)};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
