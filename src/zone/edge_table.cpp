#include "zone/edge_table.hpp"

#include <algorithm>
#include <tuple>

namespace meshgraft {

EdgeTable::EdgeTable(const Complex& complex)
    : uses_(complex.n_vertices(),
            [&](auto&& add) {
              for (std::size_t i = 0; i < complex.n_faces(); ++i)
                for (std::size_t k = 0; k < 3; ++k) {
                  const VertexId a = complex.face[i][k], b = complex.face[i][(k + 1) % 3], low = std::min(a, b);
                  add(low.value, EdgeUse{low, std::max(a, b), FaceId(i), static_cast<std::uint8_t>(k), a < b});
                }
            }),
      of_(complex.n_faces()) {
  first_of_low_.reserve(uses_.size() + 1);
  for (std::size_t v = 0; v < uses_.size(); ++v) {
    const std::span<EdgeUse> uses = uses_[v];  // half a dozen
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
      return std::tie(a.high, a.face, a.corner) < std::tie(b.high, b.face, b.corner);
    });
    first_of_low_.push_back(static_cast<std::uint32_t>(first_use_.size()));
    for (std::size_t i = 0; i < uses.size(); ++i) {
      if (i == 0 || uses[i].high != uses[i - 1].high)
        first_use_.push_back(uses_.first(v) + static_cast<std::uint32_t>(i));
      of_[uses[i].face.value][uses[i].corner] = EdgeId(first_use_.size() - 1);
    }
  }
  first_of_low_.push_back(static_cast<std::uint32_t>(first_use_.size()));
  first_use_.push_back(static_cast<std::uint32_t>(uses_.all().size()));
}

EdgeId EdgeTable::find(VertexId a, VertexId b) const {
  const auto [low, high] = std::minmax(a, b);
  const std::uint32_t last = first_of_low_[low.value + 1];
  for (std::uint32_t e = first_of_low_[low.value]; e < last; ++e)
    if (uses_.all()[first_use_[e]].high == high) return EdgeId(std::size_t{e});
  return {};
}

VertexFaces::VertexFaces(const Complex& complex)
    : faces_(complex.n_vertices(), [&](auto&& add) {
        for (std::size_t f = 0; f < complex.n_faces(); ++f)
          for (const VertexId v : complex.face[f]) add(v.value, FaceId(f));
      }) {}

}  // namespace meshgraft
