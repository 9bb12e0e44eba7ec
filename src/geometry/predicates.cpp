#include "geometry/predicates.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace meshgraft {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point(Vec3 p) { return {p.x, p.y, p.z}; }
Kernel::Point_2 point(Vec2 p) { return {p.x, p.y}; }

}  // namespace

int orientation_sign(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  return static_cast<int>(CGAL::orientation(point(a), point(b), point(c), point(d)));
}

int turn_sign(Vec2 a, Vec2 b, Vec2 c) { return static_cast<int>(CGAL::orientation(point(a), point(b), point(c))); }

}  // namespace meshgraft
