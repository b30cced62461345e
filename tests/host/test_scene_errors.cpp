// Every mistake in a scene is one line that names the place, the key, the value, the reason and a
// way out. The table below holds one bad scene per kind of mistake and the whole line it must give.
#include "host/scene/scene.hpp"
#include "tests/host/fake_model.hpp"

#include <gtest/gtest.h>

using namespace hopscotch;

namespace {

std::string message_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
    try {
        parse_scene(text, "s.toml", overrides, fake::models());
    } catch (const scene_error& error) {
        return error.what();
    }
    return "no error";
}

struct bad_scene {
    const char* what;
    const char* text;
    const char* message;
};

const char* const head = "[model]\nname = \"fake_bouncer\"\n";
const char* const axis = "[[grid.axis]]\nname = \"height\"\nmin = 0.0\nmax = 2.0\ncells = 8\n";
const char* const rest = "[start]\nspeed = 0.0\n[question]\nkind = \"return_map\"\n";

}  // namespace

TEST(scene_errors, a_complete_scene_gives_none) {
    EXPECT_EQ(message_of(std::string(head) + axis + rest), "no error");
}

TEST(scene_errors, a_mistake_in_the_model_is_named_with_line_reason_and_suggestion) {
    const bad_scene table[] = {
        {"syntax", "[model\n", "s.toml:1: not TOML ("},
        {"unknown table", "[modle]\n", "s.toml:1: modle (unknown key); model?"},
        {"no model", "[model]\n",
         "s.toml:1: model.name (a scene names its model); one of fake_bouncer?"},
        {"unknown model", "[model]\nname = \"fake_bounser\"\n",
         "s.toml:2: model.name = \"fake_bounser\" (no such model); fake_bouncer?"},
        {"type", "[model]\nname = 3\n", "s.toml:2: model.name = 3 (text in quotes is needed here)"},
        {"no table", "model = 3\n", "s.toml:1: model = 3 (a table is needed here); [model]?"},
    };
    for (const bad_scene& bad : table) {
        const std::string message = message_of(bad.text);
        EXPECT_EQ(message.substr(0, std::string(bad.message).size()), bad.message) << bad.what;
    }
}

TEST(scene_errors, a_mistake_in_parameters_or_options_is_named) {
    const bad_scene table[] = {
        {"misspelt parameter", "[model.parameters]\ngian = 1\n",
         "s.toml:4: model.parameters.gian = 1 (unknown parameter of fake_bouncer); gain?"},
        {"parameter far off", "[model.parameters]\nzzz = 1\n",
         "s.toml:4: model.parameters.zzz = 1 (unknown parameter of fake_bouncer); one of gain, "
         "offset, "
         "mass_ratio?"},
        {"out of range", "[model.parameters]\ngain = 0.0\n",
         "s.toml:4: model.parameters.gain = 0 (outside (0, 8])"},
        {"infinite where finite", "[model.parameters]\noffset = inf\n",
         "s.toml:4: model.parameters.offset = inf (outside (-inf, inf))"},
        {"NaN", "[model.parameters]\ngain = nan\n",
         "s.toml:4: model.parameters.gain = nan (not a number)"},
        {"text", "[model.parameters]\ngain = \"1\"\n",
         "s.toml:4: model.parameters.gain = \"1\" (a number is needed here)"},
        {"misspelt option", "[model.options]\nlwa = \"plain\"\n",
         "s.toml:4: model.options.lwa = \"plain\" (unknown option of fake_bouncer); law?"},
        {"misspelt choice", "[model.options]\nlaw = \"plane\"\n",
         "s.toml:4: model.options.law = \"plane\" (no such choice); plain?"},
    };
    for (const bad_scene& bad : table) {
        EXPECT_EQ(message_of(std::string(head) + bad.text + axis + rest), bad.message) << bad.what;
    }
}

TEST(scene_errors, infinity_is_legal_where_the_range_holds_it) {
    const std::string text =
        std::string(head) + "[model.parameters]\nmass_ratio = inf\n" + axis + rest;
    EXPECT_EQ(message_of(text), "no error");
}

