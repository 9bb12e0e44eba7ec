// What components share once they are conforming.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "intersect/corefine.hpp"

namespace meshgraft {

/// Fills junction_edges, junction_points and met from the complex.
void find_shared(Corefined& corefined);

/// Two faces on the same vertices among the marked ones: kDuplicateFace in one component, kOverlap
/// in two. With the later of the two faces.
std::optional<std::pair<JunctionFault, FaceId>> find_doubled_face(const Complex& complex,
                                                                  std::span<const std::uint8_t> marked);

}  // namespace meshgraft
