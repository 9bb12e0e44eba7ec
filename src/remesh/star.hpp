// What the faces around a vertex cost with the vertex at one place or another.
#pragma once

#include <vector>

#include "meshgraft/vec3.hpp"

namespace meshgraft {

/// A new face must have a larger Q: the sign of its area is then beyond doubt.
inline constexpr double kFlat = 1e-7;

/// What a face costs: little if it is equilateral and of the wanted size, very much if flat; infinite if Q is
/// not larger than kFlat.
double face_cost(double q, double mean_edge, double wanted);

/// The faces around a vertex: all of them that does not change when the vertex moves, so that many places
/// can be tried.
class Star {
 public:
  struct Face {
    Vec3 a, b;                // the other corners, in order
    Vec3 normal;              // the side that it must face, of any length
    double opposite, wanted;  // length of the edge a b; wanted mean edge length
  };
  std::vector<Face> faces;

  /// Sum of the costs with the vertex at p; infinite as soon as it is not less than `enough`.
  [[nodiscard]] double cost(Vec3 p, double enough) const;
  /// 1 - the worst Q; likewise.
  [[nodiscard]] double flatness(Vec3 p, double enough) const;
};

}  // namespace meshgraft