TEST(scene_errors, a_mistake_in_the_grid_is_named) {
    const bad_scene table[] = {
        {"no axis", "[grid]\nsection = \"apex\"\n",
         "s.toml:3: grid.axis (a grid needs at least one axis); [[grid.axis]]?"},
        {"section", "[grid]\nsection = \"appex\"\n",
         "s.toml:4: grid.section = \"appex\" (no section of fake_bouncer); apex?"},
        {"misspelt key", "[[grid.axis]]\nname = \"height\"\nmn = 0.0\n",
         "s.toml:5: grid.axis[0].mn = 0 (unknown key); min?"},
        {"misspelt name", "[[grid.axis]]\nname = \"hieght\"\n",
         "s.toml:4: grid.axis[0].name = \"hieght\" (no state column of section apex and no "
         "parameter of "
         "fake_bouncer); height?"},
        {"no cells", "[[grid.axis]]\nname = \"height\"\nmin = 0\nmax = 1\ncells = 0\n",
         "s.toml:7: grid.axis[0].cells = 0 (an axis needs at least one cell); remove the axis to "
         "fix its "
         "value?"},
        {"cells missing", "[[grid.axis]]\nname = \"height\"\nmin = 0\nmax = 1\n",
         "s.toml:3: grid.axis[0].cells (how many cells the axis has); cells = 512?"},
        {"cells fractional", "[[grid.axis]]\nname = \"height\"\nmin = 0\nmax = 1\ncells = 1.5\n",
         "s.toml:7: grid.axis[0].cells = 1.5 (a whole number is needed here)"},
        {"empty", "[[grid.axis]]\nname = \"height\"\nmin = 1\nmax = 1\ncells = 4\n",
         "s.toml:6: grid.axis[0].max = 1 (not above min = 1); remove the axis to fix its value?"},
        {"reversed", "[[grid.axis]]\nname = \"height\"\nmin = 2\nmax = 1\ncells = 4\n",
         "s.toml:6: grid.axis[0].max = 1 (not above min = 2); exchange min and max?"},
        {"infinite", "[[grid.axis]]\nname = \"height\"\nmin = 2\nmax = inf\ncells = 4\n",
         "s.toml:6: grid.axis[0].max = inf (the ends of an axis are finite)"},
        {"logarithm",
         "[[grid.axis]]\nname = \"height\"\nmin = 0\nmax = 1\ncells = 4\nscale = \"log\"\n",
         "s.toml:5: grid.axis[0].min = 0 (a logarithmic axis begins above zero); scale = "
         "\"linear\"?"},
        {"scale",
         "[[grid.axis]]\nname = \"height\"\nmin = 0\nmax = 1\ncells = 4\nscale = \"lgo\"\n",
         "s.toml:8: grid.axis[0].scale = \"lgo\" (no such scale); log?"},
        {"one edge",
         "[[grid.axis]]\nname = \"height\"\nmin = 0\nmax = 1\ncells = 1\nedges = true\n",
         "s.toml:7: grid.axis[0].cells = 1 (an axis sampled at its edges needs two cells); edges = "
         "false?"},
        {"parameter range", "[[grid.axis]]\nname = \"gain\"\nmin = 1\nmax = 9\ncells = 100\n",
         "s.toml:6: grid.axis[0].max = 9 (gain outside (0, 8])"},
        {"every start outside", "[[grid.axis]]\nname = \"height\"\nmin = -2\nmax = -1\ncells = 4\n",
         "s.toml:6: grid.axis[0].max = -1 (every height lies outside [0, inf))"},
        {"too fine",
         "[[grid.axis]]\nname = \"height\"\nmin = 1\nmax = 1.0000000000000004\ncells = 9\n",
         "s.toml:7: grid.axis[0].cells = 9 (more cells than distinct numbers between min and max); "
         "fewer "
         "cells?"},
    };
    for (const bad_scene& bad : table) {
        EXPECT_EQ(message_of(std::string(head) + bad.text + rest), bad.message) << bad.what;
    }
}

TEST(scene_errors, the_same_number_from_two_places_is_refused) {
    EXPECT_EQ(message_of(std::string(head) + axis + axis + rest),
              "s.toml:9: grid.axis[1].name = \"height\" (an axis of that name is there already)");
    const std::string both =
        std::string(head) +
        "[model.parameters]\ngain = 1\n[[grid.axis]]\nname = \"gain\"\nmin = 1\n"
        "max = 2\ncells = 3\n[start]\nheight = 1\nspeed = 0\n";
    EXPECT_EQ(message_of(both),
              "s.toml:6: grid.axis[0].name = \"gain\" (set in model.parameters as "
              "well); remove it there or remove the axis?");
    EXPECT_EQ(message_of(std::string(head) + axis + "[start]\nheight = 1\nspeed = 0\n"),
              "s.toml:9: start.height = 1 (an axis as well); remove one of them?");
}

TEST(scene_errors, a_mistake_in_the_start_is_named) {
    const std::string scene = std::string(head) + axis;
    EXPECT_EQ(
        message_of(scene + "[question]\nkind = \"return_map\"\n"),
        "s.toml:1: start.speed (state column of section apex, neither axis nor start); [start] "
        "speed = 0.0?");
    EXPECT_EQ(message_of(scene + "[start]\nspede = 1\n"),
              "s.toml:9: start.spede = 1 (unknown state column of section apex); speed?");
    EXPECT_EQ(message_of(scene + "[start]\nspeed = inf\n"),
              "s.toml:9: start.speed = inf (outside (-inf, inf))");
}

