// Closest points of points, segments and triangles. Plain double arithmetic: distances, never signs
// that decide topology.
#pragma once

#include <array>

#include "geometry/quality.hpp"
#include "meshgraft/vec3.hpp"

namespace meshgraft {

/// Point on a segment: a + t (b - a), 0 <= t <= 1.
struct SegmentPoint {
  Vec3 point;
  double t = 0;
};
SegmentPoint closest_on_segment(Vec3 p, Vec3 a, Vec3 b);

/// Closest points of two segments; parallel segments give one of the closest pairs.
struct SegmentPair {
  SegmentPoint first, second;
};
SegmentPair closest_between_segments(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1);

/// Point of a triangle with its barycentric coordinates (all >= 0, sum 1).
struct TrianglePoint {
  Vec3 point;
  std::array<double, 3> weight{};
};
/// Also for triangles without area (the closest point of their edges).
TrianglePoint closest_on_triangle(Vec3 p, const Triangle& t);

}  // namespace meshgraft
