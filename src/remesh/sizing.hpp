// Wanted edge lengths as the remesher asks for them.
#pragma once

#include <functional>

#include "zone/brep.hpp"

namespace meshgraft {

/// Two questions instead of a SizeField, so that a test can answer them by a formula.
struct Sizing {
  std::function<double(SheetId, Vec3)> in_sheet;
  std::function<double(CurveId, Vec3)> on_curve;  // agrees between all sheets at the curve
};

}  // namespace meshgraft
