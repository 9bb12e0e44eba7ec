// The free edges of a component, by the vertices where they end.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/complex.hpp"

namespace meshgraft {

/// A free edge as seen from one of its ends.
struct End {
  VertexId other;
  FaceId face;
  Vec3 across;  // unit, in the face, away from it
};

using EndsAt = std::map<VertexId, std::vector<End>>;

/// Of the faces `own`, ascending. `owns`: by face of the complex, whether it counts in telling which edges are free.
[[nodiscard]] EndsAt free_ends(const Complex& complex, std::span<const FaceId> own, std::span<const std::uint8_t> owns);

}  // namespace meshgraft
