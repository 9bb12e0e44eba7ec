#include "geometry/triangle_surface.hpp"

#include <array>
#include <optional>

#include "geometry/predicates.hpp"

namespace meshgraft {
namespace {

/// 1 if the segment goes through the inside of the triangle, 0 if they do not touch; nothing if it
/// touches the plane or an edge, so that another segment has to tell.
std::optional<int> crossings(Vec3 p, Vec3 q, const Triangle& t) {
  const int at_p = orientation_sign(t[0], t[1], t[2], p), at_q = orientation_sign(t[0], t[1], t[2], q);
  if (at_p != 0 && at_p == at_q) return 0;
  std::array<int, 3> side{};
  for (std::size_t k = 0; k < 3; ++k) side[k] = orientation_sign(p, q, t[k], t[(k + 1) % 3]);
  const bool positive = side[0] > 0 || side[1] > 0 || side[2] > 0, negative = side[0] < 0 || side[1] < 0 || side[2] < 0;
  if (positive && negative) return 0;
  if (at_p == 0 || at_q == 0 || side[0] == 0 || side[1] == 0 || side[2] == 0) return std::nullopt;
  return 1;
}

}  // namespace

TriangleSurface::TriangleSurface(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  std::vector<Box> boxes(triangles_.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (const Vec3 p : triangles_[i]) boxes[i].add(p);
    box_.add(boxes[i]);
  }
  tree_ = BoxTree(boxes);
}

bool TriangleSurface::crosses(Vec3 p, Vec3 q) const {
  Box way;
  way.add(p), way.add(q);
  bool found = false;
  tree_.overlapping(way, [&](std::uint32_t i) { found = found || crossings(p, q, triangles_[i]) == 1; });
  return found;
}

bool TriangleSurface::contains(Vec3 p) const {
  if (!box_.contains(p)) return false;
  // Far points in slightly different directions; a segment that meets an edge is not counted, and only
  // finitely many of them can. 1 and the two roots have no rational relation.
  constexpr double kTilt = 1.0 / 64;
  constexpr int kMostAttempts = 64;  // a point on the surface is never clear
  const double away = 2 * box_.diagonal();
  for (int attempt = 1;; ++attempt) {
    const Vec3 q = p + away * Vec3{1, kTilt * attempt * 1.4142135623730951, kTilt * attempt * 1.7320508075688772};
    Box way;
    way.add(p), way.add(q);
    bool odd = false, clear = true;
    tree_.overlapping(way, [&](std::uint32_t i) {
      const std::optional<int> n = crossings(p, q, triangles_[i]);
      if (!n)
        clear = false;
      else if (*n == 1)
        odd = !odd;
    });
    if (clear || attempt == kMostAttempts) return odd;
  }
}

}  // namespace meshgraft
