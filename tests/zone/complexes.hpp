// Complexes for the tests of the zone, made from models that meet conformingly.
#pragma once

#include <array>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "core/complex.hpp"
#include "meshgraft/model.hpp"

namespace meshgraft::test {

struct Joined {
  Complex complex;
  GroupSets groups;
  std::vector<std::array<VertexId, 2>> junction_edges;
  std::vector<std::uint8_t> touched;  // by face: has a vertex of a junction edge
};

/// The models as components of one complex; nodes of equal coordinates are one vertex. Edges of more
/// than one component are junction edges.
inline Joined joined(std::span<const Model> models) {
  Joined result;
  Complex& complex = result.complex;
  std::map<std::tuple<double, double, double>, VertexId> vertex_at;
  std::map<std::array<VertexId, 2>, std::vector<std::uint32_t>> components_at;
  std::vector<std::string> names;
  for (std::uint32_t input = 0; input < models.size(); ++input) {
    const Model& model = models[input];
    const auto translated = [&](GroupSetId set) {
      std::vector<GroupId> ids;
      for (const GroupId g : model.group_sets.members(set)) {
        const std::string& name = model.groups[g.value].name;
        auto it = std::ranges::find(names, name);
        if (it == names.end()) it = names.insert(it, name);
        ids.emplace_back(static_cast<std::size_t>(it - names.begin()));
      }
      return result.groups.intern(ids);
    };
    std::vector<VertexId> vertex;
    for (std::size_t n = 0; n < model.n_nodes(); ++n) {
      const Vec3 p = model.position[n];
      const GroupSetId set = translated(model.node_groups[n]);
      const auto [it, is_new] = vertex_at.try_emplace({p.x, p.y, p.z}, VertexId(complex.n_vertices()));
      if (is_new)
        complex.add_vertex(p, {input, NodeId(n)}, VertexState::kOpen, set);
      else
        complex.join_groups(it->second, input, set, result.groups);
      vertex.push_back(it->second);
    }
    for (std::size_t e = 0; e < model.n_elements(); ++e) {
      const auto nodes = model.nodes_of(ElementId(e));
      const auto v = [&](std::size_t k) { return vertex[nodes[k].value]; };
      const GroupSetId set = translated(model.element_groups[e]);
      if (model.shape(ElementId(e)) == Shape::kLine) {
        complex.lines.push_back({{v(0), v(1)}, {input, ElementId(e)}, set, model.element_attributes[e]});
        continue;
      }
      complex.face.push_back({v(0), v(1), v(2)});
      complex.parent.push_back({input, ElementId(e)});
      complex.component.push_back(input);
      complex.face_groups.push_back(set);
      complex.face_attributes.push_back(model.element_attributes[e]);
      for (std::size_t k = 0; k < 3; ++k)
        components_at[{std::min(v(k), v((k + 1) % 3)), std::max(v(k), v((k + 1) % 3))}].push_back(input);
    }
  }
  std::vector<std::uint8_t> on_junction(complex.n_vertices(), 0);
  for (const auto& [edge, components] : components_at)
    if (components.front() != components.back()) {
      result.junction_edges.push_back(edge);
      on_junction[edge[0].value] = on_junction[edge[1].value] = 1;
    }
  for (const auto& face : complex.face)
    result.touched.push_back(on_junction[face[0].value] || on_junction[face[1].value] || on_junction[face[2].value]);
  return result;
}

inline VertexId vertex_at(const Complex& complex, Vec3 p) {
  for (std::size_t v = 0; v < complex.n_vertices(); ++v)
    if (distance(complex.position[v], p) < 1e-9) return VertexId(v);
  return {};
}

}  // namespace meshgraft::test
