// Whether a surface is crossed, and whether points are inside it.
#pragma once

#include <span>
#include <vector>

#include "geometry/box_tree.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {

/// Triangles, whatever their orientation. Building costs O(n log n), a question O(log n) plus the
/// triangles in the way.
class TriangleSurface {
 public:
  explicit TriangleSurface(std::vector<Triangle> triangles);

  /// True if the segment goes through the inside of a triangle. Exact.
  [[nodiscard]] bool crosses(Vec3 p, Vec3 q) const;

  /// REQUIRES: closed, that is, every edge has an even number of triangles.
  /// True if a path from `p` to infinity crosses the surface an odd number of times. Exact; for a point
  /// on the surface either answer may come.
  [[nodiscard]] bool contains(Vec3 p) const;

 private:
  std::vector<Triangle> triangles_;
  BoxTree tree_;
  Box box_;
};

}  // namespace meshgraft
