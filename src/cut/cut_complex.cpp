#include "cut/cut_complex.hpp"

#include <algorithm>

#include "core/blocks.hpp"
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

struct NearPair {
  ElementId of_base, of_tool;
};

/// The marked faces and those that share a node with one of them, ascending.
std::vector<ElementId> with_neighbours(const Model& tool, const std::vector<std::uint8_t>& marked) {
  std::vector<std::uint8_t> at_node(tool.n_nodes());
  for (std::size_t f = 0; f < marked.size(); ++f)
    if (marked[f] != 0)
      for (const NodeId n : tool.nodes_of(ElementId(f))) at_node[n.value] = 1;
  std::vector<ElementId> faces;
  for (std::size_t f = 0; f < marked.size(); ++f)
    if (std::ranges::any_of(tool.nodes_of(ElementId(f)), [&](NodeId n) { return at_node[n.value] != 0; }))
      faces.emplace_back(f);
  return faces;
}

}  // namespace

FacesToCut near_faces(const Model& base, const ToolSurface& surface, const Tolerance& tolerance) {
  const Model& tool = surface.model;
  std::vector<Box> boxes(surface.n_cutting);
  for (std::size_t f = 0; f < boxes.size(); ++f) boxes[f] = box_of(tool.corners(ElementId(f)));
  const BoxTree tree(boxes);
  const auto pairs = collected<NearPair>(base.n_elements(), [&](std::size_t i, std::vector<NearPair>& out) {
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
  FacesToCut near;
  std::vector<std::uint8_t> marked(tool.n_elements());
  for (const NearPair& pair : pairs) {
    if (near.of_base.empty() || near.of_base.back() != pair.of_base) near.of_base.push_back(pair.of_base);
    marked[pair.of_tool.value] = 1;
  }
  near.of_tool = with_neighbours(tool, marked);
  return near;
}

std::uint32_t add_tool(const Model& tool, std::span<const ElementId> faces, Complex& complex) {
  std::uint32_t component = 0;
  for (const std::uint32_t c : complex.component) component = std::max(component, c + 1);
  std::vector<VertexId> vertex(tool.n_nodes());
  for (const ElementId f : faces) {
    std::array<VertexId, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId n = tool.nodes_of(f)[k];
      VertexId& v = vertex[n.value];
      if (!v.valid()) v = complex.add_vertex(tool.position[n.value], {}, VertexState::kOpen, GroupSets::kEmpty);
      corners[k] = v;
    }
    complex.face.push_back(corners);
    complex.parent.push_back({kTool, f});
    complex.component.push_back(component);
    complex.face_groups.push_back(GroupSets::kEmpty);
    complex.face_attributes.emplace_back(std::size_t{0});
  }
  return component;
}

}  // namespace meshgraft
