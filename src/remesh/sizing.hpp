// Wanted edge lengths as the remesher asks for them.
#pragma once

#include <functional>

#include "zone/brep.hpp"
#include "zone/size_field.hpp"

namespace meshgraft {

/// A few questions instead of a SizeField, so that a test can answer them by a formula.
struct Sizing {
  std::function<double(SheetId, Vec3)> in_sheet;
  std::function<double(CurveId, Vec3)> on_curve;  // agrees between all sheets at the curve
  /// How far new edges may stand off a curve, whatever their length.
  std::function<double(CurveId)> slack = [](CurveId) { return 0.0; };
};

/// The answers of a size field, which must outlive it.
[[nodiscard]] inline Sizing sizing_of(const SizeField& size) {
  return {[&](SheetId s, Vec3 p) { return size.at(s, p); }, [&](CurveId c, Vec3 p) { return size.on_curve(c, p); },
          [&](CurveId c) { return size.slack(c); }};
}

}  // namespace meshgraft
