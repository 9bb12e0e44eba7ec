// The working mesh of a merge: the faces of all inputs near the junction, as one complex.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "meshgraft/group_sets.hpp"
#include "meshgraft/id.hpp"
#include "meshgraft/vec3.hpp"

namespace meshgraft {

using VertexId = Id<struct VertexTag>;
using FaceId = Id<struct FaceTag>;

/// How far a vertex of a Complex may be changed.
enum class VertexState : std::uint8_t {
  kOpen,    // all its faces are in the complex: it may move, be removed, or get new faces
  kPinned,  // all its faces are in the complex, but it must stay where it is (other elements use
            // it, the user protects it)
  kFrozen,  // some of its faces may be missing: neither it nor any face on it may change
};

/// Which components of a complex are joined where they meet, and which hang together before. By
/// default each is a mesh of its own and is joined to every other.
struct Joins {
  std::vector<std::uint32_t> mesh;                  // by component: alike where they share nodes in the input
  std::vector<std::uint32_t> kind;                  // by component; if empty, meshes are joined to each other
  std::vector<std::array<std::uint32_t, 2>> kinds;  // that are joined, both ways, ascending

  [[nodiscard]] std::uint32_t mesh_of(std::uint32_t component) const {
    return mesh.empty() ? component : mesh[component];
  }
  [[nodiscard]] bool are_joined(std::uint32_t a, std::uint32_t b) const {
    if (kind.empty()) return mesh_of(a) != mesh_of(b);
    return a != b && std::binary_search(kinds.begin(), kinds.end(), std::array{kind[a], kind[b]});
  }
};

/// n vertices, m faces, k lines. Edges may have any number of faces; orientation of neighbours may
/// differ. Group sets are of merged groups (Graft::groups), so they compare across inputs.
struct Complex {
  std::vector<Vec3> position;             // n
  std::vector<NodeRef> node;              // n, the input node it is; invalid: a new one
  std::vector<VertexState> state;         // n
  std::vector<GroupSetId> vertex_groups;  // n, node groups, whatever component they come from
  /// The same by component, for vertices in which components meet and which are in any group: a
  /// group of one mesh goes on along that mesh only. kOwn stands for the components that have the
  /// vertex in the input. See groups_on.
  static constexpr std::uint32_t kOwn = 0xFFFFFFFF;
  std::map<std::pair<VertexId, std::uint32_t>, GroupSetId> component_groups;

  std::vector<std::array<VertexId, 3>> face;  // m
  std::vector<ElementRef> parent;             // m, the input face it descends from
  std::vector<std::uint32_t> component;       // m, faces of one component are not intersected
  std::vector<GroupSetId> face_groups;        // m
  std::vector<AttributesId> face_attributes;  // m, equal ids = equal attributes, across inputs

  /// Another input face that lies on a face, of another component: where meshes overlap, one layer of
  /// faces stands for all.
  struct Layer {
    std::uint32_t component = 0;
    ElementRef parent;
    GroupSetId groups = GroupSets::kEmpty;
    AttributesId attributes;
    friend constexpr auto operator<=>(const Layer&, const Layer&) = default;
  };
  using Layers = std::vector<Layer>;  // ascending
  std::vector<Layers> layers;         // m, or empty where nothing overlaps; face_groups holds their groups too

  /// A 1D element with two nodes.
  struct Line {
    std::array<VertexId, 2> ends;
    ElementRef parent;
    GroupSetId groups;
    AttributesId attributes;
  };
  std::vector<Line> lines;  // k

  /// Edges of the complex that belong to an element which is not remeshed (quadrilateral, parabolic
  /// triangle): both ends are pinned and the edge may not be split or removed.
  std::vector<std::array<VertexId, 2>> fixed_edges;

  Joins joins;  // of the components

  [[nodiscard]] std::size_t n_vertices() const { return position.size(); }
  [[nodiscard]] std::size_t n_faces() const { return face.size(); }
  [[nodiscard]] std::array<Vec3, 3> corners(FaceId f) const {
    const auto& v = face[f.value];
    return {position[v[0].value], position[v[1].value], position[v[2].value]};
  }

  /// Node groups that a vertex is in as a point of one component.
  [[nodiscard]] GroupSetId groups_on(std::uint32_t of, VertexId v) const {
    if (!has_component_groups(v)) return vertex_groups[v.value];
    auto groups = component_groups.find({v, of});
    if (groups == component_groups.end()) groups = component_groups.find({v, kOwn});
    return groups == component_groups.end() ? GroupSets::kEmpty : groups->second;
  }
  /// The vertex is a point of that component too, in these groups.
  void join_groups(VertexId v, std::uint32_t of, GroupSetId groups, GroupSets& sets) {
    GroupSetId& all = vertex_groups[v.value];
    const GroupSetId before = all;
    all = sets.unite(all, groups);
    if (all == GroupSets::kEmpty) return;
    if (!has_component_groups(v) && node[v.value].valid()) component_groups[{v, kOwn}] = before;
    GroupSetId& own = component_groups.try_emplace({v, of}, GroupSets::kEmpty).first->second;
    own = sets.unite(own, groups);
  }

  /// Exchanges the faces of two complexes with all that goes with each.
  void swap_faces(Complex& other) {
    face.swap(other.face), parent.swap(other.parent), component.swap(other.component);
    face_groups.swap(other.face_groups), face_attributes.swap(other.face_attributes), layers.swap(other.layers);
  }
  /// What lies on a face.
  [[nodiscard]] std::span<const Layer> layers_of(FaceId f) const {
    return layers.empty() ? std::span<const Layer>{} : std::span<const Layer>(layers[f.value]);
  }
  /// The components a face is of: its own, then those of its layers.
  [[nodiscard]] std::vector<std::uint32_t> components_of(FaceId f) const {
    std::vector<std::uint32_t> all{component[f.value]};
    for (const Layer& layer : layers_of(f)) all.push_back(layer.component);
    return all;
  }
  [[nodiscard]] bool are_of_the_same(FaceId f, FaceId g) const {
    if (layers_of(f).empty() && layers_of(g).empty()) return component[f.value] == component[g.value];
    return std::ranges::is_permutation(components_of(f), components_of(g));
  }

  VertexId add_vertex(Vec3 p, NodeRef of, VertexState s, GroupSetId groups) {
    position.push_back(p), node.push_back(of), state.push_back(s), vertex_groups.push_back(groups);
    return VertexId(position.size() - 1);
  }
  /// A face like `like` of `from` (which may be this complex) on other vertices.
  FaceId add_face(std::array<VertexId, 3> v, const Complex& from, FaceId like) {
    face.push_back(v);
    parent.push_back(ElementRef(from.parent[like.value]));
    component.push_back(std::uint32_t(from.component[like.value]));
    face_groups.push_back(GroupSetId(from.face_groups[like.value]));
    face_attributes.push_back(AttributesId(from.face_attributes[like.value]));
    if (!from.layers.empty()) layers.push_back(Layers(from.layers[like.value]));
    return FaceId(face.size() - 1);
  }

 private:
  [[nodiscard]] bool has_component_groups(VertexId v) const {
    const auto it = component_groups.lower_bound({v, 0});
    return it != component_groups.end() && it->first.first == v;
  }
};

}  // namespace meshgraft
