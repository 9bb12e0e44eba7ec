// Places where what is to be joined meets at elements that cannot be remeshed.
#pragma once

#include "core/components.hpp"
#include "merge/inputs.hpp"
#include "meshgraft/options.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

/// kUnsupportedElement if a surface element that is no three-node triangle (quadrilateral,
/// parabolic) crosses a surface element of a component that its own is joined to, or has a node of one in its inside
/// within the tolerance. Otherwise such a meeting would be passed over in silence.
///
/// Parabolic elements are taken by their corners, quadrilaterals as two triangles.
/// Cost: nothing where all surfaces are triangles; else one pass and a search near the others' boxes.
[[nodiscard]] Result<void> check_meeting_elements(Inputs inputs, const Components& components,
                                                  const Tolerance& tolerance);

}  // namespace meshgraft
