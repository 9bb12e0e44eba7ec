// The area that two faces have in common, as seen along the normal of one of them.
#pragma once

#include <vector>

#include "geometry/quality.hpp"
#include "intersect/meeting.hpp"

namespace meshgraft {

/// The part of `u` over `t` and no farther than `beside` from there, seen along the normal of t: a convex polygon.
[[nodiscard]] std::vector<Vec3> part_over(const Triangle& u, const Triangle& t, double beside = 0);

/// The part of a convex polygon at these heights above the plane of `t`.
[[nodiscard]] std::vector<Vec3> within(std::vector<Vec3> polygon, const Triangle& t, const Reach& heights);

[[nodiscard]] double area_of(const std::vector<Vec3>& polygon);
/// The largest distance between two corners.
[[nodiscard]] double diameter(const std::vector<Vec3>& polygon);

}  // namespace meshgraft
