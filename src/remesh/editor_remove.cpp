// Removal of a vertex: the hole that its star leaves is filled as well as possible.
#include <algorithm>

#include "geometry/quality.hpp"
#include "remesh/editor.hpp"
#include "remesh/fill_polygon.hpp"

namespace meshgraft {
namespace {

constexpr double kLeastCosine = 0.5;  // curved sheets: between a new face and the mean of the old ones

}  // namespace

bool Editor::remove(VertexId v) {
  const LocalVertex vertex = mesh_.vertex(v);
  if (vertex.fixed || vertex.held || mesh_.star(v).empty()) return false;
  const auto fans = mesh_.fans(v);
  if (fans.empty()) return false;
  CurveId closing;
  if (vertex.curve.valid()) {
    const auto span = reach(v);
    if (!span || span->before == span->after || !may_join_along_curve(v, *span, fans)) return false;
    closing = vertex.curve;
  } else if (fans.size() != 1 || !fans[0].closed) {
    return false;
  }
  const Mark start = mark();
  for (const Fan& fan : fans)
    if (!(fan.faces.size() == 1 && !fan.closed ? close_gap(fan, closing) : fill(v, fan, closing))) {
      undo(start);
      return false;
    }
  return true;
}

bool Editor::may_join_along_curve(VertexId v, const Reach& span, std::span<const Fan> fans) const {
  const double chord = length(span.before, span.after);
  const CurveId curve = mesh_.vertex(v).curve;
  if (!follows(curve, span.from, span.to, chord)) return false;
  std::size_t n_gaps = 0;
  for (const Fan& fan : fans) {
    const VertexId first = fan.link.front(), last = fan.link.back();
    if (fan.closed || !((first == span.before && last == span.after) || (first == span.after && last == span.before)))
      return false;
    if (fan.faces.size() == 1) ++n_gaps;
  }
  // The new edge may be there already only as the far side of a single face, which then vanishes.
  std::size_t n_there = 0;
  for (const FaceId f : mesh_.faces_at(span.before, span.after)) n_there += mesh_.face(f).has(v) ? 0 : 1;
  return n_there == n_gaps && (n_gaps == 0 || !mesh_.curve_at(span.before, span.after).valid());
}

bool Editor::close_gap(const Fan& fan, CurveId closing) {
  const VertexId a = fan.link[0], b = fan.link[1];
  mesh_.remove_face(fan.faces[0]);
  const FacesOfEdge beyond = mesh_.faces_at(a, b);
  for (const FaceId f : beyond) {
    LocalFace face = mesh_.face(f);
    if (face.sheet != fan.sheet) continue;  // filled a moment ago on another side of the curve
    if (!face.in_zone) return false;
    const std::size_t k = face.v[(face.corner_of(a) + 1) % 3] == b ? face.corner_of(a) : face.corner_of(b);
    if (face.curve[k].valid()) continue;
    face.curve[k] = closing;
    mesh_.remove_face(f);
    mesh_.add_face(face);
  }
  return true;
}

bool Editor::fill(VertexId v, const Fan& fan, CurveId closing) {
  const auto n = static_cast<std::uint32_t>(fan.link.size());
  const Sheet& sheet = mesh_.sheet(fan.sheet);
  Vec3 normal = sheet.normal;
  if (!sheet.planar) {
    normal = {};
    for (const FaceId f : fan.faces) normal += area_vector(mesh_.corners(f));
    normal = normalized(normal);
  }
  const auto triangle = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return Triangle{mesh_.position(fan.link[i]), mesh_.position(fan.link[j]), mesh_.position(fan.link[k])};
  };
  FillRules rules;
  rules.score = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    const Triangle t = triangle(i, j, k);
    const double q = signed_aspect_ratio(t, normal);
    if (q <= kFlat || (!sheet.planar && dot(unit_normal(t), normal) < kLeastCosine)) return 0.0;
    return q;
  };
  rules.may_join = [&](std::uint32_t i, std::uint32_t j) { return !mesh_.has_edge(fan.link[i], fan.link[j]); };
  if (n == 3 && fan.closed && mesh_.has_face({fan.link[0], fan.link[1], fan.link[2]})) return false;
  const auto filling = fill_polygon(fan.link, rules);
  if (!filling) return false;

  const double allowed = allowed_deviation(fan.faces);
  Few<CurveId, 8> side(n, closing);  // curve of the edge from link i to link i + 1
  for (std::size_t i = 0; i < fan.faces.size(); ++i) {
    const LocalFace& face = mesh_.face(fan.faces[i]);
    side[i] = face.curve[(face.corner_of(v) + 1) % 3];
  }
  const LocalFace like = mesh_.face(fan.faces[0]);
  for (const FaceId f : fan.faces) mesh_.remove_face(f);
  for (const auto& corners : filling->faces) {
    LocalFace face = like;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = corners[k], j = corners[(k + 1) % 3];
      face.v[k] = fan.link[i];
      face.curve[k] = j == (i + 1) % n ? side[i] : CurveId{};
    }
    if (deviation(face) > allowed) return false;
    mesh_.add_face(face);
  }
  return true;
}

}  // namespace meshgraft
