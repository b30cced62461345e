// `pack<n>`: n xsimd registers of doubles moving together, so that one instruction stream keeps
// several registers in flight. The only header that includes xsimd and intrinsics; compiled only
// into the avx2 and avx512 targets.
#pragma once

#include "kernels/lanes/scalar.hpp"

#include <utility>

#include <xsimd/xsimd.hpp>

namespace hopscotch::inline HOPSCOTCH_TARGET {

#if defined(__AVX512F__) && defined(__AVX512DQ__)
using simd_arch = xsimd::avx512dq;
#else
using simd_arch = xsimd::fma3<xsimd::avx2>;
#endif
using simd_register = xsimd::batch<double, simd_arch>;
using simd_mask = xsimd::batch_bool<double, simd_arch>;

// xsimd 8.1 has no fused multiply-add for AVX-512 (its generic one rounds twice), hence the
// intrinsic.
[[gnu::always_inline]] inline simd_register fused(const simd_register& a, const simd_register& b,
                                                  const simd_register& c) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
    return _mm512_fmadd_pd(a, b, c);
#else
    return _mm256_fmadd_pd(a, b, c);
#endif
}

inline simd_register magnitude_bits() {
    return simd_register(std::bit_cast<double>(0x7fffffffffffffffull));
}

[[gnu::always_inline]] inline simd_register negated_where(const simd_mask& condition,
                                                          const simd_register& x) {
    const simd_register sign(-0.0);
#if defined(__AVX512F__) && defined(__AVX512DQ__)
    return _mm512_mask_xor_pd(x, condition, x, sign);
#else
    return _mm256_xor_pd(x, _mm256_and_pd(condition, sign));
#endif
}

template <int Bit>
inline simd_mask register_has_bit(const simd_register& x) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
    return _mm512_test_epi64_mask(_mm512_castpd_si512(x), _mm512_set1_epi64(1ll << Bit));
#else
    const __m256i bit = _mm256_set1_epi64x(1ll << Bit);
    return _mm256_castsi256_pd(
        _mm256_cmpeq_epi64(_mm256_and_si256(_mm256_castpd_si256(x), bit), bit));
#endif
}

/// Calls function(i) for i = 0, 1, ... Registers - 1 as constants of their own types. A loop would
/// be unrolled too late for g++ 12 to keep a pack in registers: it stores every copy.
template <int Registers, class Function>
[[gnu::always_inline]] inline void for_each_register(Function&& function) {
    [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
        (function(std::integral_constant<int, I>{}), ...);
    }
    (std::make_integer_sequence<int, Registers>{});
}

template <int Registers>
struct pack_mask {
    simd_mask::register_type part[Registers];
    [[gnu::always_inline]] simd_mask at(int i) const { return simd_mask(part[i]); }

    // The members are the compiler's own registers, not xsimd's classes, and copied one by one:
    // g++ 12 copies classes as bytes, through memory, and cannot drop the copies.
    pack_mask() = default;
    [[gnu::always_inline]] pack_mask(const pack_mask& other) { copy(other); }
    [[gnu::always_inline]] pack_mask& operator=(const pack_mask& other) { return copy(other); }
    [[gnu::always_inline]] pack_mask& copy(const pack_mask& other) {
        for_each_register<Registers>([&](auto i) __attribute__((always_inline)) {
            part[i()] = other.part[i()];
        });
        return *this;
    }

    template <class Function>
    [[gnu::always_inline]] static pack_mask each(Function&& function) {
        pack_mask result;
        for_each_register<Registers>([&](auto i) __attribute__((always_inline)) {
            result.part[i()] = function(i());
        });
        return result;
    }
    [[gnu::always_inline]] friend pack_mask operator&(const pack_mask& a, const pack_mask& b) {
        return each([&](int i) __attribute__((always_inline)) { return a.at(i) & b.at(i); });
    }
    [[gnu::always_inline]] friend pack_mask operator|(const pack_mask& a, const pack_mask& b) {
        return each([&](int i) __attribute__((always_inline)) { return a.at(i) | b.at(i); });
    }
    [[gnu::always_inline]] friend pack_mask operator!(const pack_mask& a) {
        return each([&](int i) __attribute__((always_inline)) { return !a.at(i); });
    }
    [[gnu::always_inline]] friend bool any(const pack_mask& a) {
        simd_mask joined = a.at(0);
#pragma GCC unroll 8
        for (int i = 1; i < Registers; ++i) joined = joined | a.at(i);
        return xsimd::any(joined);
    }
    friend bool all(const pack_mask& a) {
        simd_mask joined = a.at(0);
#pragma GCC unroll 8
        for (int i = 1; i < Registers; ++i) joined = joined & a.at(i);
        return xsimd::all(joined);
    }
};