TEST(scene_errors, a_mistake_in_question_accuracy_or_output_is_named) {
    const bad_scene table[] = {
        {"no question", "",
         "s.toml:1: question.kind (a scene asks a question); one of basins, one_sided, "
         "period, return_map, steps_to_fall, lyapunov, orbit_diagram, branch?"},
        {"kind", "[question]\nkind = \"basin\"\n",
         "s.toml:11: question.kind = \"basin\" (no such question); basins?"},
        {"key of the kind", "[question]\nkind = \"basins\"\ntransient = 3\n",
         "s.toml:12: question.transient = 3 (unknown key of the question basins); one of samples, "
         "longest_period, kind, returns?"},
        {"returns", "[question]\nkind = \"basins\"\nreturns = 0\n",
         "s.toml:12: question.returns = 0 (must be at least 1)"},
        {"precision", "[question]\nkind = \"basins\"\n[accuracy]\nprecision = \"duble\"\n",
         "s.toml:13: accuracy.precision = \"duble\" (no such precision); double?"},
        {"tolerance", "[question]\nkind = \"basins\"\n[accuracy]\ntolerance = 0\n",
         "s.toml:13: accuracy.tolerance = 0 (outside [1e-16, 0.01]); 1e-10?"},
        {"layer", "[question]\nkind = \"return_map\"\n[output]\nlayers = [\"label\"]\n",
         "s.toml:13: output.layers = [\"label\"] (no layer \"label\" for the question return_map "
         "on "
         "fake_bouncer); one of outcome, uncertain, returns, events, time, last_height, speed, "
         "bounces?"},
        {"misspelt layer", "[question]\nkind = \"basins\"\n[output]\nlayers = [\"lable\"]\n",
         "s.toml:13: output.layers = [\"lable\"] (no layer \"lable\" for the question basins on "
         "fake_bouncer); \"label\", one of label, period, outcome, uncertain, returns, events, "
         "time, "
         "last_height, "
         "speed, bounces, failing_distance?"},
        {"tile", "[question]\nkind = \"basins\"\n[output]\ntile = [4, 4]\n",
         "s.toml:13: output.tile = [4, 4] (the grid has 1 axes); one number per axis, as 8?"},
        {"compression", "[question]\nkind = \"basins\"\n[output]\ncompression = 10\n",
         "s.toml:13: output.compression = 10 (must be at most 9)"},
    };
    for (const bad_scene& bad : table) {
        const std::string text = std::string(head) + axis + "[start]\nspeed = 0\n" + bad.text;
        EXPECT_EQ(message_of(text), bad.message) << bad.what;
    }
}

TEST(scene_errors, the_models_own_refusal_is_asked_at_every_corner_of_the_parameter_axes) {
    const std::string text =
        std::string(head) +
        "[model.options]\nlaw = \"steep\"\n[[grid.axis]]\nname = \"gain\"\nmin = 1\n"
        "max = 4\ncells = 3\n[start]\nheight = 1\nspeed = 0\n";
    EXPECT_EQ(message_of(text),
              "s.toml:6: grid.axis[0].name = \"gain\" (the steep law needs gain <= 2 at "
              "gain = 3.5); another range?");
    EXPECT_EQ(message_of(std::string(head) +
                         "[model.parameters]\ngain = 3\n[model.options]\nlaw = "
                         "\"steep\"\n" +
                         axis + "[start]\nspeed = 0\n"),
              "s.toml:4: model.parameters.gain = 3 (the steep law needs gain <= 2)");
}

TEST(scene_errors, overrides_are_reported_as_the_command_line) {
    const std::string good = std::string(head) + axis + rest;
    EXPECT_EQ(message_of(good, {"grid.axis.0.cells=0"}),
              "command line: grid.axis[0].cells = 0 (an axis needs at least one cell); remove the "
              "axis to "
              "fix its value?");
    EXPECT_EQ(message_of(good, {"model.parameters.gian=2"}),
              "command line: model.parameters.gian = 2 (unknown parameter of fake_bouncer); gain?");
    EXPECT_EQ(
        message_of(good, {"grid.axis.7.cells=2"}),
        "command line: grid.axis.7.cells = 2 (there are only 1 entries); an index from 0 to 1?");
    EXPECT_EQ(message_of(good, {"cells"}),
              "command line: cells (an override has the form key=value); grid.axis.0.cells=512?");
    EXPECT_EQ(message_of(good, {"model.name.x=2"}),
              "command line: model.name.x = 2 (\"x\" lies inside a plain value)");
}

TEST(scene_errors, a_file_that_is_not_there_is_named) {
    EXPECT_THROW(read_scene("no/such/scene.toml", {}, fake::models()), scene_error);
}
