// Why a face is poor, as far as the input is to blame.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "geometry/quality.hpp"
#include "remesh/result.hpp"
#include "zone/size_field.hpp"

namespace meshgraft {
namespace {

constexpr double kSharpInput = 35;  // degrees between two curves below which the face in the corner suffers
constexpr double kWideInput = 115;  // and above which it does if nothing divides it
constexpr double kUnlike = 4;       // ratio of edges at a corner from which no face there need have Q 0.5
constexpr double kTooNear = 0.5;    // share of the wanted length below which fixed vertices are too near

double angle_deg(Vec3 at, Vec3 a, Vec3 b) {
  const Vec3 u = a - at, v = b - at;
  return std::atan2(norm(cross(u, v)), dot(u, v)) * 180 / std::numbers::pi;
}

/// Angle between the curves of a corner that both bound the face, each by a vertex of it: the least of all
/// such corners. Faces in a narrow corner need not reach its tip.
std::optional<double> least_corner_deg(const Editor& editor, const LocalFace& face) {
  const LocalMesh& mesh = editor.mesh();
  std::optional<double> least;
  const auto ends = [&](CurveId c) {
    const auto& chain = editor.reference().curve(c).chain;
    return std::array{chain.front(), chain.back()};
  };
  const auto next = [&](VertexId tip, CurveId c) {
    const auto& chain = editor.reference().curve(c).chain;
    return chain.front() == tip ? chain[1] : chain[chain.size() - 2];
  };
  const auto first_deg = [&](VertexId tip, CurveId c, CurveId d) {
    return angle_deg(mesh.position(tip), mesh.position(next(tip, c)), mesh.position(next(tip, d)));
  };
  for (const VertexId u : face.v)
    for (const VertexId w : face.v) {
      const CurveId c = mesh.vertex(u).curve, d = mesh.vertex(w).curve;
      if (!c.valid() || !d.valid() || c >= d) continue;
      for (const VertexId tip : ends(c))
        if ((tip == ends(d)[0] || tip == ends(d)[1])) {
          if (first_deg(tip, c, d) >= kSharpInput) continue;  // a turn of one beside the tip: a strip, not a corner
          const double angle = angle_deg(mesh.position(tip), mesh.position(u), mesh.position(w));
          least = std::min(angle, least.value_or(angle));
        }
    }
  return least;
}

/// Shortest edge between fixed vertices on the faces around and those beside them: the sizes grow from there.
std::optional<double> least_fixed_gap(const LocalMesh& mesh, const std::array<VertexId, 3>& corners) {
  std::vector<VertexId> around;
  for (const VertexId v : corners)
    for (const FaceId f : mesh.star(v)) around.insert(around.end(), mesh.face(f).v.begin(), mesh.face(f).v.end());
  std::optional<double> least;
  for (const VertexId v : around)
    for (const FaceId f : mesh.star(v)) {
      const auto& corner = mesh.face(f).v;
      for (std::size_t k = 0; k < 3; ++k) {
        const VertexId a = corner[k], b = corner[(k + 1) % 3];
        if (!mesh.vertex(a).fixed || !mesh.vertex(b).fixed) continue;
        const double d = distance(mesh.position(a), mesh.position(b));
        least = std::min(d, least.value_or(d));
      }
    }
  return least;
}

/// Length of an edge of a line that is not divided, and the least of what is to be beside it: an edge that stays as it
/// is, or one of the wanted length. Of those that meet in a corner of the face the least alike.
std::array<double, 2> least_alike_edges(Editor& editor, const LocalFace& face) {
  const LocalMesh& mesh = editor.mesh();
  std::array<double, 2> least_alike{1, 1};
  for (const VertexId v : face.v) {
    if (!mesh.vertex(v).fixed) continue;
    double longest = 0, shortest = editor.size(v);
    for (const FaceId f : mesh.star(v)) {
      const LocalFace& at = mesh.face(f);
      for (std::size_t k = 0; k < 3; ++k) {
        const VertexId a = at.v[k], b = at.v[(k + 1) % 3];
        if ((a != v && b != v) || !mesh.vertex(a).fixed || !mesh.vertex(b).fixed) continue;
        const double length = distance(mesh.position(a), mesh.position(b));
        shortest = std::min(shortest, length);
        if (at.curve[k].valid() && editor.reference().curve(at.curve[k]).fixed) longest = std::max(longest, length);
      }
    }
    if (longest * least_alike[1] > shortest * least_alike[0]) least_alike = {longest, shortest};
  }
  return least_alike;
}

std::string input_angle(double degrees) {
  return degrees < 1 ? fmt::format("input angle of {:.2g} degrees", degrees)
                     : fmt::format("input angle of {:.0f} degrees", degrees);
}

double input_edge_length(const Editor& editor, FaceId f) {
  const Foot foot = editor.reference().project(editor.mesh().face(f).sheet, centroid(editor.mesh().corners(f)), {});
  return editor.reference().edge_length(foot.face);
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
    if (angle < kSharpInput || angle > kWideInput) return {Kind::kInputAngle, input_angle(angle)};
  }
  if (const auto angle = least_corner_deg(editor, face); angle && *angle < kSharpInput)
    return {Kind::kInputAngle, input_angle(*angle)};
  if (editor.options().replaces_input) {
    const double fine = SizeOptions{}.gap_floor * input_edge_length(editor, f);
    if (const auto gap = least_fixed_gap(mesh, face.v); gap && *gap < fine)
      return {Kind::kInputDetail, fmt::format("fixed nodes only {:.3g} apart", *gap)};
  }
  if (const auto [longer, shorter] = least_alike_edges(editor, face); longer > kUnlike * shorter)
    return {Kind::kFixedEdges,
            fmt::format("an edge of {:.3g} that stays as it is in the input, beside edges of {:.3g}", longer, shorter)};
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
