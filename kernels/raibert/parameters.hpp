// Rows of the parameter tables that Raibert's hoppers share, with either spring. Source:
// models/raibert_hopper.md section 2; Koditschek, Buehler 1991.
#pragma once

#include "kernels/contract/info.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::raibert::row {

inline constexpr parameter_info thrust{"thrust", "tau",    "m/s^2",
                                       41.86,    positive, "force of the thrust"};
inline constexpr parameter_info thrust_time{"thrust_time", "delta",      "s",
                                            0.01,          non_negative, "duration of the thrust"};
inline constexpr parameter_info friction{"friction", "gamma",      "1/s",
                                         2.33,       non_negative, "viscous friction in stance"};
inline constexpr parameter_info stance_gravity{"stance_gravity",   "g", "m/s^2", 10.0, non_negative,
                                               "gravity in stance"};
inline constexpr parameter_info flight_gravity{"flight_gravity",   "g_f", "m/s^2", 10.0, positive,
                                               "gravity in flight"};
inline constexpr parameter_info leg_mass_ratio{
    "leg_mass_ratio", "mu'", "1", 0.0, non_negative, "mass of the leg over mass of the body"};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::raibert::row
