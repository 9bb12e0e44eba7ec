#include "intersect/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

/// Planes at this angle and more diverge so soon that being near each other is a strip along their
/// line, not an area. Radians.
constexpr double kDiverging = 9.0 / 180.0 * std::numbers::pi;
constexpr double kStrip = 3;  // snap lengths: contacts no wider than this are a line
/// Share of the edge length: no face fits into a strip that is narrower, on either side of the line.
constexpr double kNarrow = 0.2;

bool are_flat_to_each_other(const Triangle& t, const Triangle& u, const CorefineOptions& options) {
  const double angle = std::min(options.contact_angle, kDiverging);
  return std::abs(dot(unit_normal(t), unit_normal(u))) > std::cos(angle);
}

/// The tolerance between two faces, also where gaps are left open: an overlap is never accepted.
double tolerance(const Meeting& m, const FacePair& p) {
  return m.rule.at(std::min(m.size[m.side[0].face(p[0]).value], m.size[m.side[1].face(p[1]).value])).feature;
}

/// Width from which two faces lie on each other. Faces that cross are within the tolerance along a strip: only if it
/// is as wide as the new faces will be do these lie on each other.
double least_width(const Meeting& m, const FacePair& p, const CorefineOptions& options) {
  const double size = std::min(m.size[m.side[0].face(p[0]).value], m.size[m.side[1].face(p[1]).value]);
  const double strip = kStrip * tolerance(m, p);
  return options.mode == Mode::kAuto ? std::max(strip, kNarrow * size) : strip;
}

/// A corner of a clipped polygon: its place and its signed distance from the plane of the clipper.
struct Corner {
  Vec3 point;
  double height = 0;
};

/// The part of a convex polygon where `inside` (linear in place and height) is not negative.
template <class F>
std::vector<Corner> clipped(const std::vector<Corner>& polygon, F&& inside) {
  std::vector<Corner> left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner& a = polygon[i];
    const Corner& b = polygon[(i + 1) % polygon.size()];
    const double at_a = inside(a), at_b = inside(b);
    if (at_a >= 0) left.push_back(a);
    if ((at_a < 0) == (at_b < 0)) continue;
    const double t = at_a / (at_a - at_b);
    left.push_back({lerp(a.point, b.point, t), a.height + t * (b.height - a.height)});
  }
  return left;
}

/// The part of `u` that lies over `t` and within `gap` of its plane.
std::vector<Corner> part_near(const Triangle& u, const Triangle& t, double gap) {
  const Vec3 n = unit_normal(t);
  std::vector<Corner> polygon;
  for (const Vec3 p : u) polygon.push_back({p, dot(n, p - t[0])});
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 a = t[k], inward = cross(n, t[(k + 1) % 3] - a);
    polygon = clipped(polygon, [&](const Corner& c) { return dot(inward, c.point - a); });
  }
  polygon = clipped(polygon, [&](const Corner& c) { return gap - c.height; });
  return clipped(polygon, [&](const Corner& c) { return gap + c.height; });
}

/// Area over length: about half the width of a long polygon, a third of the side of a round one.
double mean_width(const std::vector<Corner>& polygon) {
  if (polygon.size() < 3) return 0;
  Vec3 sum;
  double longest = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    for (std::size_t j = i + 1; j < polygon.size(); ++j)
      longest = std::max(longest, distance(polygon[i].point, polygon[j].point));
    if (i > 0)
      sum +=
          0.5 * cross(polygon[i].point - polygon[0].point, polygon[(i + 1) % polygon.size()].point - polygon[0].point);
  }
  return longest > 0 ? norm(sum) / longest : 0;
}

}  // namespace

bool is_area(const Meeting& m, const FacePair& faces, double thickness, const CorefineOptions& options) {
  return thickness > kStrip * tolerance(m, faces) &&
         are_flat_to_each_other(m.triangle(0, faces[0]), m.triangle(1, faces[1]), options);
}

std::optional<FacePair> find_overlap(const Meeting& m, const CorefineOptions& options) {
  for (const FacePair& p : m.pairs) {
    const Triangle t = m.triangle(0, p[0]), u = m.triangle(1, p[1]);
    const double gap = tolerance(m, p);
    if (are_flat_to_each_other(t, u, options) && mean_width(part_near(u, t, gap)) > least_width(m, p, options))
      return p;
  }
  return std::nullopt;
}

JunctionFault overlap_fault(const Meeting& m, const FacePair& faces) {
  const FaceId f = m.side[0].face(faces[0]), g = m.side[1].face(faces[1]);
  const std::vector<Corner> shared =
      part_near(m.triangle(1, faces[1]), m.triangle(0, faces[0]), 2 * tolerance(m, faces));
  Vec3 at = centroid(m.triangle(1, faces[1]));
  if (!shared.empty()) {
    at = {};
    for (const Corner& c : shared) at += c.point / static_cast<double>(shared.size());
  }
  return {ErrorCode::kOverlap,
          "faces lie on each other over an area",
          {m.complex.parent[f.value], m.complex.parent[g.value]},
          at};
}

}  // namespace meshgraft
