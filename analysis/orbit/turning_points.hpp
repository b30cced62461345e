// Where the gap between two bodies has its minima and maxima during one phase of an orbit: found
// from the phase's exact states at times of the search's choice, not from samples.
#pragma once

#include "kernels/contract/contact.hpp"

#include <functional>
#include <vector>

namespace hopscotch {

struct turning_point {
    double time = 0.0;  // since the beginning of the phase
    double gap = 0.0;
    bool is_maximum = false;
};

/// The gap over one phase, between its ends. A turning point at the seam of two phases shows in the
/// signs only.
struct phase_course {
    std::vector<turning_point> turning_points;  // by rising time
    int first_sign = 0;                         // of the gap's rate just inside of the beginning
    int last_sign = 0;                          // and of the end; 0 where no gap opens
};

/// All turning points of a gap over (0, duration), its ends and what lies within the rounding of
/// contact left out.
///
/// \param gap       gap and rate at a time; smooth
/// \param rounding  gaps up to this are contact
///
/// The rate is interpolated by Chebyshev polynomials on parts that are halved until the
/// interpolation holds to 1e-11 of the largest rate and until its coefficients show that the part
/// holds no zero, or that the rate is monotone there; a zero is then bracketed on the rate itself.
/// Pairs of zeros are missed only where the rate between them is below that error.
phase_course turning_points(const std::function<contact_gap(double)>& gap, double duration,
                            double rounding);

}  // namespace hopscotch