template <int Registers>
struct pack {
    simd_register::register_type part[Registers];
    [[gnu::always_inline]] simd_register at(int i) const { return simd_register(part[i]); }

    pack() = default;
    [[gnu::always_inline]] pack(const pack& other) { copy(other); }
    [[gnu::always_inline]] pack& operator=(const pack& other) { return copy(other); }
    [[gnu::always_inline]] pack& copy(const pack& other) {
        for_each_register<Registers>([&](auto i) __attribute__((always_inline)) {
            part[i()] = other.part[i()];
        });
        return *this;
    }
    [[gnu::always_inline]] pack(
        double x) {  // NOLINT(google-explicit-constructor): constants mix with lanes
        for_each_register<Registers>([&](auto i) __attribute__((always_inline)) {
            part[i()] = simd_register(x);
        });
    }

    template <class Function>
    [[gnu::always_inline]] static pack each(Function&& function) {
        pack result;
        for_each_register<Registers>([&](auto i) __attribute__((always_inline)) {
            result.part[i()] = function(i());
        });
        return result;
    }
    template <class Function>
    [[gnu::always_inline]] static pack_mask<Registers> mask_each(Function&& function) {
        return pack_mask<Registers>::each(function);
    }

    [[gnu::always_inline]] friend pack operator+(const pack& a, const pack& b) {
        return each([&](int i) __attribute__((always_inline)) { return a.at(i) + b.at(i); });
    }
    [[gnu::always_inline]] friend pack operator-(const pack& a, const pack& b) {
        return each([&](int i) __attribute__((always_inline)) { return a.at(i) - b.at(i); });
    }
    [[gnu::always_inline]] friend pack operator*(const pack& a, const pack& b) {
        return each([&](int i) __attribute__((always_inline)) { return a.at(i) * b.at(i); });
    }
    [[gnu::always_inline]] friend pack operator/(const pack& a, const pack& b) {
        return each([&](int i) __attribute__((always_inline)) { return a.at(i) / b.at(i); });
    }
    [[gnu::always_inline]] friend pack operator-(const pack& a) {
        return each([&](int i)
                        __attribute__((always_inline)) { return a.at(i) ^ simd_register(-0.0); });
    }
    [[gnu::always_inline]] pack& operator+=(const pack& b) { return *this = *this + b; }
    [[gnu::always_inline]] pack& operator-=(const pack& b) { return *this = *this - b; }
    [[gnu::always_inline]] pack& operator*=(const pack& b) { return *this = *this * b; }

    [[gnu::always_inline]] friend pack_mask<Registers> operator<(const pack& a, const pack& b) {
        return mask_each([&](int i) __attribute__((always_inline)) { return a.at(i) < b.at(i); });
    }
    [[gnu::always_inline]] friend pack_mask<Registers> operator<=(const pack& a, const pack& b) {
        return mask_each([&](int i)
                             __attribute__((always_inline)) { return a.at(i) <= b.at(i); });
    }
    [[gnu::always_inline]] friend pack_mask<Registers> operator>(const pack& a, const pack& b) {
        return b < a;
    }
    [[gnu::always_inline]] friend pack_mask<Registers> operator>=(const pack& a, const pack& b) {
        return b <= a;
    }
    [[gnu::always_inline]] friend pack_mask<Registers> operator==(const pack& a, const pack& b) {
        return mask_each([&](int i)
                             __attribute__((always_inline)) { return a.at(i) == b.at(i); });
    }

