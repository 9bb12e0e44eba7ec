#include "merge/unsupported.hpp"

#include <algorithm>
#include <optional>

#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"
#include "geometry/predicates.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

/// Half of a quadrilateral, or a triangle.
struct Piece {
  Triangle corners;
  ElementRef element;
};

/// Weights of a point that is inside a triangle, not on its border.
constexpr double kInside = 0.01;

bool is_surface(Shape s) {
  return s == Shape::kTriangle || s == Shape::kTriangle6 || s == Shape::kQuad || s == Shape::kQuad8;
}
bool is_fixed_surface(Shape s) { return is_surface(s) && s != Shape::kTriangle; }

bool has_fixed_surfaces(const Model& model) {
  return std::ranges::any_of(model.attributes, [](const ElementAttributes& a) { return is_fixed_surface(a.shape); });
}

Box box_of(const Triangle& t) {
  Box box;
  for (const Vec3& p : t) box.add(p);
  return box;
}

/// Calls f(element, triangle) for each triangle that the surface elements of input k which `wanted` picks fall into.
template <class Wanted, class F>
void each_triangle(Inputs inputs, std::uint32_t k, Wanted&& wanted, F&& f) {
  const Model& model = *inputs[k];
  for (std::size_t e = 0; e < model.n_elements(); ++e) {
    if (!wanted(model.shape(ElementId(e)))) continue;
    const Corners c = corners_of(model.shape(ElementId(e)), model.nodes_of(ElementId(e)));
    const auto at = [&](std::size_t i) { return model.position[c.node[i].value]; };
    for (std::size_t i = 2; c.is_surface() && i < c.n; ++i)
      f(ElementRef{k, ElementId(e)}, Triangle{at(0), at(i - 1), at(i)});
  }
}

/// Where the components are.
class ComponentBoxes {
 public:
  ComponentBoxes(Inputs inputs, const Components& components) : joins_(components.joins) {
    std::vector<Box> boxes(components.size());
    for (std::uint32_t k = 0; k < inputs.size(); ++k)
      each_triangle(inputs, k, is_surface,
                    [&](ElementRef e, const Triangle& t) { boxes[components.of(e)].add(box_of(t)); });
    tree_ = BoxTree(boxes);
  }
  /// Whether a component that is joined to this one may reach the box.
  [[nodiscard]] bool has_joined(std::uint32_t component, const Box& box) const {
    bool found = false;
    tree_.overlapping(box, [&](std::uint32_t c) { found = found || joins_.are_joined(component, c); });
    return found;
  }

 private:
  const Joins& joins_;
  BoxTree tree_;
};

/// The segment goes through the inside of the triangle. Exact.
bool pierces(Vec3 p, Vec3 q, const Triangle& t) {
  if (orientation_sign(t[0], t[1], t[2], p) * orientation_sign(t[0], t[1], t[2], q) >= 0) return false;
  const int side = orientation_sign(p, q, t[0], t[1]);
  return side != 0 && orientation_sign(p, q, t[1], t[2]) == side && orientation_sign(p, q, t[2], t[0]) == side;
}

std::optional<Vec3> crossing(const Triangle& a, const Triangle& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (pierces(a[k], a[(k + 1) % 3], b)) return midpoint(a[k], a[(k + 1) % 3]);
    if (pierces(b[k], b[(k + 1) % 3], a)) return midpoint(b[k], b[(k + 1) % 3]);
  }
  return {};
}

/// A corner of `by` in the inside of `fixed`, within the tolerance. Corners on its border may be
/// on a triangle beside it, where they can be joined.
std::optional<Vec3> touching(const Triangle& fixed, const Triangle& by, const Tolerance& tolerance) {
  const double reach = tolerance.at(std::min(mean_edge_length(fixed), mean_edge_length(by)));
  for (const Vec3& p : by) {
    const TrianglePoint foot = closest_on_triangle(p, fixed);
    const bool inside = std::ranges::all_of(foot.weight, [&](double w) { return w > kInside; });
    if (inside && distance(p, foot.point) <= reach) return p;
  }
  return {};
}

Failure meeting_of(Inputs inputs, ElementRef fixed, ElementRef other, Vec3 at) {
  return failure(ErrorCode::kUnsupportedElement,
                 text_of(inputs, fixed) + ", which is no three-node triangle, meets " + text_of(inputs, other) +
                     " near " + text_of(at),
                 "split the elements there into three-node triangles; all others may stay as they are",
                 place_of(*inputs[fixed.input], fixed.element));
}

}  // namespace

Result<void> check_meeting_elements(Inputs inputs, const Components& components, const Tolerance& tolerance) {
  if (std::ranges::none_of(inputs, [](const Model* m) { return has_fixed_surfaces(*m); })) return {};
  const ComponentBoxes boxes(inputs, components);
  const auto grown = [&](const Triangle& t) { return box_of(t).grown(tolerance.at(mean_edge_length(t))); };
  std::vector<Piece> fixed, near;
  Box region;
  for (std::uint32_t k = 0; k < inputs.size(); ++k)
    each_triangle(inputs, k, is_fixed_surface, [&](ElementRef e, const Triangle& t) {
      if (!boxes.has_joined(components.of(e), grown(t))) return;
      fixed.push_back({t, e}), region.add(box_of(t));
    });
  if (fixed.empty()) return {};
  std::vector<Box> near_boxes;
  for (std::uint32_t k = 0; k < inputs.size(); ++k)
    each_triangle(inputs, k, is_surface, [&](ElementRef e, const Triangle& t) {
      if (const Box box = grown(t); region.overlaps(box)) near.push_back({t, e}), near_boxes.push_back(box);
    });
  const BoxTree tree(near_boxes);
  for (const Piece& piece : fixed) {
    std::optional<Vec3> at;
    std::uint32_t first = 0xFFFFFFFF;
    tree.overlapping(box_of(piece.corners), [&](std::uint32_t i) {
      if (i >= first || !components.joins.are_joined(components.of(piece.element), components.of(near[i].element)))
        return;
      auto met = crossing(piece.corners, near[i].corners);
      if (!met) met = touching(piece.corners, near[i].corners, tolerance);
      if (met) at = met, first = i;
    });
    if (at) return meeting_of(inputs, piece.element, near[first].element, *at);
  }
  return {};
}

}  // namespace meshgraft
