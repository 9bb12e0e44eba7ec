#include "intersect/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/quality.hpp"
#include "intersect/common_area.hpp"

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
double least_width(const Meeting& m, const FacePair& p) {
  const double size = std::min(m.size[m.side[0].face(p[0]).value], m.size[m.side[1].face(p[1]).value]);
  return std::max(kStrip * tolerance(m, p), kNarrow * size);
}

/// The part of `u` that lies over `t` and within `gap` of its plane.
std::vector<Vec3> part_near(const Triangle& u, const Triangle& t, double gap) {
  return within(part_over(u, t), t, {-gap, gap});
}

/// Area over length: about half the width of a long polygon, a third of the side of a round one.
double mean_width(const std::vector<Vec3>& polygon) {
  double longest = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    for (std::size_t j = i + 1; j < polygon.size(); ++j) longest = std::max(longest, distance(polygon[i], polygon[j]));
  return longest > 0 ? area_of(polygon) / longest : 0;
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
    if (are_flat_to_each_other(t, u, options) && mean_width(part_near(u, t, gap)) > least_width(m, p)) return p;
  }
  return std::nullopt;
}

JunctionFault overlap_fault(const Meeting& m, const FacePair& faces) {
  const FaceId f = m.side[0].face(faces[0]), g = m.side[1].face(faces[1]);
  const std::vector<Vec3> shared = part_near(m.triangle(1, faces[1]), m.triangle(0, faces[0]), 2 * tolerance(m, faces));
  Vec3 at = centroid(m.triangle(1, faces[1]));
  if (!shared.empty()) {
    at = {};
    for (const Vec3 p : shared) at += p / static_cast<double>(shared.size());
  }
  return {ErrorCode::kOverlap,
          "faces lie on each other over an area",
          {m.complex.parent[f.value], m.complex.parent[g.value]},
          at};
}

}  // namespace meshgraft
