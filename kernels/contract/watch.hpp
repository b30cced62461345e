// How `trace` looks into an orbit while it is computed. A model hands every phase and every event
// to its Watch argument; kernels pass `unwatched`, which compiles to nothing.
//
// A watching type (analysis/trace) offers
//   void phase(const char* mode, Real start_time, Real duration, sampler)   sampler(t, Real*
//   columns) void event(const char* name, Real time, const char* mode_left, const char*
//   mode_entered,
//              const Real* before, const Real* after, Real loss)
// with `columns`, `before`, `after` in the order of model_info::trace_columns.
#pragma once

namespace hopscotch {

struct unwatched {
    static constexpr bool is_active = false;
};

}  // namespace hopscotch
