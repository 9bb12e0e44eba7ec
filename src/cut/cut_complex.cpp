#include "cut/cut_complex.hpp"

#include <algorithm>
#include <map>

#include "core/blocks.hpp"
#include "core/buckets.hpp"
#include "core/connected.hpp"
#include "core/distinct.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr double kGrowth = 0.025;  // of its longest side: growth of the box of a face on each side (paper 5.1)

Box box_of(const Triangle& t) {
  Box box;
  for (const Vec3 p : t) box.add(p);
  return box;
}

/// True if all of `t` is farther than `gap` on one side of the plane of `u`.
bool is_beside(const Triangle& t, const Triangle& u, double gap) {
  const Vec3 n = unit_normal(u);
  if (n == Vec3{}) return false;
  const std::array<double, 3> h{dot(n, t[0] - u[0]), dot(n, t[1] - u[0]), dot(n, t[2] - u[0])};
  return std::min({h[0], h[1], h[2]}) > gap || std::max({h[0], h[1], h[2]}) < -gap;
}

/// Sets which mesh each face is of, counted in the order of their first vertices.
///   returns   how many there are
std::uint32_t number_meshes(const Complex& complex, std::vector<std::uint32_t>& mesh) {
  mesh = connected_meshes(complex);
  std::vector<std::uint32_t> first = mesh;
  make_distinct(first);
  for (std::uint32_t& m : mesh) m = static_cast<std::uint32_t>(std::ranges::lower_bound(first, m) - first.begin());
  return static_cast<std::uint32_t>(first.size());
}

/// Adds copies of parts of a tool.
class ToolAdder {
 public:
  ToolAdder(const Model& tool, Complex& complex)
      : tool_(tool),
        complex_(complex),
        faces_at_(tool.n_nodes(),
                  [&](auto&& add) {
                    for (std::size_t f = 0; f < tool.n_elements(); ++f)
                      for (const NodeId n : tool.nodes_of(ElementId(f))) add(n.value, ElementId(f));
                  }),
        vertex_(tool.n_nodes()) {}

  /// The given faces and those that share a node with one of them.
  void add(std::span<const ElementId> near, std::uint32_t component) {
    std::vector<ElementId> faces;
    for (const ElementId f : near)
      for (const NodeId n : tool_.nodes_of(f))
        faces.insert(faces.end(), faces_at_[n.value].begin(), faces_at_[n.value].end());
    make_distinct(faces);
    for (const ElementId f : faces) {
      std::array<VertexId, 3> corners;
      std::ranges::transform(tool_.nodes_of(f), corners.begin(), [&](NodeId n) { return vertex(n); });
      complex_.face.push_back(corners);
      complex_.parent.push_back({kTool, f});
      complex_.component.push_back(component);
      complex_.face_groups.push_back(GroupSets::kEmpty);
      complex_.face_attributes.emplace_back(std::size_t{0});
    }
    for (const ElementId f : faces)
      for (const NodeId n : tool_.nodes_of(f)) vertex_[n.value] = {};
  }

 private:
  VertexId vertex(NodeId n) {
    VertexId& v = vertex_[n.value];
    if (!v.valid()) v = complex_.add_vertex(tool_.position[n.value], {}, VertexState::kOpen, GroupSets::kEmpty);
    return v;
  }

  const Model& tool_;
  Complex& complex_;
  Buckets<ElementId> faces_at_;   // by node of the tool
  std::vector<VertexId> vertex_;  // by node of the tool: of the copy under work
};

/// Each mesh with its own copy, which is the `n`-th component after it.
Joins joins_of_copies(std::uint32_t n) {
  Joins joins;
  joins.mesh.assign(n, 0);
  for (std::uint32_t c = 0; c < n; ++c) joins.mesh.push_back(c + 1), joins.kinds.push_back({c, n + c});
  for (std::uint32_t c = 0; c < n; ++c) joins.kinds.push_back({n + c, c});
  for (std::uint32_t c = 0; c < 2 * n; ++c) joins.kind.push_back(c);
  return joins;
}

}  // namespace

std::vector<NearPair> near_tool(const Model& base, const ToolSurface& surface, const Tolerance& tolerance) {
  const Model& tool = surface.model;
  std::vector<Box> boxes(surface.n_cutting);
  for (std::size_t f = 0; f < boxes.size(); ++f) boxes[f] = box_of(tool.corners(ElementId(f)));
  const BoxTree tree(boxes);
  return collected<NearPair>(base.n_elements(), [&](std::size_t i, std::vector<NearPair>& out) {
    const ElementId e(i);
    if (!base.is_face(e)) return;
    const Triangle t = base.corners(e);
    const Vec3 d = box_of(t).high - box_of(t).low;
    const double gap = std::max(kGrowth * std::max({d.x, d.y, d.z}), tolerance.at(mean_edge_length(t)));
    tree.overlapping(box_of(t).grown(gap), [&](std::uint32_t j) {
      const Triangle u = tool.corners(ElementId(std::size_t{j}));
      if (!is_beside(t, u, gap) && !is_beside(u, t, gap)) out.push_back({e, ElementId(std::size_t{j})});
    });
  });
}

std::vector<ElementId> faces_of_base(std::span<const NearPair> pairs) {
  std::vector<ElementId> faces;
  for (const NearPair& pair : pairs)
    if (faces.empty() || faces.back() != pair.of_base) faces.push_back(pair.of_base);
  return faces;
}

void add_tools(const Model& tool, std::span<const NearPair> pairs, Complex& complex) {
  const std::uint32_t n = number_meshes(complex, complex.component);
  const std::vector<ElementId> of_base = faces_of_base(pairs);
  std::vector<std::uint32_t> mesh(of_base.size());
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    if (const auto at = std::ranges::lower_bound(of_base, complex.parent[f].element);
        at != of_base.end() && *at == complex.parent[f].element)
      mesh[static_cast<std::size_t>(at - of_base.begin())] = complex.component[f];
  std::vector<std::vector<ElementId>> near(n);  // by mesh: faces of the tool
  std::size_t k = 0;
  for (const NearPair& pair : pairs) {
    while (of_base[k] != pair.of_base) ++k;
    near[mesh[k]].push_back(pair.of_tool);
  }
  ToolAdder adder(tool, complex);
  for (std::uint32_t c = 0; c < n; ++c) {
    make_distinct(near[c]);
    adder.add(near[c], n + c);
  }
  complex.joins = joins_of_copies(n);
}

std::uint32_t unite_components(Complex& complex) {
  constexpr std::uint32_t kBaseNow = 0, kToolNow = 1;
  const auto n = static_cast<std::uint32_t>(complex.joins.mesh.size() / 2);
  const auto now = [&](std::uint32_t c) { return c < n ? kBaseNow : kToolNow; };
  for (std::uint32_t& c : complex.component) c = now(c);
  std::map<std::pair<VertexId, std::uint32_t>, GroupSetId> groups;
  for (const auto& [at, set] : complex.component_groups)
    groups.emplace(std::pair{at.first, at.second == Complex::kOwn ? Complex::kOwn : now(at.second)}, set);
  complex.component_groups = std::move(groups);
  complex.joins = {};
  return kToolNow;
}

}  // namespace meshgraft
