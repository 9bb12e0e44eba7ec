// How far what stands in a hole may turn away from the surface around it.
#pragma once

#include <cmath>
#include <numbers>

namespace meshgraft {

/// Sine of the angle with the surface up to which an island or a beam is taken to continue it: 20 degrees, up to which
/// faces are taken to lie on each other, too (MergeOptions::contact_angle).
inline const double kSteepest = std::sin(20 * std::numbers::pi / 180);

}  // namespace meshgraft
