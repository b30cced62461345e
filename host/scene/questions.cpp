// The table of question kinds.
#include "host/scene/questions.hpp"

#include <array>

namespace hopscotch {
namespace {

using names = std::string_view;

constexpr std::array<names, 3> label_layers{"label", "outcome", "returns"};
constexpr std::array<names, 4> one_sided_layers{"label", "immediate", "outcome", "returns"};
constexpr std::array<names, 4> period_layers{"period", "label", "outcome", "returns"};
constexpr std::array<names, 2> state_layers{"state", "outcome"};
constexpr std::array<names, 3> fall_layers{"returns", "outcome", "time"};
constexpr std::array<names, 4> exponent_layers{"motion", "lyapunov", "lyapunov_error", "outcome"};

constexpr std::array<question_number, 2> diagram_numbers{
    {{"transient", 1000.0, 0.0, true}, {"sweeps", 1.0, 0.0, true}}};
// 120 returns per block: a multiple of most short periods
constexpr std::array<question_number, 5> exponent_numbers{{{"transient", 1000.0, 1.0, true},
                                                           {"block", 120.0, 1.0, true},
                                                           {"min_blocks", 16.0, 8.0, true},
                                                           {"error", 0.0, 0.0, false},
                                                           {"significance", 3.0, 0.0, false}}};

// samples: cells to search attractors from at every parameter point, 0 for as many as suit their
// number
constexpr std::array<question_number, 2> search{
    {{"samples", 0.0, 0.0, true}, {"longest_period", 64.0, 1.0, true}}};
constexpr std::array<question_number, 4> continuation{{{"period", 1.0, 1.0, true},
                                                       {"doublings", 1.0, 0.0, true},
                                                       {"step", 0.01, 1e-6, false},
                                                       {"settling", 200.0, 0.0, true}}};

constexpr std::array<question_kind, 8> kinds{{
    {"basins", "the attractor that each start tends to", true, true, 2000, search, label_layers},
    {"one_sided", "the basins, for orbits that attract from one side only", true, true, 2000,
     search, one_sided_layers},
    {"period", "the period of the attractor that each start tends to", true, true, 2000, search,
     period_layers},
    {"return_map",
     "the state after the given number of returns",
     false,
     true,
     1,
     {},
     state_layers,
     1000,
     false},
    {"steps_to_fall",
     "how many returns are completed before the orbit ends",
     false,
     true,
     1000,
     {},
     fall_layers},
    {"lyapunov", "Lyapunov exponents, and whether orbits move chaotically", false, true, 10000,
     exponent_numbers, exponent_layers, 50},
    {"orbit_diagram", "the states that orbits settle on, over a parameter", false, true, 200,
     diagram_numbers, state_layers, 0, false},
    {"branch", "periodic orbits continued over a parameter", false, false, 1, continuation,
     state_layers},
}};

}  // namespace

std::span<const question_kind> question_kinds() { return kinds; }

const question_kind* find_question(std::string_view name) {
    for (const question_kind& kind : kinds) {
        if (kind.name == name) return &kind;
    }
    return nullptr;
}

}  // namespace hopscotch
