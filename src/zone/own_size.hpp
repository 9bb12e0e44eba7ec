// The size that the original faces of a sheet have.
#pragma once

#include <span>
#include <vector>

#include "core/complex.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/quality.hpp"
#include "zone/brep.hpp"

namespace meshgraft {

/// Edge lengths wanted at each vertex of the original faces, linear on each face and constant along the normal: the
/// value at p is that at the nearest point of the faces.
class OwnSize {
 public:
  struct Lengths {
    double size = 0;  // of as many new faces as there were
    double edge = 0;  // mean of the edges there were: what l_a is made of (paper 5.3)
  };
  OwnSize() = default;
  /// Values at the corners of each triangle.
  OwnSize(std::vector<Triangle> triangles, std::vector<std::array<Lengths, 3>> values);
  [[nodiscard]] Lengths at(Vec3 p) const;
  /// Of the sizes.
  [[nodiscard]] double largest() const { return largest_; }

 private:
  std::vector<Triangle> triangles_;
  std::vector<std::array<Lengths, 3>> values_;
  BoxTree tree_;
  double largest_ = 0;
  Lengths uniform_;  // the values are so much alike that no search is worth it: their mean; else 0
};

/// One per sheet, over the parents of its faces. The size is the edge length of equilateral faces of the area of those
/// around each vertex, but not less than `stretched` x their mean edge length: faces longer than wide do not make a
/// sheet much finer along their length. Where the faces picture a bent surface so coarsely that a vertex could stand
/// more than `max_height` of that length above a new face of the size, both lengths are less.
[[nodiscard]] std::vector<OwnSize> own_sizes(const Complex& original, const Complex& complex, const Brep& brep,
                                             double max_height, double stretched);

}  // namespace meshgraft
