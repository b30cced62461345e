// One lane of the passive hopper stepped by hand, so that tests can set and read the distance to
// the lossless point that the lane itself keeps.
#pragma once

#include "kernels/models/passive_hopper.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::passive_lane {

inline constexpr int plastic_variant = 1;

struct hand_stepped {
    passive::hopper_lane<double> lane;
    double ended = 0.0;

    /// alpha = alpha*_k + beta.
    hand_stepped(int k, double beta, double mass_ratio, double increment = 0.0) {
        const double parameters[] = {mass_ratio, 0.0, 0.0, increment, 0.0, 0.0, 0.0};
        passive::clear_lane(lane, parameters);
        passive::enter_cell(lane, static_cast<double>(k), true);
        lane.beta = beta;
        passive::launch_from_section(lane, true);
    }

    /// One return; false where the orbit ends.
    bool hop() {
        unwatched watch;
        for (;;) {
            const progress<double> done = passive_hopper::step<plastic_variant>(lane, true, watch);
            ended = done.ended;
            if (done.returned || done.ended != 0.0) return done.returned;
        }
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive_lane
