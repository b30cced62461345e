// The concept `model` at compile time: both passive models satisfy it in every arithmetic, and a
// model with one part missing or wrong does not. Only the last test runs.
#include "analysis/truth/real50.hpp"
#include "kernels/contract/model.hpp"
#include "kernels/lanes/double_double.hpp"
#include "kernels/lanes/dual.hpp"
#include "kernels/models/passive_hopper.hpp"
#include "kernels/models/passive_juggler.hpp"

#include <gtest/gtest.h>

namespace hopscotch {
namespace {

/// The least that is a model. The others below differ from it in one member.
struct complete {
    static constexpr column_info column[] = {{"x", "1", any_finite, ""}};
    static constexpr section_info section[] = {{"s", column, 0, ""}};
    static constexpr model_info info{.name = "complete", .sections = section};
    static constexpr int n_variants = 1;
    static int variant(const variant_query&) { return 0; }
    static std::string_view refusal(const double*, const int*) { return {}; }
    template <class Real>
    struct lane {
        Real x, time, events;
    };
    template <int Variant, class Real, class Watch>
    static progress<Real> begin(lane<Real>&, int, const Real*, const Real*, const int*, Watch&);
    template <int Variant, class Real, class Watch>
    static progress<Real> step(lane<Real>&, mask_of<Real>, Watch&);
    template <class Real>
    static void read_state(const lane<Real>&, int, Real*);
    template <class Real>
    static void read_extras(const lane<Real>&, Real*);
};
static_assert(model<complete, double>);
static_assert(!certifies<complete, double>);
static_assert(!labels_by_certificate<complete>);
static_assert(!has_branches<complete>);

// Hides one name of `complete` behind something that is no such member.
struct no_step : complete {
    using step = void;
};
struct no_begin : complete {
    using begin = void;
};
struct no_state : complete {
    using read_state = void;
};
struct no_extras : complete {
    using read_extras = void;
};
struct no_lane : complete {
    using lane = void;
};
struct no_refusal : complete {
    using refusal = void;
};
struct no_variant : complete {
    using variant = void;
};
struct no_variant_count : complete {
    using n_variants = void;
};
struct no_info : complete {
    using info = void;
};
static_assert(!model<no_step, double> && !steps<no_step, double> && begins<no_step, double>);
static_assert(!model<no_begin, double> && !begins<no_begin, double> && steps<no_begin, double>);
static_assert(!model<no_state, double> && !can_be_read<no_state, double>);
static_assert(!model<no_extras, double> && !can_be_read<no_extras, double>);
static_assert(!model<no_lane, double> && !has_lane<no_lane, double>);
static_assert(!model<no_refusal, double> && !describes_itself<no_refusal>);
static_assert(!model<no_variant, double> && !describes_itself<no_variant>);
static_assert(!model<no_variant_count, double> && !describes_itself<no_variant_count>);
static_assert(!model<no_info, double> && !describes_itself<no_info>);
static_assert(!model<int, double> && !model<void, double>);

struct step_returns_nothing : complete {
    template <int Variant, class Real, class Watch>
    static void step(lane<Real>&, mask_of<Real>, Watch&);
};
struct step_returns_a_mask : complete {
    template <int Variant, class Real, class Watch>
    static mask_of<Real> step(lane<Real>&, mask_of<Real>, Watch&);
};
struct step_is_double_only : complete {
    template <int Variant, class Real, class Watch>
    static progress<double> step(lane<Real>&, mask_of<Real>, Watch&);
};
struct step_takes_the_lane_as_a_constant_copy_of_another : complete {
    template <int Variant, class Real, class Watch>
    static progress<Real> step(int&, mask_of<Real>, Watch&);
};
struct begin_returns_nothing : complete {
    template <int Variant, class Real, class Watch>
    static void begin(lane<Real>&, int, const Real*, const Real*, const int*, Watch&);
};
struct begin_wants_no_parameters : complete {
    template <int Variant, class Real, class Watch>
    static progress<Real> begin(lane<Real>&, int, const Real*, Watch&);
};
struct reads_a_lane_it_wants_to_change : complete {
    template <class Real>
    static void read_state(lane<Real>&, int, Real*);
};
static_assert(!model<step_returns_nothing, double>);
static_assert(!model<step_returns_a_mask, double>);
static_assert(model<step_is_double_only, double> && !model<step_is_double_only, real50>);
static_assert(!model<step_takes_the_lane_as_a_constant_copy_of_another, double>);
static_assert(!model<begin_returns_nothing, double>);
static_assert(!model<begin_wants_no_parameters, double>);
static_assert(!model<reads_a_lane_it_wants_to_change, double>);

// Lanes are moved as columns of Real: anything else in them must be refused.
template <class Odd>
struct with_member : complete {
    template <class Real>
    struct lane {
        Real x, time, events;
        Odd odd;
    };
    template <int Variant, class Real, class Watch>
    static progress<Real> begin(lane<Real>&, int, const Real*, const Real*, const int*, Watch&);
    template <int Variant, class Real, class Watch>
    static progress<Real> step(lane<Real>&, mask_of<Real>, Watch&);
    template <class Real>
    static void read_state(const lane<Real>&, int, Real*);
    template <class Real>
    static void read_extras(const lane<Real>&, Real*);
};
static_assert(model<with_member<double>, double>);
struct lane_without_time : complete {
    template <class Real>
    struct lane {
        Real x, events;
    };
};
struct lane_without_events : complete {
    template <class Real>
    struct lane {
        Real x, time;
    };
};
struct time_is_text : complete {
    template <class Real>
    struct lane {
        Real x, events;
        const char* time;
    };
};
struct odd_size : complete {
    template <class Real>
    struct __attribute__((packed)) lane {
        Real x, time, events;
        char odd;
    };
};
static_assert(!has_lane<lane_without_time, double> && !has_lane<lane_without_events, double>);
static_assert(!has_lane<time_is_text, double>);
static_assert(!has_lane<odd_size, double>);

struct certificate_of_the_wrong_type : complete {
    template <int Variant, class Real>
    static bool certificate(const lane<Real>&);
};
struct certificate_without_labels : complete {
    template <int Variant, class Real>
    static Real certificate(const lane<Real>&);
};
struct branch_of_the_wrong_type : complete {
    static void branch(int, const double*, map_branch&);
};
static_assert(!certifies<certificate_of_the_wrong_type, double>);
static_assert(certifies<certificate_without_labels, double> &&
              !labels_by_certificate<certificate_without_labels>);
static_assert(!has_branches<branch_of_the_wrong_type>);

// The passive models, in every arithmetic that runs without packs.
template <class Model>
inline constexpr bool in_every_arithmetic =
    model<Model, double>&& model<Model, double_double<double>>&& model<Model, real50>&& model<
        Model, dual<double, 1>>&& model<Model, dual<double, 4>>&& model<Model, dual<real50, 4>>;
static_assert(in_every_arithmetic<passive_hopper> && in_every_arithmetic<passive_juggler>);
static_assert(labels_by_certificate<passive_hopper> && labels_by_certificate<passive_juggler>);
static_assert(has_branches<passive_hopper> && has_branches<passive_juggler>);

TEST(passive_contract, description_names_what_the_interface_promises) {
    const std::string_view names[] = {"mass_ratio",      "restitution",         "damping_ratio",
                                      "speed_increment", "quadratic_stiffness", "cubic_stiffness",
                                      "gravity_gradient"};
    for (const model_info* info : {&passive_hopper::info, &passive_juggler::info}) {
        ASSERT_EQ(info->parameters.size(), std::size(names));
        for (std::size_t p = 0; p < std::size(names); ++p)
            EXPECT_EQ(info->parameters[p].name, names[p]);
        ASSERT_EQ(info->sections.size(), 2u);
        EXPECT_EQ(info->sections[0].name, "liftoff");
        EXPECT_EQ(info->sections[1].name, "flight");
        EXPECT_EQ(info->sections[1].returns_to, 0);
        EXPECT_EQ(info->extras[0].name, "bounces");
        EXPECT_EQ(info->extras[1].name, "loss");
        EXPECT_TRUE(info->parameters[0].valid.holds(unbounded));
        EXPECT_FALSE(info->parameters[0].valid.holds(0.0));
        EXPECT_FALSE(info->parameters[2].valid.holds(1.0));
        EXPECT_TRUE(info->parameters[1].valid.holds(1.0));
    }
}

}  // namespace
}  // namespace hopscotch
