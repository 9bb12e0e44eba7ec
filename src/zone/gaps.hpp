// Narrow places of sheets: where two curves come close without meeting there.
#pragma once

#include <functional>
#include <vector>

#include "core/complex.hpp"
#include "zone/brep.hpp"
#include "zone/size_field.hpp"
#include "zone/size_limits.hpp"

namespace meshgraft {

/// Sizes that narrow places of the sheets allow (SizeOptions::gap_share and the fields after it).
///
/// Two curves are close at x if the straight way from x to the other one, inside the sheet, is shorter
/// than the size at x, and much shorter than the way along the curves: that separates a strip from the
/// place where the two curves meet.
///
///   size    the size with the limits found so far: what a gap is measured by
///   plain   the size without any: what the floors are shares of, so that limits do not compound
[[nodiscard]] std::vector<SizeLimit> narrow_places(const Complex& complex, const Brep& brep, const SizeOptions& options,
                                                   const std::function<double(SheetId, Vec3)>& size,
                                                   const std::function<double(SheetId, Vec3)>& plain);

}  // namespace meshgraft
