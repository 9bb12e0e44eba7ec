// Two plates that lie on each other, and what must be true of them after they became one.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "intersect/corefine.hpp"
#include "meshgraft/model.hpp"

namespace meshgraft::checks {

/// A base of 6 by 6 with a corner at the origin, and a plate on it, over it or partly beside it. Lengths are in
/// edges of the base.
struct PlatePair {
  double x = 0, y = 0;                 // corner of the plate
  double length = 3, width = 2;        // of the plate
  double turn = 0;                     // of the plate about the normal of the base. Radians
  double size = 1;                     // edge length of the plate
  double height = 0;                   // of the plate above the base
  double lean = 0;                     // height of the far corner of the plate above the near one
  double base_jitter = 0, jitter = 0;  // of inner nodes, share of the edge length
  double noise = 0;                    // by which all nodes are shaken, far below the tolerance
  double tilt = 0;                     // of both, about the x-axis. Radians
  bool staggered = false;              // rows of equilateral triangles instead of squares with diagonals
};

[[nodiscard]] std::vector<Model> models(const PlatePair& pair);

/// What may be snapped: the tolerance of 1 % of the smaller edge length.
[[nodiscard]] double tolerance(const PlatePair& pair);

/// How far a point is inside the base and inside the plate, seen along their normal; negative outside.
[[nodiscard]] std::array<double, 2> depths(const PlatePair& pair, Vec3 p);

/// Area that base and plate have in common.
[[nodiscard]] double common_area(const PlatePair& pair);

/// What is wrong with two plates after corefinement, up to what may be snapped:
///   no face turned over, none twice on its vertices, no edge with a third face;
///   a face stands for both plates exactly where they have common area;
///   the groups of base and plate cover what they covered.
[[nodiscard]] std::vector<std::string> faults(const PlatePair& pair, const std::vector<Model>& models,
                                              const Corefined& after, const GroupSets& sets);

/// What is wrong where the base was to be kept: common area left twice or taken out of both, an edge with a third
/// face, a node of the base that moved, a base face cut elsewhere than where the borders of base and plate cross.
[[nodiscard]] std::vector<std::string> faults_of_kept_base(const PlatePair& pair, const std::vector<Model>& models,
                                                           const Corefined& after);

/// Area of the faces that stand for two.
[[nodiscard]] double layered_area(const Complex& complex);

/// As a literal, to make a test of it.
[[nodiscard]] std::string to_string(const PlatePair& pair);

}  // namespace meshgraft::checks
