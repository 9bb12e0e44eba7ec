// Why a face is poor, as far as the input is to blame.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "remesh/result.hpp"

namespace meshgraft {
namespace {

constexpr double kSharpInput = 35;  // degrees between two curves below which the face in the corner suffers
constexpr double kWideInput = 115;  // and above which it does if nothing divides it
constexpr double kTooNear = 0.5;    // share of the wanted length below which fixed vertices are too near

double angle_deg(Vec3 at, Vec3 a, Vec3 b) {
  const Vec3 u = a - at, v = b - at;
  return std::atan2(norm(cross(u, v)), dot(u, v)) * 180 / std::numbers::pi;
}

}  // namespace

Cause cause_of(Editor& editor, FaceId f) {
  using Kind = Cause::Kind;
  const LocalMesh& mesh = editor.mesh();
  const LocalFace& face = mesh.face(f);
  const auto p = mesh.corners(f);
  for (std::size_t k = 0; k < 3; ++k) {
    if (!face.curve[k].valid() || !face.curve[(k + 2) % 3].valid()) continue;
    const double angle = angle_deg(p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
    if (angle < kSharpInput || angle > kWideInput)
      return {Kind::kInputAngle, fmt::format("input angle of {:.0f} degrees", angle)};
  }
  const auto fixed = [&](std::size_t k) { return mesh.vertex(face.v[k]).fixed; };
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    const double d = distance(p[k], p[l]);
    if (fixed(k) && fixed(l) && d < kTooNear * editor.size(face.v[k], face.v[l]))
      return {Kind::kFixedNodes, fmt::format("fixed nodes only {:.3g} apart", d)};
  }
  const auto on_boundary = [&](VertexId v) {
    return std::ranges::any_of(mesh.star(v), [&](FaceId g) { return !mesh.face(g).in_zone; });
  };
  if (std::ranges::any_of(face.v, on_boundary)) return {Kind::kZoneEnd, "boundary of the zone too near"};
  // A strip: the altitude on the longest edge spans two curves.
  const auto bound = [&](std::size_t k) { return mesh.vertex(face.v[k]).dimension != Dimension::kSheet; };
  if (bound(0) && bound(1) && bound(2)) return {Kind::kStrip, "narrow strip between curves"};
  return {};
}

}  // namespace meshgraft
