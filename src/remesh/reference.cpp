#include "remesh/reference.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/closest.hpp"
#include "zone/parents.hpp"
#include "zone/ruler.hpp"

namespace meshgraft {
namespace {

constexpr double kFine = 0.5;  // smaller neighbours are slivers rather than a finer mesh

/// By face: the least length of the faces at its corners.
std::vector<double> least_around(const Complex& complex, std::span<const double> length) {
  std::vector<double> at_vertex(complex.n_vertices(), std::numeric_limits<double>::infinity());
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    for (const VertexId v : complex.face[f]) at_vertex[v.value] = std::min(at_vertex[v.value], length[f]);
  std::vector<double> least(complex.n_faces());
  for (std::size_t f = 0; f < complex.n_faces(); ++f) {
    const auto [a, b, c] = complex.face[f];
    const double around = std::min({at_vertex[a.value], at_vertex[b.value], at_vertex[c.value]});
    least[f] = std::max(kFine * length[f], around);
  }
  return least;
}

}  // namespace

Reference::Reference(const Complex& complex, const Brep& brep, const std::vector<std::uint8_t>& in_zone)
    : complex_(complex),
      brep_(brep),
      faces_(brep.sheets.size()),
      trees_(brep.sheets.size()),
      points_(brep.curves.size()),
      arcs_(brep.curves.size()) {
  std::vector<std::uint8_t> near(complex.n_vertices(), 0), curve_used(brep.curves.size(), 0);
  for (std::size_t f = 0; f < complex.n_faces(); ++f) {
    if (!in_zone[f]) continue;
    for (const VertexId v : complex.face[f]) near[v.value] = 1;
    for (const CurveId c : brep.curve_of_edge[f])
      if (c.valid()) curve_used[c.value] = 1;
  }
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    if (std::ranges::any_of(complex.face[f], [&](VertexId v) { return near[v.value] != 0; }))
      faces_[brep.sheet_of_face[f].value].emplace_back(f);
  tbb::parallel_for(std::size_t{0}, faces_.size(), [&](std::size_t s) {
    std::vector<Box> boxes(faces_[s].size());
    for (std::size_t k = 0; k < boxes.size(); ++k)
      for (const Vec3 p : complex.corners(faces_[s][k])) boxes[k].add(p);
    trees_[s] = BoxTree(boxes);
  });
  find_neighbours();
  const Parents parents(complex);
  const std::vector<Vec3> area_vector = area_vectors(parents, complex);
  edge_length_.reserve(complex.n_faces());
  for (const std::uint32_t parent : parents.of_face)
    edge_length_.push_back(edge_length_of_area(norm(area_vector[parent])));
  least_edge_length_ = least_around(complex, edge_length_);
  for (std::size_t c = 0; c < brep.curves.size(); ++c) {
    if (!curve_used[c]) continue;
    for (const VertexId v : brep.curves[c].chain) points_[c].push_back(complex.position[v.value]);
    arcs_[c] = arc_lengths(points_[c]);
  }
}

void Reference::find_neighbours() {
  const auto is_walked = [&](std::size_t s) {
    return !faces_[s].empty() && !brep_.sheets[s].planar && !brep_.sheets[s].made_up;
  };
  std::vector<std::size_t> walked;
  for (std::size_t s = 0; s < faces_.size(); ++s)
    if (is_walked(s)) walked.push_back(s);
  if (walked.empty()) return;
  const EdgeTable edges(complex_);
  around_.emplace(complex_);
  beside_.resize(complex_.n_faces());
  for (const std::size_t s : walked)
    for (const FaceId f : faces_[s])
      for (std::size_t k = 0; k < 3; ++k) {
        if (brep_.curve_of_edge[f.value][k].valid()) continue;
        for (const EdgeUse& use : edges.uses(edges.of(f, k)))
          if (use.face != f && brep_.sheet_of_face[use.face.value].value == s) beside_[f.value][k] = use.face;
      }
}

Foot Reference::walk(SheetId sheet, Vec3 p, FaceId from) const {
  if (beside_.empty() || brep_.sheets[sheet.value].made_up || brep_.sheet_of_face[from.value] != sheet)
    return project(sheet, p, from);
  TrianglePoint at = closest_on_triangle(p, complex_.corners(from));
  double squared = squared_norm(p - at.point);
  FaceId next;
  const auto try_face = [&](FaceId f) {
    const TrianglePoint there = closest_on_triangle(p, complex_.corners(f));
    const double d = squared_norm(p - there.point);
    if (d < squared) squared = d, at = there, next = f;
  };
  do {
    const TrianglePoint here = at;
    next = FaceId{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (here.weight[k] >= 1) {
        for (const FaceId f : (*around_)[complex_.face[from.value][k]])
          if (f != from && brep_.sheet_of_face[f.value] == sheet) try_face(f);
      } else if (here.weight[k] <= 0) {  // on the edge opposite to corner k
        if (const FaceId f = beside_[from.value][(k + 1) % 3]; f.valid()) try_face(f);
      }
    }
    if (next.valid()) from = next;
  } while (next.valid());
  return {at.point, from, std::sqrt(squared)};
}

Foot Reference::project(SheetId sheet, Vec3 p, FaceId hint) const {
  const auto& faces = faces_[sheet.value];
  if (brep_.sheets[sheet.value].made_up) return {p, hint.valid() ? hint : faces.front(), 0};
  const auto squared_distance = [&](FaceId f) {
    return squared_norm(p - closest_on_triangle(p, complex_.corners(f)).point);
  };
  FaceId face = hint;
  double limit = std::numeric_limits<double>::infinity();
  if (hint.valid() && brep_.sheet_of_face[hint.value] == sheet) {
    if (!beside_.empty()) face = walk(sheet, p, hint).face;
    limit = squared_distance(face);
  }
  const auto nearest = trees_[sheet.value].nearest(
      p, [&](std::uint32_t i) { return squared_distance(faces[i]); }, limit);
  if (nearest.found()) face = faces[nearest.item];
  const Vec3 point = closest_on_triangle(p, complex_.corners(face)).point;
  return {point, face, distance(p, point)};
}

Foot Reference::place(SheetId sheet, Vec3 p, FaceId hint) const {
  const Sheet& s = brep_.sheets[sheet.value];
  if (!s.planar) return hint.valid() ? walk(sheet, p, hint) : project(sheet, p, hint);
  const double height = dot(p - s.origin, s.normal);
  return {p - height * s.normal, hint, std::abs(height)};
}

Vec3 Reference::normal(FaceId f) const { return unit_normal(complex_.corners(f)); }

double Reference::wrapped(CurveId c, double arc) const {
  const double whole = length(c);
  if (arc > whole) return arc - whole;
  return arc < 0 ? arc + whole : arc;
}

Vec3 Reference::point(CurveId c, double arc) const {
  return point_at(points_[c.value], arcs_[c.value], wrapped(c, arc));
}

std::size_t Reference::edge(CurveId c, double arc) const {
  const auto& arcs = arcs_[c.value];
  const auto after = std::ranges::upper_bound(arcs, wrapped(c, arc));
  const auto k = static_cast<std::size_t>(after - arcs.begin());
  return std::clamp<std::size_t>(k, 1, arcs.size() - 1) - 1;
}

double Reference::sagitta(CurveId c, double from, double to) const {
  const auto& points = points_[c.value];
  const auto& arcs = arcs_[c.value];
  const Vec3 a = point(c, from), b = point(c, to);
  double worst = 0;
  const auto measure = [&](double low, double high) {
    auto k = static_cast<std::size_t>(std::ranges::upper_bound(arcs, low) - arcs.begin());
    for (; k < arcs.size() && arcs[k] < high; ++k)
      worst = std::max(worst, distance(points[k], closest_on_segment(points[k], a, b).point));
  };
  const double whole = arcs.back();
  if (from < 0) {
    measure(from + whole, 2 * whole), measure(-whole, to);
  } else if (to > whole) {
    measure(from, 2 * whole), measure(-whole, to - whole);
  } else {
    measure(from, to);
  }
  return worst;
}

}  // namespace meshgraft
