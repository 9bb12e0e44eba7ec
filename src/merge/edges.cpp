#include "merge/edges.hpp"

#include <algorithm>
#include <cmath>

#include "core/buckets.hpp"

namespace meshgraft {

std::vector<FaceOnEdge> edge_uses(const Complex& complex, std::span<const std::uint8_t> wanted) {
  const auto is_wanted = [&](VertexId v) { return wanted.empty() || wanted[v.value] != 0; };
  Buckets<FaceOnEdge> by_low(complex.n_vertices(), [&](auto&& add) {
    for (std::size_t f = 0; f < complex.n_faces(); ++f) {
      const auto& v = complex.face[f];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(v[k], v[(k + 1) % 3]);
        if (is_wanted(low) && is_wanted(high)) add(low.value, FaceOnEdge{low, high, FaceId(f)});
      }
    }
  });
  for (std::size_t v = 0; v < by_low.size(); ++v) std::ranges::sort(by_low[v]);  // half a dozen
  return std::move(by_low).take_all();
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
