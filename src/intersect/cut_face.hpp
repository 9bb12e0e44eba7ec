// Cuts one face along what is imprinted on it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/complex.hpp"

namespace meshgraft {

/// A face with points on its edges and inside, and segments between points.
struct FaceToCut {
  std::array<VertexId, 3> corner;
  std::array<std::vector<VertexId>, 3> on_edge;   // from corner k to the next, in order, without ends
  std::vector<VertexId> inside;                   // distinct
  std::vector<std::array<VertexId, 2>> segments;  // between any of these; only ends are shared
};

/// Triangles over exactly the given points, in which every piece of an edge and every segment is an
/// edge, oriented like the face. Signs are exact in the projection along the main axis of the
/// face's normal, where none is inverted or flat. Nothing if segments cross.
std::optional<std::vector<std::array<VertexId, 3>>> cut(const FaceToCut& face, std::span<const Vec3> position);

}  // namespace meshgraft
