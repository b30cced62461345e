// Explicit maps whose Lyapunov exponents are known in closed form, as models of the ensemble loops:
// what the tests of the tangent ensemble measure it against.
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/elementary/elementary.hpp"

#include <array>

namespace hopscotch::inline HOPSCOTCH_TARGET::known_maps {

inline constexpr column_info two_columns[] = {{"x", "1", any_finite, "x"},
                                              {"y", "1", any_finite, "y"}};
inline constexpr parameter_info two_parameters[] = {{"p", "p", "1", 0.0, any_finite, "p"},
                                                    {"q", "q", "1", 0.0, any_finite, "q"}};

/// A map of Map::n_columns numbers with parameters p and q as a model. `Map::apply` gives the code
/// of an outcome where the orbit ends.
template <class Map>
struct map_model {
    static constexpr std::span<const column_info> columns{two_columns, Map::n_columns};
    static constexpr section_info sections[] = {{"map", columns, 0, "every iterate"},
                                                {"flight", two_columns, 0, "start only"}};
    static constexpr model_info info{.name = "map",
                                     .title = "map",
                                     .reference = "",
                                     .time_unit = "1",
                                     .parameters = two_parameters,
                                     .sections = sections,
                                     .options = {},
                                     .extras = {},
                                     .outcomes = {},
                                     .trace_columns = columns};
    static constexpr int n_variants = 1;
    static int variant(const variant_query&) { return 0; }
    static std::string_view refusal(const double*, const int*) { return {}; }

    template <class Real>
    struct lane {
        Real x[2];
        Real p[2];
        Real time;
        Real events;
    };
    template <int, class Real, class Watch>
    static progress<Real> begin(lane<Real>& at, int section, const Real* start,
                                const Real* parameter, const int*, Watch&) {
        at.x[0] = start[0];
        at.x[1] = Map::n_columns > 1 || section == 1 ? start[1] : Real(0.0);
        if (section == 1) at.x[0] = start[0] + Real(2.0) * start[1];
        at.p[0] = parameter[0];
        at.p[1] = parameter[1];
        at.time = at.events = Real(0.0);
        return {at.time < at.time, Real(0.0)};
    }
    template <int, class Real, class Watch>
    static progress<Real> step(lane<Real>& at, mask_of<Real> active, Watch&) {
        Real next[2] = {at.x[0], at.x[1]};
        const Real ended = Map::apply(next, at.p);
        const mask_of<Real> goes_on = active & (ended == Real(0.0));
        for (int c = 0; c < 2; ++c) at.x[c] = select(goes_on, next[c], at.x[c]);
        at.time = select(goes_on, at.time + Real(0.5), at.time);  // two returns per unit of time
        at.events = select(goes_on, at.events + Real(1.0), at.events);
        return {goes_on, ended};
    }
    template <class Real>
    static void read_state(const lane<Real>& at, int, Real* to) {
        for (std::size_t c = 0; c < Map::n_columns; ++c) to[c] = at.x[c];
    }
    template <class Real>
    static void read_extras(const lane<Real>&, Real*) {}
};

/// x / p left of p, (1 - x) / (1 - p) right of it: exponent -p ln p - (1 - p) ln(1 - p).
struct skew_tent_map {
    static constexpr std::size_t n_columns = 1;
    template <class Real>
    static Real apply(Real* x, const Real* p) {
        const Real one(1.0);
        x[0] = select(x[0] < p[0], x[0] / p[0], (one - x[0]) / (one - p[0]));
        return Real(0.0);
    }
};
/// p (1 - |1 - 2 x|) / 2, slope +- p: exponent ln p.
struct tent_map {
    static constexpr std::size_t n_columns = 1;
    template <class Real>
    static Real apply(Real* x, const Real* p) {
        x[0] = p[0] * (Real(0.5) - abs(Real(0.5) - x[0]));
        return Real(0.0);
    }
};
/// p x (1 - x): exponent ln 2 at p = 4, superstable fixed point 1/2 at p = 2.
struct logistic_map {
    static constexpr std::size_t n_columns = 1;
    template <class Real>
    static Real apply(Real* x, const Real* p) {
        x[0] = p[0] * x[0] * (Real(1.0) - x[0]);
        return Real(0.0);
    }
};
/// The skew baker's map: x as the skew tent without the fold, y contracted by q or 1 - q.
struct baker_map {
    static constexpr std::size_t n_columns = 2;
    template <class Real>
    static Real apply(Real* x, const Real* p) {
        const Real one(1.0);
        const mask_of<Real> left = x[0] < p[0];
        x[1] = select(left, p[1] * x[1], p[1] + (one - p[1]) * x[1]);
        x[0] = select(left, x[0] / p[0], (x[0] - p[0]) / (one - p[0]));
        return Real(0.0);
    }
};
/// Arnold's cat: exponents +- ln((3 + sqrt 5) / 2).
struct cat_map {
    static constexpr std::size_t n_columns = 2;
    template <class Real>
    static Real apply(Real* x, const Real*) {
        const Real u = Real(2.0) * x[0] + x[1];
        const Real v = x[0] + x[1];
        x[0] = u - floor(u);
        x[1] = v - floor(v);
        return Real(0.0);
    }
};
/// Henon's map 1 - p x^2 + y, q x: the exponents add up to ln q.
struct henon_map {
    static constexpr std::size_t n_columns = 2;
    template <class Real>
    static Real apply(Real* x, const Real* p) {
        const Real next = Real(1.0) - p[0] * x[0] * x[0] + x[1];
        x[1] = p[1] * x[0];
        x[0] = next;
        return Real(0.0);
    }
};
/// p y + q x, with x conserved but for rounding: exponents ln p and 0.
struct conserving_map {
    static constexpr std::size_t n_columns = 2;
    template <class Real>
    static Real apply(Real* x, const Real* p) {
        const Real sum = x[0] + x[1];
        x[0] = sqrt(sum * sum - x[1] * (x[0] + sum));
        x[1] = p[0] * x[1] + p[1] * x[0];
        return Real(0.0);
    }
};
/// y grows by p for the first 1000 iterates, then shrinks to y q + 1: a chaotic transient's
/// tangent.
struct late_map {
    static constexpr std::size_t n_columns = 1;
    template <class Real>
    static Real apply(Real* x, const Real* p) {
        const mask_of<Real> early = x[1] < Real(1000.0);
        x[0] =
            select(early, Real(1.0) + p[0] * (x[0] - Real(1.0)), Real(1.0) + p[1] * (x[0] - 1.0));
        x[1] = x[1] + Real(1.0);
        return Real(0.0);
    }
};
/// The square root of |x|, one above p: a vertical tangent at x = 0. Falls above q.
struct root_map {
    static constexpr std::size_t n_columns = 1;
    template <class Real>
    static Real apply(Real* x, const Real* p) {
        x[0] = sqrt(abs(x[0])) + p[0];
        return select(x[0] > p[1], code_of<Real>(outcome::fell), Real(0.0));
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::known_maps
