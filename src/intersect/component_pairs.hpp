// Which faces of a complex come near faces of other components.
#pragma once

#include <span>
#include <vector>

#include "intersect/meeting.hpp"

namespace meshgraft {

/// Faces of one component and faces of those joined before it that come near each other. Ascending.
struct NearFaces {
  std::vector<FaceId> earlier, own;
};

/// By component: the faces that may come within twice their snap length of each other, also once
/// vertices have moved by up to that length. Only of components that are joined.
/// `size`: by face, its mean edge length. `rank`: by component, its place in the order in which they are joined.
/// Cost n log n plus what overlaps.
[[nodiscard]] std::vector<NearFaces> near_faces(const Complex& complex, std::span<const double> size,
                                                const SnapRule& rule, std::span<const std::uint32_t> rank);

/// Ascending.
[[nodiscard]] std::vector<std::uint32_t> ranks_by_id(const Complex& complex);

}  // namespace meshgraft
