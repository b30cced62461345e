// The scenes that wrong shares are measured on: one per model, more where a model has several kinds
// of kernels. Returns are cut short where the truth would take minutes.
#include "bench/labelled_cells.hpp"

namespace hopscotch::bench {

// A general solver meets no sticking ball (paddle) and no thrust cut off by lift-off (pneumatic
// leg): their scenes are the kernels' alone.
const std::vector<labelled_scene>& labelled_scenes() {
    static const std::vector<labelled_scene> all{
        {"passive_hopper, plastic", "quickstart", {"question.returns=200"}, "passive_hopper M=1"},
        {"passive_hopper, energy added", "chatterjee2002_fig8", {"question.returns=200"}, ""},
        {"passive_hopper, nonlinear",
         "chatterjee2002_nonlinear",
         {"question.returns=20"},
         "",
         true},
        {"passive_juggler",
         "quickstart",
         {"model.name=passive_juggler", "question.returns=200"},
         ""},
        {"raibert_pneumatic", "koditschek1991_crisis", {"question.returns=40"}, "", true},
        {"openloop_hopper", "cham2007_fig8_basins", {"question.returns=100"}, "openloop_hopper"},
        {"slip", "ghigliazza2005_basins", {"question.returns=200"}, ""},
        {"slip, gravity in stance",
         "ghigliazza2005_gravity_basins",
         {"question.returns=30", "grid.axis.1.cells=20"},
         "slip, gravity in stance",
         true},
        {"slip_pitching", "ghigliazza2005_fig5", {"question.returns=4"}, "", true, true},
        {"mirror_line", "rizzi1994_line", {"question.returns=300"}, ""},
        {"mirror_planar", "rizzi1994_planar_basin", {}, "mirror_planar, solvable law"},
        {"mirror_spatial", "rizzi1994_spatial_basin", {}, ""},
        {"paddle_juggler", "paddle_sticking", {"question.returns=40"}, ""},
        {"relief_valve",
         "relief_valve_basins",
         {"grid.axis.0.cells=8", "question.samples=16", "question.returns=40"},
         "relief_valve",
         true,
         true},
    };
    return all;
}

}  // namespace hopscotch::bench
