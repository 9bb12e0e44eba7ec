#include "merge/edges.hpp"

#include <algorithm>

namespace meshgraft {

std::vector<FaceOnEdge> edge_uses(const Complex& complex, std::span<const std::uint8_t> wanted) {
  std::vector<FaceOnEdge> uses;
  const auto is_wanted = [&](VertexId v) { return wanted.empty() || wanted[v.value] != 0; };
  for (std::size_t f = 0; f < complex.n_faces(); ++f) {
    const auto& v = complex.face[f];
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = v[k], b = v[(k + 1) % 3];
      if (is_wanted(a) && is_wanted(b)) uses.push_back({std::min(a, b), std::max(a, b), FaceId(f)});
    }
  }
  std::sort(uses.begin(), uses.end());
  return uses;
}

}  // namespace meshgraft
