// A scene: model + parameters + grid + question + accuracy, read from one TOML file and checked.
// What leaves `read_scene` is complete and consistent; it is passed on as `const scene&` and never
// changed.
#pragma once

#include "host/scene/error.hpp"
#include "kernels/contract/entry.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hopscotch {

enum class axis_kind : std::uint8_t { column, parameter };
enum class axis_scale : std::uint8_t { linear, log };

/// What is left of a grid axis when it is checked; `values_of` (host/scene/grid.hpp) gives its
/// cells.
struct scene_axis {
    std::string name;
    axis_kind kind = axis_kind::column;
    int index = 0;  // among the section's columns or the model's parameters
    double lowest = 0.0;
    double highest = 1.0;
    std::uint64_t cells = 1;
    axis_scale scale = axis_scale::linear;
    bool edges = false;  // samples the end points instead of the cell centres
};

/// One axis of a sweep: a parameter or a fixed start, and the values it takes.
struct sweep_axis {
    std::string name;
    axis_kind kind = axis_kind::parameter;
    int index = 0;  // among the model's parameters or the section's columns
    std::vector<double> values;
    axis_scale scale = axis_scale::linear;
};

/// One map per point; see host/scene/sweep.hpp.
struct scene_sweep {
    std::vector<sweep_axis> axes;
    bool is_zip = false;               // all axes move together
    std::vector<std::uint64_t> point;  // set where the scene is one map of the sweep

    std::uint64_t n_points() const;  // 1 where there is no sweep
};

/// What the map shows. `numbers` holds what only some kinds know (see host/scene/questions.hpp).
struct scene_question {
    std::string place;  // where the scene asks it, for messages
    std::string kind;
    std::uint32_t returns = 1;
    std::map<std::string, double, std::less<>> numbers;
    bool has_labels = false;  // cells are labelled by attractor

    double number(std::string_view name, double otherwise = 0.0) const;
};

/// What `accuracy.tolerance` and `--tolerance` may be: below, rounding rules; above, a step would
/// pass the series' radius of convergence. The meaning: kernels/integrators/taylor.hpp.
inline constexpr double least_tolerance = 1e-16;
inline constexpr double greatest_tolerance = 1e-2;
inline constexpr double standard_tolerance = 1e-10;

struct scene_accuracy {
    std::string place;  // where the precision is set, for messages
    std::string precision = "double";
    std::uint64_t audit_cells = 1000;
    double tolerance = standard_tolerance;  // only where a flow is integrated
    std::uint64_t max_events = 100000;      // steps of work per return before the outcome `budget`
};

struct scene_output {
    std::filesystem::path file;
    std::vector<std::uint64_t> tile;
    bool has_own_tile = false;  // the scene chooses it
    int compression = 4;
    std::vector<std::string> layers;  // names of datasets, see host/scene/layers.hpp
};

struct scene {
    std::string file;  // names the scene in messages
    std::string text;  // as written in the file
    std::vector<std::string> overrides;

    std::string name;
    std::string title;
    std::string reference;

    const model_entry* model = nullptr;
    std::vector<double> parameters;  // one per parameter of the model; NaN = the model derives it
    std::vector<bool> is_given;      // parameters the scene sets (not the axes)
    std::vector<int> options;        // index of the choice, one per option
    int section = 0;
    std::vector<scene_axis> axes;  // the first one is the slowest in memory
    int refine = 0;                // levels of boundary refinement, see host/refine/refinement.hpp
    std::vector<double> start;     // one per column of the section; NaN where the column is an axis

    scene_sweep sweep;
    scene_question question;
    scene_accuracy accuracy;
    scene_output output;
    std::string fingerprint;  // of everything that decides the map's numbers

    const model_info& info() const { return *model->info; }
    const section_info& start_section() const;
    const section_info& end_section() const;  // the one that completed returns are read on
    std::uint64_t n_cells() const;
};

/// Reads, overrides and checks a scene.
///
/// \param overrides  `key=value`, applied before anything is checked
/// \param models     the models a scene may name
/// \error            scene_error for the first mistake found
scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {},
                 std::span<const model_entry* const> models = all_models());

/// The same from text that is already there, as stored in a map.
scene parse_scene(std::string text, std::string file, std::span<const std::string> overrides = {},
                  std::span<const model_entry* const> models = all_models());

}  // namespace hopscotch
