#include "intersect/free_ends.hpp"

#include <algorithm>
#include <array>

#include "geometry/quality.hpp"

namespace meshgraft {

EndsAt free_ends(const Complex& complex, std::span<const FaceId> own, std::span<const std::uint8_t> owns) {
  struct Use {
    std::array<VertexId, 2> edge;
    FaceId face;
    bool is_own = false;
  };
  std::vector<std::uint8_t> is_own(complex.n_faces()), near(complex.n_vertices());
  for (const FaceId f : own) {
    is_own[f.value] = 1;
    for (const VertexId v : complex.face[f.value]) near[v.value] = 1;
  }
  std::vector<Use> uses;
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    for (std::size_t k = 0; owns[f] != 0 && k < 3; ++k) {
      const auto [a, b] = std::minmax(complex.face[f][k], complex.face[f][(k + 1) % 3]);
      if (near[a.value] != 0 && near[b.value] != 0) uses.push_back({{a, b}, FaceId(f), is_own[f] != 0});
    }
  std::ranges::stable_sort(uses, {}, &Use::edge);
  EndsAt ends;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const bool alone =
        (i == 0 || uses[i - 1].edge != uses[i].edge) && (i + 1 == uses.size() || uses[i + 1].edge != uses[i].edge);
    if (!alone || !uses[i].is_own) continue;
    const auto [a, b] = uses[i].edge;
    const Triangle t = complex.corners(uses[i].face);
    const Vec3 along = normalized(complex.position[b.value] - complex.position[a.value]);
    const Vec3 inside = centroid(t) - complex.position[a.value];
    const Vec3 across = normalized(dot(inside, along) * along - inside);
    ends[a].push_back({b, uses[i].face, across});
    ends[b].push_back({a, uses[i].face, across});
  }
  return ends;
}

}  // namespace meshgraft
