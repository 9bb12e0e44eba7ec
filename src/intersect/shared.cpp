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

/// The pairs of some components that are joined.
void add_met(const Joins& joins, std::span<const std::uint32_t> components,
             std::vector<std::array<std::uint32_t, 2>>& met) {
  for (std::size_t i = 0; i < components.size(); ++i)
    for (std::size_t j = i + 1; j < components.size(); ++j)
      if (joins.are_joined(components[i], components[j]))
        met.push_back({std::min(components[i], components[j]), std::max(components[i], components[j])});
}

}  // namespace

std::vector<std::uint8_t> shared_vertices(const Complex& complex) {
  std::vector<FaceId> first(complex.n_vertices());
  std::vector<std::uint8_t> shared(complex.n_vertices());
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    for (const VertexId v : complex.face[f]) {
      if (!first[v.value].valid()) first[v.value] = FaceId(f);
      if (!complex.are_of_the_same(first[v.value], FaceId(f))) shared[v.value] = 1;
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

  std::vector<std::pair<std::array<VertexId, 2>, FaceId>> edge_uses;
  std::vector<std::pair<VertexId, std::uint32_t>> vertex_uses;
  for (std::size_t f = 0; f < complex.n_faces(); ++f) {
    const FaceId id(f);
    if (!complex.layers_of(id).empty()) add_met(complex.joins, complex.components_of(id), out.met);
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = complex.face[f][k], b = complex.face[f][(k + 1) % 3];
      if (!shared[a.value]) continue;
      vertex_uses.emplace_back(a, complex.component[f]);
      for (const Complex::Layer& layer : complex.layers_of(id)) vertex_uses.emplace_back(a, layer.component);
      if (shared[b.value]) edge_uses.push_back({{std::min(a, b), std::max(a, b)}, id});
    }
  }
  make_distinct(edge_uses);
  make_distinct(vertex_uses);

  std::vector<std::uint8_t> on_edge(complex.n_vertices());
  for (std::size_t first = 0, last = 0; first < edge_uses.size(); first = last) {
    const auto& edge = edge_uses[first].first;
    std::vector<std::uint32_t> components;
    bool alike = true;
    for (; last < edge_uses.size() && edge_uses[last].first == edge; ++last) {
      const std::vector<std::uint32_t> of_face = complex.components_of(edge_uses[last].second);
      components.insert(components.end(), of_face.begin(), of_face.end());
      alike = alike && complex.are_of_the_same(edge_uses[first].second, edge_uses[last].second);
    }
    if (alike || !any_joined(complex.joins, components)) continue;
    out.junction_edges.push_back(edge);
    for (const VertexId v : edge) on_edge[v.value] = 1;
  }
  for_each_joined(complex.joins, vertex_uses, [&](VertexId v, std::span<const std::uint32_t> components) {
    if (!on_edge[v.value]) out.junction_points.push_back(v);
    add_met(complex.joins, components, out.met);
  });
  make_distinct(out.met);
}

}  // namespace meshgraft
