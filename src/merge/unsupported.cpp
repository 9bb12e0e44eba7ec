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

Box box_of(const Model& model) {
  Box box;
  for (const Vec3& p : model.position) box.add(p);
  return box;
}

/// Pieces of the surface elements of input k that `wanted` picks by shape and that are near one of `boxes`.
template <class F>
void collect(Inputs inputs, std::uint32_t k, F&& wanted, std::span<const Box> boxes, const Tolerance& tolerance,
             std::vector<Piece>& pieces) {
  const Model& model = *inputs[k];
  for (std::size_t e = 0; e < model.n_elements(); ++e) {
    const Shape shape = model.shape(ElementId(e));
    if (!wanted(shape)) continue;
    const Corners c = corners_of(shape, model.nodes_of(ElementId(e)));
    if (!c.is_surface()) continue;
    const auto at = [&](std::size_t i) { return model.position[c.node[i].value]; };
    for (std::size_t i = 2; i < c.n; ++i) {
      const Triangle t{at(0), at(i - 1), at(i)};
      const Box box = box_of(t).grown(tolerance.at(mean_edge_length(t)));
      if (std::ranges::any_of(boxes, [&](const Box& b) { return b.overlaps(box); }))
        pieces.push_back({t, {k, ElementId(e)}});
    }
  }
}

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

Result<void> check_meeting_elements(Inputs inputs, const Tolerance& tolerance) {
  if (std::ranges::none_of(inputs, [](const Model* m) { return has_fixed_surfaces(*m); })) return {};
  std::vector<Box> boxes;
  for (const Model* model : inputs) boxes.push_back(box_of(*model));
  for (std::uint32_t k = 0; k < inputs.size(); ++k) {
    if (!has_fixed_surfaces(*inputs[k])) continue;
    std::vector<Box> others = boxes;
    others.erase(others.begin() + k);
    std::vector<Piece> fixed, near;
    collect(inputs, k, is_fixed_surface, others, tolerance, fixed);
    if (fixed.empty()) continue;
    Box region;
    for (const Piece& p : fixed) region.add(box_of(p.corners));
    for (std::uint32_t j = 0; j < inputs.size(); ++j)
      if (j != k) collect(inputs, j, is_surface, std::span(&region, 1), tolerance, near);
    std::vector<Box> near_boxes;
    for (const Piece& p : near)
      near_boxes.push_back(box_of(p.corners).grown(tolerance.at(mean_edge_length(p.corners))));
    const BoxTree tree(near_boxes);
    for (const Piece& piece : fixed) {
      std::optional<Vec3> at;
      std::uint32_t first = 0xFFFFFFFF;
      tree.overlapping(box_of(piece.corners), [&](std::uint32_t i) {
        if (i >= first) return;
        auto met = crossing(piece.corners, near[i].corners);
        if (!met) met = touching(piece.corners, near[i].corners, tolerance);
        if (met) at = met, first = i;
      });
      if (at) return meeting_of(inputs, piece.element, near[first].element, *at);
    }
  }
  return {};
}

}  // namespace meshgraft
