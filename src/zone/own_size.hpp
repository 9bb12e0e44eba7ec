// The edge length that the original faces of a sheet have.
#pragma once

#include <span>
#include <vector>

#include "core/complex.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/quality.hpp"
#include "zone/brep.hpp"

namespace meshgraft {

/// Wanted edge length at each vertex of the original faces, linear on each face and constant along the normal: the
/// value at p is that at the nearest point of the faces.
class OwnSize {
 public:
  OwnSize() = default;
  /// Values at the corners of each triangle.
  OwnSize(std::vector<Triangle> triangles, std::vector<std::array<double, 3>> values);
  [[nodiscard]] double at(Vec3 p) const;
  [[nodiscard]] double largest() const { return largest_; }

 private:
  std::vector<Triangle> triangles_;
  std::vector<std::array<double, 3>> values_;
  BoxTree tree_;
  double largest_ = 0;
  bool uniform_ = false;  // then no search
};

/// One per sheet, over the parents of its faces: the mean edge length of the faces around each vertex. Where the
/// faces picture a bent surface so coarsely that a vertex could stand more than `max_height` of that length above a
/// new face of the size, less.
[[nodiscard]] std::vector<OwnSize> own_sizes(const Complex& original, const Complex& complex, const Brep& brep,
                                             double max_height);

}  // namespace meshgraft
