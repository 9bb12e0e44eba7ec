// Which faces of a complex hang together.
#pragma once

#include <cstdint>
#include <vector>

#include "core/complex.hpp"
#include "core/union_find.hpp"

namespace meshgraft {

/// By face: the first vertex of the connected mesh that it is in, whatever its component; faces are connected by
/// shared vertices.
[[nodiscard]] inline std::vector<std::uint32_t> connected_meshes(const Complex& complex) {
  UnionFind sets(complex.n_vertices());
  for (const auto& [a, b, c] : complex.face) sets.unite(a.value, b.value), sets.unite(a.value, c.value);
  std::vector<std::uint32_t> mesh;
  mesh.reserve(complex.n_faces());
  for (const auto& corners : complex.face) mesh.push_back(sets.find(corners[0].value));
  return mesh;
}

}  // namespace meshgraft
