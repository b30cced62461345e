// Lyapunov exponents from block means: mean, standard error, drift. An estimate is never stopped by
// how little it moved, only by its standard error, and it rests on the stretch of the orbit after
// the last drift that was seen.
#pragma once

#include "kernels/contract/motion.hpp"
#include "kernels/contract/model.hpp"
#include "kernels/elementary/elementary.hpp"
#include "kernels/ensemble/request.hpp"
#include "kernels/ensemble/tangent_space.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// Sums over consecutive blocks of equal length.
template <class Real, int N>
struct block_sums {
    Real n;
    Real sum[N];   // of block means per return; of the largest exponent relative to a reference
    Real squares;  // of the largest exponent's, relative to the reference
    Real lagged;   // products of neighbouring ones
    Real time;     // that the blocks took

    HOPSCOTCH_DEVICE void clear(const mask_of<Real>& where) {
        each_with(*this, [&](Real& mine, const Real&) { mine = select(where, Real(0.0), mine); });
    }
    HOPSCOTCH_DEVICE void add(const mask_of<Real>& where, const block_sums& other) {
        each_with(other, [&](Real& mine, const Real& its) {
            mine = mine + select(where, its, Real(0.0));
        });
    }
    HOPSCOTCH_DEVICE void take(const mask_of<Real>& where, const block_sums& other) {
        each_with(other, [&](Real& mine, const Real& its) { mine = select(where, its, mine); });
    }
    HOPSCOTCH_DEVICE Real mean() const { return sum[0] / n; }

    /// Square of the standard error of `mean()`. Correlation between neighbouring blocks is added
    /// where it is positive; a negative one is not used to make the error smaller.
    HOPSCOTCH_DEVICE Real squared_error() const {
        const Real zero(0.0);
        const Real one(1.0);
        const Real m = mean();
        const Real spread = fma(-m, m, squares / n);
        const Real variance = select(spread > zero, spread, zero);
        const Real common = fma(-m, m, lagged / (n - one));
        const Real positive = select(common > zero, common, zero);
        const Real correlated = select(positive < variance, positive, variance);
        return (variance * (n / (n - one)) + Real(2.0) * correlated) / n;
    }

private:
    template <class Function>
    HOPSCOTCH_DEVICE void each_with(const block_sums& other, const Function& function) {
        function(n, other.n);
        for (int k = 0; k < N; ++k) function(sum[k], other.sum[k]);
        function(squares, other.squares);
        function(lagged, other.lagged);
        function(time, other.time);
    }
};

/// What an estimate has come to.
template <class Real, int N>
struct exponent_result {
    Real exponents[N];  // per return
    Real rate;          // the first one per unit of time
    Real standard_error;
    Real returns;
    Real motion;
};

/// \tparam Squares  sizes are booked as squares
template <class Real, int N, bool Squares = (N > 1)>
struct exponent_estimate {
    Real until_boundary;  // returns to the end of the transient or block
    Real has_begun;       // 1 after the transient
    Real doublings[N];    // of the directions' sizes since the last boundary
    Real log_size[N];     // of the mantissas at the last boundary
    Real time;            // at the last boundary
    Real reference;       // the first block mean
    Real previous;        // the last block mean, relative to the reference
    block_sums<Real, N> early;
    block_sums<Real, N> late;

    /// Block means that drift apart by more than this many standard errors of their difference are
    /// not of one stretch.
    static constexpr double most_drift = 4.0;
    static constexpr double least_late = 4.0;  // blocks, for a drift to be seen at all
    /// Per return; exponents closer to zero than this are not told from rounding errors.
    static constexpr double least_exponent = 0x1p-32;
    /// An exponent is the mean of log |v|, or of half of log v^2.
    static constexpr double scale_of_logs = Squares ? 0.5 : 1.0;

    HOPSCOTCH_DEVICE void begin(const exponent_request& wanted) {
        const Real zero(0.0);
        const std::uint32_t transient = wanted.transient > 0 ? wanted.transient : 1;
        until_boundary = Real(static_cast<double>(transient));
        has_begun = time = reference = previous = zero;
        for (int k = 0; k < N; ++k) doublings[k] = log_size[k] = zero;
        early.n = late.n = Real(-1.0);
        const mask_of<Real> all = zero == zero;
        early.clear(all);
        late.clear(all);
    }

    /// Books the end of a block (or of the transient).
    ///
    /// \param at     lanes at a boundary
    /// \param sizes  of the directions, or their squares
    /// \param now    time of the orbit
    HOPSCOTCH_DEVICE void book(const exponent_request& wanted, const mask_of<Real>& at,
                               const Real (&sizes)[N], const Real& now) {
        const Real zero(0.0);
        const Real length(static_cast<double>(wanted.block));
        const mask_of<Real> block_ends = at & (has_begun > zero);
        block_sums<Real, N> block;
        for (int k = 0; k < N; ++k) {
            const split_size<Real> size = split(sizes[k]);
            const Real doubled = doublings[k] + size.doublings;
            const Real growth = fma(doubled, ln2<Real>(), size.log_mantissa - log_size[k]);
            block.sum[k] = growth * Real(scale_of_logs) / length;
            doublings[k] = select(at, -size.doublings, doublings[k]);
            log_size[k] = select(at, size.log_mantissa, log_size[k]);
        }
        const mask_of<Real> is_first = block_ends & (early.n == zero);
        reference = select(is_first, block.sum[0], reference);
        block.n = Real(1.0);
        block.sum[0] = block.sum[0] - reference;
        block.squares = block.sum[0] * block.sum[0];
        block.lagged = block.sum[0] * previous;
        block.time = now - time;
        previous = select(block_ends, block.sum[0], previous);
        time = select(at, now, time);
        until_boundary = select(at, length, until_boundary);
        has_begun = select(at, Real(1.0), has_begun);
        if (any(block_ends)) add(wanted, block_ends, block);
    }

