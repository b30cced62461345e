// hopscotch render FILE.h5: a picture of a map.
#include "analysis/render/render.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/sweep_point.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hopscotch {
namespace {

struct render_arguments {
    std::string file;
    std::string point;
    std::string picture;
    std::string layer;
};

int render(const render_arguments& given) {
    std::filesystem::path picture = given.picture;
    if (picture.empty()) picture = std::filesystem::path(given.file).replace_extension(".png");
    render_map(given.file, picture, given.layer);
    fmt::print("{}\n", picture.string());
    return exit_done;
}

}  // namespace

void add_render(CLI::App& program, int& exit_code) {
    auto given = std::make_shared<render_arguments>();
    CLI::App* command = program.add_subcommand("render", "Draw a map");
    command->add_option("file", given->file, "Map file (HDF5)")->required();
    add_point(*command, given->point);
    command->add_option("-o,--output", given->picture, "Picture; FILE.png if not given");
    command->add_option("--layer", given->layer, "Layer to draw; the label if not given");
    command->callback([given, &exit_code] {
        given->file = chosen_map(given->file, given->point);
        exit_code = render(*given);
    });
}

}  // namespace hopscotch
