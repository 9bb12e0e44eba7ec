#include "zone/edge_table.hpp"

#include <algorithm>
#include <tuple>

namespace meshgraft {

EdgeTable::EdgeTable(const Complex& complex) : of_(complex.n_faces()) {
  // A counting sort by the smaller end leaves buckets of half a dozen uses to sort.
  std::vector<std::uint32_t> first(complex.n_vertices() + 1, 0);
  const auto each_use = [&](auto&& f) {
    for (std::size_t i = 0; i < complex.n_faces(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const VertexId a = complex.face[i][k], b = complex.face[i][(k + 1) % 3];
        f(EdgeUse{std::min(a, b), std::max(a, b), FaceId(i), static_cast<std::uint8_t>(k), a < b});
      }
  };
  each_use([&](const EdgeUse& use) { ++first[use.low.value + 1]; });
  for (std::size_t v = 0; v + 1 < first.size(); ++v) first[v + 1] += first[v];
  uses_.resize(3 * complex.n_faces());
  std::vector<std::uint32_t> next(first.begin(), first.end());
  each_use([&](const EdgeUse& use) { uses_[next[use.low.value]++] = use; });

  first_of_low_.reserve(first.size());
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    const auto begin = uses_.begin() + first[v], end = uses_.begin() + first[v + 1];
    std::sort(begin, end, [](const EdgeUse& a, const EdgeUse& b) {
      return std::tie(a.high, a.face, a.corner) < std::tie(b.high, b.face, b.corner);
    });
    first_of_low_.push_back(static_cast<std::uint32_t>(first_use_.size()));
    for (auto use = begin; use != end; ++use) {
      if (use == begin || use->high != (use - 1)->high)
        first_use_.push_back(static_cast<std::uint32_t>(use - uses_.begin()));
      of_[use->face.value][use->corner] = EdgeId(first_use_.size() - 1);
    }
  }
  first_of_low_.push_back(static_cast<std::uint32_t>(first_use_.size()));
  first_use_.push_back(static_cast<std::uint32_t>(uses_.size()));
}

EdgeId EdgeTable::find(VertexId a, VertexId b) const {
  const auto [low, high] = std::minmax(a, b);
  const std::uint32_t last = first_of_low_[low.value + 1];
  for (std::uint32_t e = first_of_low_[low.value]; e < last; ++e)
    if (uses_[first_use_[e]].high == high) return EdgeId(std::size_t{e});
  return {};
}

VertexFaces::VertexFaces(const Complex& complex) : first_(complex.n_vertices() + 1, 0), faces_(3 * complex.n_faces()) {
  for (const auto& face : complex.face)
    for (const VertexId v : face) ++first_[v.value + 1];
  for (std::size_t v = 0; v + 1 < first_.size(); ++v) first_[v + 1] += first_[v];
  std::vector<std::uint32_t> next(first_.begin(), first_.end());
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    for (const VertexId v : complex.face[f]) faces_[next[v.value]++] = FaceId(f);
}

}  // namespace meshgraft