    /// Lanes whose standard error is small enough, on enough blocks without drift.
    HOPSCOTCH_DEVICE mask_of<Real> is_precise(const exponent_request& wanted) const {
        block_sums<Real, N> all = early;
        all.add(early.n == early.n, late);
        const Real target(wanted.error);
        const mask_of<Real> enough = all.n >= Real(static_cast<double>(wanted.least_blocks));
        const mask_of<Real> vanished = log_size[0] == -infinity<Real>();
        return enough & (vanished | ((all.squared_error() < target * target) & !drifts(wanted)));
    }

    HOPSCOTCH_DEVICE exponent_result<Real, N> conclude(const exponent_request& wanted) const {
        const Real zero(0.0);
        const Real nan = not_a_number<Real>();
        const Real length(static_cast<double>(wanted.block));
        block_sums<Real, N> used = early;
        used.add(early.n == early.n, late);
        used.take(drifts(wanted), late);

        const mask_of<Real> any_block = used.n > zero;
        const mask_of<Real> vanished = any_block & (log_size[0] == -infinity<Real>());
        exponent_result<Real, N> result;
        result.exponents[0] = select(any_block, reference + used.mean(), nan);
        for (int k = 1; k < N; ++k) {
            const Real mean = used.sum[k] / used.n;
            result.exponents[k] = select(any_block & is_number(mean), mean, nan);
        }
        for (int k = 0; k < N; ++k) {
            if (k > 0 && k >= wanted.n_free) continue;
            result.exponents[k] = select(vanished, -infinity<Real>(), result.exponents[k]);
        }
        const Real largest = result.exponents[0];
        result.rate = largest * (used.n * length) / used.time;
        result.standard_error = select(vanished, zero, sqrt(used.squared_error()));
        result.returns = used.n * length;

        const Real margin = Real(wanted.significance) * result.standard_error;
        const Real least(least_exponent);
        const Real beyond = select(margin > least, margin, least);
        const mask_of<Real> enough = used.n >= Real(first_blocks(wanted));
        const mask_of<Real> is_periodic = vanished | (enough & (largest < -beyond));
        const mask_of<Real> is_chaotic = enough & (largest > beyond);
        const mask_of<Real> lost = any_block & !vanished & !is_number(largest);
        result.motion = select(is_chaotic, code(motion::chaotic), code(motion::undecided));
        result.motion = select(is_periodic, code(motion::periodic), result.motion);
        result.motion = select(lost, code(motion::not_smooth), result.motion);
        result.exponents[0] = select(lost, nan, result.exponents[0]);
        return result;
    }

    HOPSCOTCH_DEVICE static Real code(motion value) {
        return Real(static_cast<double>(static_cast<int>(value)));
    }

private:
    HOPSCOTCH_DEVICE static mask_of<Real> is_number(const Real& x) { return x - x == Real(0.0); }

    /// Blocks of the first stretch, and least of one that stands alone.
    HOPSCOTCH_DEVICE static double first_blocks(const exponent_request& wanted) {
        const double half = static_cast<double>(wanted.least_blocks / 2);
        return half > least_late ? half : least_late;
    }

    /// The earlier mean is far from the later one, as the later blocks scatter: earlier ones of
    /// another motion would hide themselves by their own scatter.
    HOPSCOTCH_DEVICE mask_of<Real> drifts(const exponent_request& wanted) const {
        const Real apart = early.mean() - late.mean();
        const Real error = late.squared_error() * (Real(1.0) + late.n / early.n);
        const Real bound =
            fma(Real(most_drift * most_drift), error, Real(least_exponent * least_exponent));
        return (late.n >= Real(first_blocks(wanted))) & (apart * apart > bound);
    }

    /// Once the later blocks are as many as the earlier ones, both become one stretch, or the
    /// earlier ones are left out as part of the transient.
    HOPSCOTCH_DEVICE void add(const exponent_request& wanted, const mask_of<Real>& where,
                              const block_sums<Real, N>& block) {
        const mask_of<Real> fills = where & (early.n < Real(first_blocks(wanted)));
        early.add(fills, block);
        late.add(where & !fills, block);
        const mask_of<Real> full = where & (late.n > Real(0.0)) & (late.n >= early.n);
        if (!any(full)) return;
        const mask_of<Real> drifting = full & drifts(wanted);
        early.add(full & !drifting, late);
        early.take(drifting, late);
        late.clear(full);
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
