// Why an orbit's computation ended: exactly one value per trajectory, never an overloaded number.
// Stored in maps and printed by `eval`; the codes are part of the file format and only ever grow.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace hopscotch {

enum class outcome : std::uint8_t {
    ok,                // all returns asked for were completed
    attracted,         // a certificate or trap decided the label
    stuck,             // permanent contact, no further hop
    rest,              // the orbit is at, or provably tends to, the resting state
    no_contact,        // the leg does not compress at touchdown
    ground,            // the body hits the ground
    energy_deficit,    // lift-off would need more energy than there is (gravity-free stance)
    stumble,           // touchdown cannot be reached with the prescribed leg
    reverse,           // the next touchdown moves backward
    fell,              // the ball or body is lost
    crash,             // the body passes the foot
    sinks,             // overdamped compression without a bottom
    no_liftoff,        // stance has no lift-off
    creep,             // lift-off only after an unphysical time
    over_shoulder,     // the ball passes the robot's shoulder
    off_bar,           // contact beyond the end of the bar
    apex_below,        // the apex lies below the contact point
    downward,          // the ball leaves the impact downward
    invalid_gain,      // the mirror law's gain is outside its domain
    no_hop,            // contact for ever under the clock
    zeno,              // impacts accumulate without a continuation
    escaped,           // the state left every bounded region
    budget,            // the budget of events or returns was spent undecided
    not_finite,        // a non-finite number appeared
    unresolved_event,  // an event could not be located with certainty
    invalid_start,     // the start is outside the section's domain
};

inline constexpr std::array<std::string_view, 26> outcome_names{
    "ok",           "attracted",      "stuck",      "rest",         "no_contact",
    "ground",       "energy_deficit", "stumble",    "reverse",      "fell",
    "crash",        "sinks",          "no_liftoff", "creep",        "over_shoulder",
    "off_bar",      "apex_below",     "downward",   "invalid_gain", "no_hop",
    "zeno",         "escaped",        "budget",     "not_finite",   "unresolved_event",
    "invalid_start"};

constexpr std::string_view name_of(outcome value) {
    return outcome_names[static_cast<std::size_t>(value)];
}

}  // namespace hopscotch
