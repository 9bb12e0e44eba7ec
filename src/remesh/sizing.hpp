// Wanted edge lengths as the remesher asks for them.
#pragma once

#include <functional>

#include "zone/brep.hpp"
#include "zone/size_field.hpp"

namespace meshgraft {

/// Two questions instead of a SizeField, so that a test can answer them by a formula.
struct Sizing {
  std::function<double(SheetId, Vec3)> in_sheet;
  std::function<double(CurveId, Vec3)> on_curve;  // agrees between all sheets at the curve
};

/// The answers of a size field, which must outlive it.
[[nodiscard]] inline Sizing sizing_of(const SizeField& size) {
  return {[&](SheetId s, Vec3 p) { return size.at(s, p); }, [&](CurveId c, Vec3 p) { return size.on_curve(c, p); }};
}

}  // namespace meshgraft
