// Does a model cost for a term that its scene leaves out? Per term: the scene's own compiled
// variant, next to what the same orbits would cost through the general variant with the term set to
// zero; and, where the term has no variant of its own, next to the same kernel with the term.
//
// AVX-512 or the fastest kernel there is, one core, in turn.
#include "bench/model_returns.hpp"
#include "bench/report.hpp"
#include "host/run/backends.hpp"

#include <cstdio>
#include <string_view>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

constexpr std::size_t n_starts = 9600;
constexpr int n_rounds = 15;
constexpr double tolerance = 1e-10;  // the default of scenes

struct term_case {
    std::string_view term;
    std::string_view model;
    std::string_view section;
    named_numbers without;  // parameters of the scene that leaves the term out
    std::vector<std::pair<double, double>> starts;
    int general_variant = -1;  // that carries the term; -1: compare with the term itself instead
    named_numbers with = {};
    named_words options_without = {};
    named_words options_with = {};
    bool wants_time = false;
};

const term_case cases[] = {
    {"times", "passive_hopper", "liftoff", {{"mass_ratio", 1.0}}, {{0.0, 15.0}}, 1},
    {"restitution", "passive_hopper", "liftoff", {{"mass_ratio", 1.0}}, {{0.0, 15.0}}, 2},
    {"damping", "passive_hopper", "liftoff", {{"mass_ratio", 1.0}}, {{0.0, 15.0}}, 3},
    {"nonlinear spring and gravity",
     "passive_hopper",
     "liftoff",
     {{"mass_ratio", 1.0}},
     {{0.0, 15.0}},
     4},
    {"friction", "raibert_pneumatic", "touchdown", {{"friction", 0.0}}, {{0.8, 4.0}}, 0},
    {"times", "raibert_pneumatic", "touchdown", {{"friction", 0.0}}, {{0.8, 4.0}}, 1},
    {"overdamped stances", "raibert_linear", "touchdown", {}, {{0.5, 3.0}}, 1},
    {"times", "raibert_pneumatic_simple", "energy", {{"gain", 2.0}}, {{0.1, 3.0}}, 1},
    {"times", "mirror_line", "apex", {}, {{0.2, 1.0}}, 1},
    {"critical and stronger damping",
     "openloop_hopper",
     "strobe",
     {},
     {{-4.0 / 900, 2.0 / 900}, {-0.1, 0.1}},
     1},
    {.term = "gravity in stance",
     .model = "slip",
     .section = "touchdown",
     .without = {{"touchdown_angle", 1.0}},
     .starts = {{8.0, 12.0}, {0.05, 0.6}},
     .with = {{"touchdown_angle", 1.0}},
     .options_without = {{"stance_gravity", "off"}},
     .options_with = {{"stance_gravity", "on"}}},
    {.term = "leg mass",
     .model = "raibert_pneumatic",
     .section = "touchdown",
     .without = {{"friction", 0.0}},
     .starts = {{0.8, 4.0}},
     .with = {{"friction", 0.0}, {"leg_mass_ratio", 0.25}}},
    {.term = "speed increment",
     .model = "passive_hopper",
     .section = "liftoff",
     .without = {{"mass_ratio", 1.0}},
     .starts = {{0.0, 15.0}},
     .with = {{"mass_ratio", 1.0}, {"speed_increment", 1e-3}}},
};

void measure(const term_case& what) {
    model_returns own(what.model, what.section, what.without, what.options_without,
                      what.wants_time);
    own.set_starts(uniform_rows(n_starts, what.starts));
    const bool has_variant = what.general_variant >= 0;
    model_returns other(what.model, what.section, has_variant ? what.without : what.with,
                        has_variant ? what.options_without : what.options_with, what.wants_time);
    other.set_starts(uniform_rows(n_starts, what.starts));
    if (has_variant) other.use_variant(what.general_variant);
    const backend which = own.backends().front();
    const auto seconds = alternate(
        {[&] { own.compute(which, tolerance); }, [&] { other.compute(which, tolerance); }},
        n_rounds);
    const double scale = 1e9 / static_cast<double>(n_starts);
    const double without = scale * median(seconds[0]);
    const double with = scale * median(seconds[1]);
    json_line("terms")
        .add("model", what.model)
        .add("term", what.term)
        .add("kernel", name_of(which))
        .add("compared_with", has_variant ? "general variant, term set to zero" : "the term")
        .add("ns_per_return_without", without)
        .add("ns_per_return_with", with)
        .add("times_dearer", with / without)
        .print();
    fmt::print("{:<24} {:<30} {:8.1f} ns per return without, {:8.1f} {} ({:.2f} times)\n",
               what.model, what.term, without, with,
               has_variant ? "with it set to zero" : "with it", with / without);
    std::fflush(stdout);
}

}  // namespace
}  // namespace hopscotch::bench

int main() {
    hopscotch::bench::stay_on_this_core();
    for (const auto& what : hopscotch::bench::cases) hopscotch::bench::measure(what);
}
