// Wanted edge length at every place of the zone (paper 5.3: l_a along the line, the meshes' own
// size away from it, a graded transition between).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "geometry/box_tree.hpp"
#include "zone/brep.hpp"

namespace meshgraft {

struct SizeOptions {
  std::optional<double> junction_size;  // instead of l_a
  double gradation = 0.4;               // change of size per unit of length
  double gap_share = 1.0;               // size allowed between two curves, as a share of their distance
};

class SizeField {
 public:
  /// `original`: the complex before corefinement (its faces tell the meshes' own sizes);
  /// `complex`, `brep`: after it.
  SizeField(const Complex& original, const Complex& complex, const Brep& brep, const SizeOptions& options);

  /// Wanted edge length at `p` in a sheet. Cost O(log n).
  [[nodiscard]] double at(SheetId sheet, Vec3 p) const;
  /// On a curve: agrees between all sheets at it.
  [[nodiscard]] double on_curve(CurveId curve, Vec3 p) const;
  /// l_a near `p`: mean edge length of the touched faces of both meshes there.
  [[nodiscard]] double junction_size(Vec3 p) const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace meshgraft
