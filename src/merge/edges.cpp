#include "merge/edges.hpp"

#include <algorithm>
#include <cmath>

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

Vec3 across(const Complex& complex, const FaceOnEdge& use) {
  const Vec3 from = complex.position[use.low.value], along = normalized(complex.position[use.high.value] - from);
  Vec3 to;
  for (const VertexId v : complex.face[use.face.value])
    if (v != use.low && v != use.high) to = complex.position[v.value] - from;
  return to - dot(to, along) * along;
}

double fold_angle(const Complex& complex, const FaceOnEdge& a, const FaceOnEdge& b) {
  const Vec3 u = across(complex, a), w = across(complex, b);
  return std::atan2(norm(cross(u, w)), -dot(u, w));
}

}  // namespace meshgraft
