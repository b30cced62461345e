// All elementary functions of double and pack, for models and for the other arithmetics' overloads.
#pragma once

#include "kernels/elementary/arctangent.hpp"
#include "kernels/elementary/constants.hpp"
#include "kernels/elementary/cube_root.hpp"
#include "kernels/elementary/exponential.hpp"
#include "kernels/elementary/hyperbolic.hpp"
#include "kernels/elementary/logarithm.hpp"
#include "kernels/elementary/sin_cos.hpp"
