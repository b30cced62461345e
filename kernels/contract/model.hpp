// The model contract: what a header in kernels/models/ must offer so that every backend,
// arithmetic, command and question can use it without another file being edited.
//
//   struct my_model {
//       static constexpr model_info info = ...;            // tables, see contract/info.hpp
//       static constexpr int n_variants = 1;               // compile-time variants ("model only
//       what static int variant(const variant_query&);          //  a scene needs"); chosen by the
//       host static std::string_view refusal(const double* parameters, const int* options);
//                                                          // why this combination is invalid, or
//                                                          ""
//       template <class Real> struct lane { ...; Real time; Real events; };
//                                                          // one trajectory; only Real members
//       template <int Variant, class Real, class Watch>
//       static progress<Real> begin(lane<Real>&, int section, const Real* columns,
//                                   const Real* parameters, const int* options, Watch&);
//       template <int Variant, class Real, class Watch>
//       static progress<Real> step(lane<Real>&, mask_of<Real> active, Watch&);
//       template <class Real> static void read_state(const lane<Real>&, int section, Real*
//       columns); template <class Real> static void read_extras(const lane<Real>&, Real* extras);
//       // optional: how many leading members of a lane `begin` derives from parameters and options
//       // alone and nothing changes later; where no parameter varies they are not moved with a
//       lane static constexpr int n_parameter_fields = 0;
//       // optional: so many leading variants are cheap maps, beside which calls count; a step of
//       // their tangent ensemble is compiled into one stretch of code
//       static constexpr int n_cheap_variants = 0;
//       // optional, where a variant integrates a flow: takes the tolerance asked for (see
//       // kernels/integrators/taylor.hpp; 0 = the arithmetic's own). Called before `begin`, which
//       // must leave it alone.
//       template <int Variant, class Real> static void set_tolerance(lane<Real>&, double);
//       // optional: the model's own proof of where an orbit ends, for which scenes it labels every
//       // attracted orbit, and what its labels are (false: no such label)
//       template <int Variant, class Real> static Real certificate(const lane<Real>&);
//       static bool certificate_covers(const variant_query&);
//       static bool describe_label(int label, label_description&);
//       // optional: variants whose trajectory is another type than lane<Real>; all functions that
//       // take a lane then have an overload for it
//       template <int Variant, class Real> using variant_lane = ...;
//       // optional: the branches of a one-dimensional return map, index = 0, 1, 2, ...
//       static bool branch(int index, const double* parameters, map_branch&);  // and phases that
//       wrap: see make_entry.hpp
//       // optional: the contact that is made and broken, for layers: see contact.hpp
//       static constexpr contact_info contact{...};
//   };
//
// `begin` places a trajectory on (or flies it towards) the section; `step` performs a bounded
// amount of work: a few events or one integrator step. Both say lane by lane whether a return
// was completed and whether the orbit ended. `step` is called with lanes that are idle or ended too
// (active = false): it may compute nonsense there but must come to an end. `read_state` gives the
// last section state reached. `certificate` gives a label > 0 once the orbit's fate is proved after
// a completed return.
#pragma once

#include "kernels/contract/contact.hpp"
#include "kernels/contract/info.hpp"
#include "kernels/contract/watch.hpp"
#include "kernels/lanes/scalar.hpp"

#include <concepts>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// What one call of `begin` or `step` did, lane by lane.
template <class Real>
struct progress {
    mask_of<Real> returned;  // a return to the section was completed
    Real ended;              // 0 while the orbit goes on, else the code of its outcome
};

/// The code of an outcome as it travels in a lane.
template <class Real>
HOPSCOTCH_DEVICE inline Real code_of(outcome value) {
    return Real(static_cast<double>(static_cast<int>(value)));
}

template <class Model>
concept describes_itself = requires {
    { Model::info.name } -> std::convertible_to<std::string_view>;
    { Model::n_variants } -> std::convertible_to<int>;
    { Model::variant(std::declval<const variant_query&>()) } -> std::convertible_to<int>;
    {
        Model::refusal(std::declval<const double*>(), std::declval<const int*>())
        } -> std::convertible_to<std::string_view>;
};

