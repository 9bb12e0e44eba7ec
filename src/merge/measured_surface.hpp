// Triangles that distances are measured from.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"

namespace meshgraft {

/// n triangles in any order. Building costs O(n log n), a question O(log n) plus the triangles near the point.
class MeasuredSurface {
 public:
  explicit MeasuredSurface(std::vector<Triangle> faces) : faces_(std::move(faces)) {
    std::vector<Box> boxes(faces_.size());
    for (std::size_t f = 0; f < boxes.size(); ++f)
      for (const Vec3& p : faces_[f]) boxes[f].add(p);
    tree_ = BoxTree(boxes);
  }

  /// Told sooner than the distance.
  [[nodiscard]] bool is_within(Vec3 p, double distance) const {
    Box box;
    box.add(p);
    bool found = false;
    tree_.overlapping(box.grown(distance),
                      [&](std::uint32_t f) { found = found || squared_distance(p, f) <= distance * distance; });
    return found;
  }

  /// Call only if there are triangles.
  [[nodiscard]] double distance(Vec3 p) const {
    const auto nearest = tree_.nearest(p, [&](std::uint32_t f) { return squared_distance(p, f); });
    return std::sqrt(nearest.squared_distance);
  }

  [[nodiscard]] bool empty() const { return tree_.empty(); }

 private:
  [[nodiscard]] double squared_distance(Vec3 p, std::uint32_t f) const {
    return squared_norm(p - closest_on_triangle(p, faces_[f]).point);
  }

  std::vector<Triangle> faces_;
  BoxTree tree_;
};

}  // namespace meshgraft