    [[gnu::always_inline]] friend pack fma(const pack& a, const pack& b, const pack& c) {
        return each([&](int i) __attribute__((always_inline)) {
            return fused(a.at(i), b.at(i), c.at(i));
        });
    }
    [[gnu::always_inline]] friend pack sqrt(const pack& x) {
        return each([&](int i) __attribute__((always_inline)) { return xsimd::sqrt(x.at(i)); });
    }
    [[gnu::always_inline]] friend pack abs(const pack& x) {
        return each([&](int i)
                        __attribute__((always_inline)) { return x.at(i) & magnitude_bits(); });
    }
    [[gnu::always_inline]] friend pack floor(const pack& x) {
        return each([&](int i) __attribute__((always_inline)) { return xsimd::floor(x.at(i)); });
    }
    [[gnu::always_inline]] friend pack nearest(const pack& x) {
        return each([&](int i)
                        __attribute__((always_inline)) { return xsimd::nearbyint(x.at(i)); });
    }
    [[gnu::always_inline]] friend pack copysign(const pack& magnitude, const pack& sign) {
        return each([&](int i) __attribute__((always_inline)) {
            return (magnitude.at(i) & magnitude_bits()) | (sign.at(i) & simd_register(-0.0));
        });
    }
    [[gnu::always_inline]] friend pack select(const pack_mask<Registers>& condition,
                                              const pack& yes, const pack& no) {
        return each([&](int i) __attribute__((always_inline)) {
            return xsimd::select(condition.at(i), yes.at(i), no.at(i));
        });
    }
    [[gnu::always_inline]] friend pack negate_where(const pack_mask<Registers>& condition,
                                                    const pack& x) {
        return each([&](int i) __attribute__((always_inline)) {
            return negated_where(condition.at(i), x.at(i));
        });
    }
    [[gnu::always_inline]] friend pack primal(const pack& x) { return x; }

    [[gnu::always_inline]] friend pack power_of_two(const pack& n) {
        return each([&](int i) __attribute__((always_inline)) {
            // n + 1023 sits in the low bits of the mantissa of 2^52 + 2^51 + n + 1023
            const auto shifted = n.at(i) + simd_register(6755399441055744.0 + 1023.0);
            return xsimd::bitwise_cast<simd_register>(
                xsimd::bitwise_cast<xsimd::batch<std::uint64_t, simd_arch>>(shifted) << 52);
        });
    }
    [[gnu::always_inline]] friend pack mantissa(const pack& x) {
        return each([&](int i) __attribute__((always_inline)) {
            using words = xsimd::batch<std::uint64_t, simd_arch>;
            const words bits = xsimd::bitwise_cast<words>(x.at(i));
            return xsimd::bitwise_cast<simd_register>((bits & words(0x000fffffffffffffull)) |
                                                      words(0x3ff0000000000000ull));
        });
    }
    [[gnu::always_inline]] friend pack exponent(const pack& x) {
        return each([&](int i) __attribute__((always_inline)) {
            using words = xsimd::batch<std::uint64_t, simd_arch>;
            // biased exponent below the mantissa of 2^52, read back as a double
            const words biased = xsimd::bitwise_cast<words>(x.at(i)) >> 52;
            return xsimd::bitwise_cast<simd_register>(biased | words(0x4330000000000000ull)) -
                   simd_register(4503599627370496.0 + 1023.0);
        });
    }
    template <int Bit>
    [[gnu::always_inline]] friend pack_mask<Registers> has_bit(const pack& x) {
        return mask_each([&](int i) __attribute__((always_inline)) {
            return register_has_bit<Bit>(x.at(i));
        });
    }
};

/// table[index], lane by lane. Small indices are read from two registers, which takes a sixth of a
/// gather's time.
template <int Registers, int Size>
inline pack<Registers> gather(const double (&table)[Size], const pack<Registers>& index) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
    if constexpr (Size >= 16) {
        if (all(index < pack<Registers>(16.0))) {
            const __m512d low = _mm512_loadu_pd(table);
            const __m512d high = _mm512_loadu_pd(table + 8);
            return pack<Registers>::each([&](int i) __attribute__((always_inline))->simd_register {
                return _mm512_permutex2var_pd(low, _mm512_cvttpd_epi64(index.at(i)), high);
            });
        }
    }
