// A tool given as a mesh.
#include <algorithm>

#include "cut/tool_surface.hpp"
#include "merge/inputs.hpp"

namespace meshgraft {
namespace {

/// One face on one edge of the tool.
struct EdgeUse {
  NodeId low, high;
  bool forward = true;
  ElementId face;
  friend auto operator<=>(const EdgeUse&, const EdgeUse&) = default;
};

std::vector<EdgeUse> edges_of(const Model& model) {
  std::vector<EdgeUse> uses;
  for (std::size_t f = 0; f < model.n_elements(); ++f) {
    const auto v = model.nodes_of(ElementId(f));
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId a = v[k], b = v[(k + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), a < b, ElementId(f)});
    }
  }
  std::ranges::sort(uses);
  return uses;
}

/// Sets `closed`; an open surface has to be manifold and oriented.
Result<void> look_at_edges(const Model& from, ToolSurface& tool) {
  const std::vector<EdgeUse> uses = edges_of(tool.model);
  tool.closed = true;
  const EdgeUse* bad = nullptr;
  for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
    while (j < uses.size() && uses[j].low == uses[i].low && uses[j].high == uses[i].high) ++j;
    if ((j - i) % 2 != 0) tool.closed = false;
    if (bad == nullptr && (j - i > 2 || (j - i == 2 && uses[i].forward == uses[i + 1].forward))) bad = &uses[i];
  }
  if (tool.closed || bad == nullptr) return {};
  const Vec3 at = midpoint(tool.model.position[bad->low.value], tool.model.position[bad->high.value]);
  return failure(ErrorCode::kNotSeparated,
                 "the sides of " + from.path + " cannot be told: it is open, and at " + text_of(at) +
                     " its faces branch or are oriented against each other",
                 "orient the faces alike, or close the surface", {from.path, 0});
}

}  // namespace

Result<ToolSurface> mesh_tool(const Model& from) {
  ModelBuilder builder;
  std::vector<NodeId> ids;
  for (std::size_t v = 0; v < from.n_nodes(); ++v)
    ids.push_back(builder.add_node(from.position[v], from.node_label[v]));
  ElementAttributes triangle;
  triangle.shape = Shape::kTriangle;
  bool any = false;
  for (std::size_t e = 0; e < from.n_elements(); ++e) {
    const Shape shape = from.shape(ElementId(e));
    if (shape == Shape::kTriangle6 || shape == Shape::kQuad8)
      return failure(
          ErrorCode::kUnsupportedElement,
          "element " + std::to_string(from.element_label[e]) + " of " + from.path + " is parabolic and cannot cut",
          "give the tool as linear triangles or quadrilaterals", place_of(from, ElementId(e)));
    if (shape != Shape::kTriangle && shape != Shape::kQuad) continue;
    const Corners c = corners_of(shape, from.nodes_of(ElementId(e)));
    for (std::size_t k = 2; k < c.n; ++k, any = true)
      builder.add_element(triangle, std::array{ids[c.node[0].value], ids[c.node[k - 1].value], ids[c.node[k].value]},
                          from.element_label[e]);
  }
  if (!any)
    return failure(ErrorCode::kNoFaces, from.path + " has no triangles or quadrilaterals to cut with",
                   "mesh the surface of the tool", {from.path, 0});
  ToolSurface tool;
  tool.model = builder.build(from.path);
  tool.model.units = from.units, tool.model.coordinate_systems = from.coordinate_systems;
  tool.n_cutting = tool.model.n_elements();
  const auto good = look_at_edges(from, tool);
  if (!good) return Failure(good.error());
  return tool;
}

}  // namespace meshgraft
