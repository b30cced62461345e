// Single cells of a map in higher precision: the start as exact decimals, the traps of its
// parameter point, one orbit. The counterpart of requests.hpp for `verify`, `replay` and the audit.
#pragma once

#include "analysis/orbit/orbit_functions.hpp"
#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hopscotch {

/// An orbit's row with the texts it points to. Movable, not to be copied.
struct owned_row {
    std::vector<std::string> columns;
    std::vector<std::string> parameters;
    std::vector<int> options;
    orbit_row row;
};

/// The decimal that stands for exactly this double, as long as it takes.
std::string exact_decimal(double x);

/// One cell's orbit, labelled as the map's cells are.
owned_row row_of(const scene& scene, const label_plan& plan,
                 std::span<const std::uint64_t> coordinates);

enum class precision : std::uint8_t { binary64, dd, mp50 };

std::string_view name_of(precision value);

/// One cell's row from `row_of`, with the labels of chaotic sets too.
orbit_answer run_cell(const scene& scene, const label_plan& plan,
                      std::span<const std::uint64_t> coordinates, precision value,
                      const orbit_row& row);

/// The same for a cell that the map gives the label `stored`. Rest is decided to the rounding of
/// each arithmetic, and an orbit that approaches it geometrically reaches that after twice as many
/// returns in double-double, after four times as many in 50 digits and their guard digits. So where
/// `stored` means rest and the orbit's returns run out, it is given five times as many.
orbit_answer run_stored_cell(const scene& scene, const label_plan& plan,
                             std::span<const std::uint64_t> coordinates, precision value,
                             const orbit_row& row, int stored);

/// \error std::invalid_argument where the model is built without single orbits
orbit_answer run_orbit(const model_entry& model, precision value, const orbit_row& row);

/// Lyapunov exponents of one cell of a chaos map, in double-double.
/// \error std::invalid_argument where the model is built without single orbits
exponent_answer run_exponents(const scene& scene, const label_plan& plan, const orbit_row& row);

}  // namespace hopscotch