#endif
    return pack<Registers>::each([&](int i) __attribute__((always_inline))->simd_register {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
        return _mm512_i64gather_pd(_mm512_cvttpd_epi64(index.at(i)), table, 8);
#else
        return _mm256_i32gather_pd(table, _mm256_cvttpd_epi32(index.at(i)), 8);
#endif
    });
}

/// One bit per lane of a register.
inline unsigned bits_of(const simd_mask& mask) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
    return static_cast<__mmask8>(mask);
#else
    return static_cast<unsigned>(_mm256_movemask_pd(mask));
#endif
}

/// One bit per lane of a pack.
template <int Registers>
inline std::uint32_t lane_bits(const pack_mask<Registers>& mask) {
    std::uint32_t bits = 0;
#pragma GCC unroll 8
    for (int i = 0; i < Registers; ++i)
        bits |= bits_of(mask.at(i)) << (i * static_cast<int>(simd_register::size));
    return bits;
}

/// The lanes whose bits are set.
template <int Registers>
inline void set_lanes(pack_mask<Registers>& mask, std::uint64_t bits) {
#pragma GCC unroll 8
    for (int i = 0; i < Registers; ++i) {
        const std::uint64_t part = bits >> (i * static_cast<int>(simd_register::size));
#if defined(__AVX512F__) && defined(__AVX512DQ__)
        mask.part[i] = static_cast<__mmask8>(part);
#else
        const __m256i lane = _mm256_set_epi64x(8, 4, 2, 1);
        mask.part[i] = _mm256_castsi256_pd(_mm256_cmpeq_epi64(
            _mm256_and_si256(_mm256_set1_epi64x(static_cast<long long>(part)), lane), lane));
#endif
    }
}

/// Puts consecutive doubles of `from` into the lanes where the mask is set, in order; returns how
/// many.
template <int Registers>
inline int fill_lanes(pack<Registers>& to, const pack_mask<Registers>& where, const double* from) {
    int taken = 0;
#if defined(__AVX512F__) && defined(__AVX512DQ__)
#pragma GCC unroll 8
    for (int i = 0; i < Registers; ++i) {
        const unsigned bits = bits_of(where.at(i));
        to.part[i] =
            _mm512_mask_expandloadu_pd(to.at(i), static_cast<__mmask8>(bits), from + taken);
        taken += __builtin_popcount(bits);
    }
#else
    double* lanes = reinterpret_cast<double*>(&to);
    for (std::uint32_t left = lane_bits(where); left != 0; left &= left - 1)
        lanes[__builtin_ctz(left)] = from[taken++];
#endif
    return taken;
}

/// The same for integers.
template <int Registers>
inline void fill_lanes(std::uint64_t* to, const pack_mask<Registers>& where,
                       const std::uint64_t* from) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
#pragma GCC unroll 8
    for (int i = 0; i < Registers; ++i) {
        const unsigned bits = bits_of(where.at(i));
        std::uint64_t* lanes = to + i * static_cast<int>(simd_register::size);
        _mm512_storeu_si512(lanes,
                            _mm512_mask_expandloadu_epi64(_mm512_loadu_si512(lanes),
                                                          static_cast<__mmask8>(bits), from));
        from += __builtin_popcount(bits);
    }
#else
    for (std::uint32_t left = lane_bits(where); left != 0; left &= left - 1)
        to[__builtin_ctz(left)] = *from++;
#endif
}

/// Number of set lanes.
template <int Registers>
inline int count(const pack_mask<Registers>& mask) {
    int n = 0;
#pragma GCC unroll 8
    for (int i = 0; i < Registers; ++i) n += __builtin_popcount(bits_of(mask.at(i)));
    return n;
}

template <int Registers>
struct lane_traits<pack<Registers>> {
    using mask = pack_mask<Registers>;
    using primal = pack<Registers>;
    static constexpr int width = Registers * static_cast<int>(simd_register::size);
    static constexpr bool is_binary64 = true;
    static constexpr double rounding = 0x1p-53;
    static constexpr double root_rounding = 0x1p-26;
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
