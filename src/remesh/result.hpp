// Last step of the remesher: from the working mesh back to a complex, with everything inherited.
#pragma once

#include "remesh/editor.hpp"

namespace meshgraft {

/// The result of remeshing as promised in remesh.hpp.
[[nodiscard]] Remeshed to_remeshed(Editor& editor, const Complex& complex, const Brep& brep,
                                   const std::vector<std::uint8_t>& in_zone, GroupSets& groups);

/// Why a face of the zone cannot be better: an input angle, fixed vertices too near to each other,
/// the boundary of the zone too near. Empty if none of these is seen.
[[nodiscard]] Cause cause_of(Editor& editor, FaceId f);

}  // namespace meshgraft
