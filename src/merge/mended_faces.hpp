// Triangles without area: those that are no longer there because they were in the zone, and those that are still there.
#pragma once

#include <vector>

#include "merge/outcome.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

/// The warning mended-face for each input that had some: how many, and the first. Cost linear in the elements removed.
[[nodiscard]] std::vector<Warning> mended_face_warnings(const Outcome& outcome);

/// The warning flat-face for each input that still has some: how many, and the first. Cost linear in the elements.
[[nodiscard]] std::vector<Warning> flat_face_warnings(const Outcome& outcome);

}  // namespace meshgraft
