#include "intersect/shared.hpp"

#include <algorithm>

namespace meshgraft {
namespace {

template <class T>
void make_distinct(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

std::vector<std::uint8_t> shared_vertices(const Complex& complex) {
  std::vector<std::uint32_t> first(complex.n_vertices(), VertexId::kNone);
  std::vector<std::uint8_t> shared(complex.n_vertices());
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    for (const VertexId v : complex.face[f]) {
      if (first[v.value] == VertexId::kNone) first[v.value] = complex.component[f];
      if (first[v.value] != complex.component[f]) shared[v.value] = 1;
    }
  return shared;
}

void find_shared(Corefined& out) {
  const Complex& complex = out.complex;
  const std::vector<std::uint8_t> shared = shared_vertices(complex);

  std::vector<std::pair<std::array<VertexId, 2>, std::uint32_t>> edge_uses;  // with the component
  std::vector<std::pair<VertexId, std::uint32_t>> vertex_uses;
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = complex.face[f][k], b = complex.face[f][(k + 1) % 3];
      if (shared[a.value]) vertex_uses.emplace_back(a, complex.component[f]);
      if (shared[a.value] && shared[b.value])
        edge_uses.push_back({{std::min(a, b), std::max(a, b)}, complex.component[f]});
    }
  make_distinct(edge_uses);
  make_distinct(vertex_uses);

  std::vector<std::uint8_t> on_edge(complex.n_vertices());
  for (std::size_t i = 1; i < edge_uses.size(); ++i) {
    const auto& edge = edge_uses[i].first;
    if (edge != edge_uses[i - 1].first) continue;
    if (out.junction_edges.empty() || out.junction_edges.back() != edge) out.junction_edges.push_back(edge);
    for (const VertexId v : edge) on_edge[v.value] = 1;
  }
  for (std::size_t v = 0; v < shared.size(); ++v)
    if (shared[v] && !on_edge[v]) out.junction_points.push_back(VertexId(v));
  for (std::size_t i = 0; i < vertex_uses.size(); ++i)
    for (std::size_t j = i + 1; j < vertex_uses.size() && vertex_uses[j].first == vertex_uses[i].first; ++j)
      out.met.push_back({vertex_uses[i].second, vertex_uses[j].second});
  make_distinct(out.met);
}

}  // namespace meshgraft