template <class Model, class Real>
concept has_lane = requires(typename Model::template lane<Real> lane) {
    { lane.time } -> std::convertible_to<Real>;
    { lane.events } -> std::convertible_to<Real>;
    requires sizeof(lane) % sizeof(Real) == 0;  // only Real members, so that lanes can be moved
};

template <class Model, class Real>
concept begins = requires(typename Model::template lane<Real>& lane, const Real* numbers,
                          const int* options, unwatched& watch) {
    {
        Model::template begin<0>(lane, 0, numbers, numbers, options, watch)
        } -> std::same_as<progress<Real>>;
};

template <class Model, class Real>
concept steps = requires(typename Model::template lane<Real>& lane, mask_of<Real> active,
                         unwatched& watch) {
    { Model::template step<0>(lane, active, watch) } -> std::same_as<progress<Real>>;
};

template <class Model, class Real>
concept can_be_read = requires(const typename Model::template lane<Real>& lane, Real* numbers) {
    Model::read_state(lane, 0, numbers);
    Model::read_extras(lane, numbers);
};

/// A complete model for the arithmetic Real. The parts above name what is missing where it fails.
template <class Model, class Real>
concept model = describes_itself<Model> && has_lane<Model, Real> && begins<Model, Real> &&
    steps<Model, Real> && can_be_read<Model, Real>;

/// Leading members of a lane that follow from parameters and options alone.
template <class Model>
inline constexpr int parameter_fields_of = 0;
template <class Model>
requires requires { Model::n_parameter_fields; }
inline constexpr int parameter_fields_of<Model> = Model::n_parameter_fields;

/// Leading variants whose steps cost little beside a call.
template <class Model>
inline constexpr int cheap_variants_of = 0;
template <class Model>
requires requires { Model::n_cheap_variants; }
inline constexpr int cheap_variants_of<Model> = Model::n_cheap_variants;

template <class Model, int Variant, class Real>
struct choice_of_lane {
    using type = typename Model::template lane<Real>;
};
template <class Model, int Variant, class Real>
requires requires { typename Model::template variant_lane<Variant, Real>; }
struct choice_of_lane<Model, Variant, Real> {
    using type = typename Model::template variant_lane<Variant, Real>;
};

/// One trajectory of a compile-time variant.
template <class Model, int Variant, class Real>
using lane_of = typename choice_of_lane<Model, Variant, Real>::type;

/// A model whose variant integrates a flow to a tolerance.
template <class Model, int Variant, class Real>
concept integrates = requires(lane_of<Model, Variant, Real>& lane) {
    Model::template set_tolerance<Variant>(lane, 1e-10);
};

/// Hands the tolerance to a lane that is about to begin, where its variant integrates.
template <class Model, int Variant, class Real>
HOPSCOTCH_DEVICE inline void take_tolerance(lane_of<Model, Variant, Real>& lane, double tolerance) {
    if constexpr (integrates<Model, Variant, Real>) {
        Model::template set_tolerance<Variant>(lane, tolerance);
    }
}

/// A model that can prove where an orbit ends.
template <class Model, class Real>
concept certifies = requires(const typename Model::template lane<Real>& lane) {
    { Model::template certificate<0>(lane) } -> std::same_as<Real>;
};

/// A model whose certificate can serve as the labels of a basins map.
template <class Model>
concept labels_by_certificate = certifies<Model, double> && requires(label_description& text) {
    { Model::certificate_covers(std::declval<const variant_query&>()) } -> std::same_as<bool>;
    { Model::describe_label(1, text) } -> std::same_as<bool>;
};

/// A model with a one-dimensional return map that knows its branches.
template <class Model>
concept has_branches = requires(const double* parameters, map_branch& branch) {
    { Model::branch(0, parameters, branch) } -> std::same_as<bool>;
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
