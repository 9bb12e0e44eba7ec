// The surface that free edges end on.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {

/// Faces of a complex, which must outlive it.
class LandingSurface {
 public:
  static constexpr double kLeastSine = 0.1;  // of the angle between a way and the surface, where it ends on that

  LandingSurface(const Complex& complex, std::span<const FaceId> faces) : complex_(complex), faces_(faces) {
    std::vector<Box> boxes(faces.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (const Vec3 p : complex.corners(faces[i])) boxes[i].add(p);
    tree_ = BoxTree(boxes);
  }

  struct Foot {
    FaceId face;  // invalid: none is within the limit
    Vec3 point;
  };
  /// `counts`: of a face, by its normal.
  template <class F>
  [[nodiscard]] Foot nearest(Vec3 p, double limit, F&& counts) const {
    const auto squared_distance = [&](std::uint32_t i) {
      const Triangle t = complex_.corners(faces_[i]);
      if (!counts(unit_normal(t))) return std::numeric_limits<double>::infinity();
      return squared_norm(p - closest_on_triangle(p, t).point);
    };
    const auto found = tree_.nearest(p, squared_distance, limit * limit);
    if (!found.found()) return {};
    const FaceId f = faces_[found.item];
    return {f, closest_on_triangle(p, complex_.corners(f)).point};
  }

  struct Hit {
    double way = 0;  // signed
    Vec3 point, normal;
  };
  /// The nearest place, within `reach` either way, where the line through p along the unit vector u goes
  /// through the surface.
  [[nodiscard]] std::optional<Hit> along(Vec3 p, Vec3 u, double reach, double slack) const {
    std::optional<Hit> best;
    Box way;
    way.add(p - reach * u), way.add(p + reach * u);
    tree_.overlapping(way.grown(slack), [&](std::uint32_t i) {
      const Triangle t = complex_.corners(faces_[i]);
      const Vec3 n = unit_normal(t);
      const double sine = dot(n, u);
      if (std::abs(sine) < kLeastSine) return;
      const double s = dot(n, t[0] - p) / sine;
      if (std::abs(s) > reach || (best && std::abs(s) >= std::abs(best->way))) return;
      const Vec3 at = closest_on_triangle(p + s * u, t).point;
      if (distance(at, p + s * u) <= slack) best = Hit{s, at, n};
    });
    return best;
  }

 private:
  const Complex& complex_;
  std::span<const FaceId> faces_;
  BoxTree tree_;
};

}  // namespace meshgraft
