#include "intersect/shared.hpp"

#include <algorithm>
#include <span>

#include "core/distinct.hpp"

namespace meshgraft {
namespace {

/// Calls f(vertex, components) for each vertex that components have which are joined. `uses`: ascending.
template <class F>
void for_each_joined(const Joins& joins, const std::vector<std::pair<VertexId, std::uint32_t>>& uses, F&& f) {
  std::vector<std::uint32_t> components;
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
    components.clear();
    for (; last < uses.size() && uses[last].first == uses[first].first; ++last) components.push_back(uses[last].second);
    if (any_joined(joins, components)) f(uses[first].first, std::span<const std::uint32_t>(components));
  }
}

}  // namespace

std::vector<std::uint8_t> shared_vertices(const Complex& complex) {
  constexpr std::array<std::uint32_t, 2> kNone{VertexId::kNone, VertexId::kNone};
  std::vector<std::array<std::uint32_t, 2>> first(complex.n_vertices(), kNone);
  std::vector<std::uint8_t> shared(complex.n_vertices());
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    for (const VertexId v : complex.face[f]) {
      const auto components = complex.components_of(FaceId(f));
      if (first[v.value] == kNone) first[v.value] = components;
      if (first[v.value] != components) shared[v.value] = 1;
    }
  return shared;
}

bool any_joined(const Joins& joins, std::span<const std::uint32_t> components) {
  for (std::size_t i = 0; i < components.size(); ++i)
    for (std::size_t j = i + 1; j < components.size(); ++j)
      if (joins.are_joined(components[i], components[j])) return true;
  return false;
}

void find_shared(Corefined& out) {
  const Complex& complex = out.complex;
  const std::vector<std::uint8_t> shared = shared_vertices(complex);

  using Components = std::array<std::uint32_t, 2>;
  std::vector<std::pair<std::array<VertexId, 2>, Components>> edge_uses;
  std::vector<std::pair<VertexId, std::uint32_t>> vertex_uses;
  for (std::size_t f = 0; f < complex.n_faces(); ++f) {
    const Components components = complex.components_of(FaceId(f));
    if (components[0] != components[1]) out.met.push_back(components);
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = complex.face[f][k], b = complex.face[f][(k + 1) % 3];
      if (shared[a.value])
        for (const std::uint32_t c : components) vertex_uses.emplace_back(a, c);
      if (shared[a.value] && shared[b.value]) edge_uses.push_back({{std::min(a, b), std::max(a, b)}, components});
    }
  }
  make_distinct(edge_uses);
  make_distinct(vertex_uses);

  std::vector<std::uint8_t> on_edge(complex.n_vertices());
  for (std::size_t first = 0, last = 0; first < edge_uses.size(); first = last) {
    const auto& edge = edge_uses[first].first;
    std::vector<std::uint32_t> components;
    for (; last < edge_uses.size() && edge_uses[last].first == edge; ++last)
      components.insert(components.end(), edge_uses[last].second.begin(), edge_uses[last].second.end());
    if (last - first < 2 || !any_joined(complex.joins, components)) continue;
    out.junction_edges.push_back(edge);
    for (const VertexId v : edge) on_edge[v.value] = 1;
  }
  for_each_joined(complex.joins, vertex_uses, [&](VertexId v, std::span<const std::uint32_t> components) {
    if (!on_edge[v.value]) out.junction_points.push_back(v);
    for (std::size_t i = 0; i < components.size(); ++i)
      for (std::size_t j = i + 1; j < components.size(); ++j)
        if (complex.joins.are_joined(components[i], components[j])) out.met.push_back({components[i], components[j]});
  });
  make_distinct(out.met);
}

}  // namespace meshgraft
