#include "remesh/editor.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr double kLeastCosine = 0.5;  // between a face and the reference beneath it
constexpr double kTurned = 10;        // deviation of a face that leans more; farther than any leeway

}  // namespace

Editor::Editor(const Complex& complex, const Brep& brep, const std::vector<std::uint8_t>& in_zone, Sizing sizing,
               const RemeshOptions& options)
    : brep_(brep),
      reference_(std::make_shared<Reference>(complex, brep, in_zone)),
      mesh_(complex, brep, in_zone),
      sizing_(std::move(sizing)),
      options_(options) {
  for (std::size_t c = 0; c < brep.curves.size(); ++c) {
    const CurveId id(c);
    if (reference_->polyline(id).empty()) continue;
    const auto& chain = brep.curves[c].chain;
    for (std::size_t k = chain.size(); k-- > 0;) {  // backwards: a closed curve starts at arc length 0
      LocalVertex v = mesh_.vertex(chain[k]);
      if (v.dimension != Dimension::kCurve) continue;
      v.curve = id, v.arc = reference_->arcs(id)[k], v.fixed = v.fixed || brep.curves[c].fixed;
      mesh_.describe(chain[k], v);
    }
  }
}

Editor::Editor(const Editor& whole, SheetId sheet, std::span<const FaceId> faces)
    : brep_(whole.brep_),
      reference_(whole.reference_),
      mesh_(whole.mesh_, sheet, faces),
      sizing_(whole.sizing_),
      options_(whole.options_) {}

double Editor::asked_size(VertexId v) {
  const LocalVertex& vertex = mesh_.vertex(v);
  double size = std::numeric_limits<double>::infinity();
  if (vertex.curve.valid()) {
    size = sizing_.on_curve(vertex.curve, vertex.position);
  } else if (vertex.dimension == Dimension::kSheet) {
    size = sizing_.in_sheet(vertex.sheet, vertex.position);
  } else {
    for (const FaceId f : mesh_.star(v))
      if (mesh_.face(f).in_zone) size = std::min(size, sizing_.in_sheet(mesh_.face(f).sheet, vertex.position));
  }
  mesh_.set_size(v, size);
  return size;
}

double Editor::cost(const LocalFace& f) {
  const Triangle t{mesh_.position(f.v[0]), mesh_.position(f.v[1]), mesh_.position(f.v[2])};
  const std::array<double, 3> edges{distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])};
  const Vec3 vector = area_vector(t);
  const Sheet& sheet = mesh_.sheet(f.sheet);
  const bool backwards = sheet.planar && dot(vector, sheet.normal) < 0;
  const double q = backwards ? 0 : aspect_ratio(norm(vector), edges);
  return face_cost(q, (edges[0] + edges[1] + edges[2]) / 3, (size(f.v[0]) + size(f.v[1]) + size(f.v[2])) / 3);
}

double Editor::cost(FaceId f) {
  const LocalFace& face = mesh_.face(f);
  const double wanted = (size(face.v[0]) + size(face.v[1]) + size(face.v[2])) / 3;
  return face_cost(std::max(face.q, 2 * kFlat), mean_edge_length(mesh_.corners(f)), wanted);
}

double Editor::cost(std::span<const FaceId> faces) {
  double sum = 0;
  for (const FaceId f : faces) sum += cost(f);
  return sum;
}

bool Editor::faces_right(const LocalFace& f) const { return mesh_.quality(f) > kFlat; }

double Editor::deviation(const LocalFace& f) const {
  if (mesh_.sheet(f.sheet).planar) return 0;
  const Triangle t{mesh_.position(f.v[0]), mesh_.position(f.v[1]), mesh_.position(f.v[2])};
  FaceId hint;
  for (const VertexId v : f.v)
    if (mesh_.vertex(v).dimension == Dimension::kSheet) hint = mesh_.vertex(v).beneath;
  const auto share = [&](const Foot& foot) {
    return foot.distance / (options_.max_deviation * reference_->least_edge_length(foot.face));
  };
  // The largest, or the first that is more than `enough`.
  const auto largest = [&](double enough, auto&& foot_of) {
    const Foot middle = foot_of(centroid(t), hint);
    const double cosine = dot(unit_normal(t), reference_->normal(middle.face));
    if (cosine < kLeastCosine) return kTurned * (1 + kLeastCosine - cosine);
    double worst = share(middle);
    for (std::size_t k = 0; k < 3; ++k) {
      if (f.curve[k].valid()) continue;
      FaceId beneath = middle.face;
      for (int i = 1; i <= options_.edge_samples && worst <= enough; ++i) {
        const Vec3 p = lerp(t[k], t[(k + 1) % 3], static_cast<double>(i) / (options_.edge_samples + 1));
        const Foot foot = foot_of(p, beneath);
        worst = std::max(worst, share(foot)), beneath = foot.face;
      }
    }
    return worst;
  };
  constexpr double kAllowed = 1;
  if (hint.valid()) {
    const double most = largest(kAllowed, [&](Vec3 p, FaceId from) { return reference_->walk(f.sheet, p, from); });
    if (most <= kAllowed) return most;
  }
  return largest(std::numeric_limits<double>::infinity(),
                 [&](Vec3 p, FaceId from) { return reference_->project(f.sheet, p, from); });
}

double Editor::deviation(FaceId f) {
  const LocalFace& face = mesh_.face(f);
  if (face.deviation == LocalFace::kUnknown) mesh_.set_deviation(f, deviation(face));
  return face.deviation;
}

double Editor::allowed_deviation(std::span<const FaceId> replaced) {
  double worst = leeway_;
  for (const FaceId f : replaced) worst = std::max(worst, deviation(f));
  return worst;
}

bool Editor::flip(VertexId a, VertexId b) {
  const FacesOfEdge faces = mesh_.faces_at(a, b);
  if (faces.size() != 2) return false;
  LocalFace left = mesh_.face(faces[0]), right = mesh_.face(faces[1]);
  if (!left.in_zone || !right.in_zone || left.sheet != right.sheet) return false;
  if (left.v[(left.corner_of(a) + 1) % 3] != b) std::swap(left, right);
  const std::size_t i = left.corner_of(a), j = right.corner_of(b);  // left is a, b, c; right is b, a, d
  if (left.curve[i].valid() || right.v[(j + 1) % 3] != a) return false;
  const VertexId c = left.v[(i + 2) % 3], d = right.v[(j + 2) % 3];
  if (c == d || mesh_.has_edge(c, d)) return false;

  LocalFace first = left, second = right;
  first.v = {c, a, d}, first.curve = {left.curve[(i + 2) % 3], right.curve[(j + 1) % 3], CurveId{}};
  second.v = {d, b, c}, second.curve = {right.curve[(j + 2) % 3], left.curve[(i + 1) % 3], CurveId{}};
  if (!mesh_.sheet(left.sheet).planar) {
    const Vec3 normal = area_vector(mesh_.corners(faces[0])) + area_vector(mesh_.corners(faces[1]));
    for (const LocalFace* f : {&first, &second}) {
      const Triangle t{mesh_.position(f->v[0]), mesh_.position(f->v[1]), mesh_.position(f->v[2])};
      if (signed_aspect_ratio(t, normal) <= kFlat) return false;
    }
  }
  if (!faces_right(first) || !faces_right(second)) return false;
  const double allowed = allowed_deviation(faces);
  if (deviation(first) > allowed || deviation(second) > allowed) return false;
  for (const FaceId f : faces) mesh_.remove_face(f);
  mesh_.add_face(first), mesh_.add_face(second);
  return true;
}

bool Editor::flip_gains(VertexId a, VertexId b) {
  const FacesOfEdge faces = mesh_.faces_at(a, b);
  if (faces.size() != 2) return false;
  const LocalFace &left = mesh_.face(faces[0]), &right = mesh_.face(faces[1]);
  if (!left.in_zone || !right.in_zone || left.sheet != right.sheet) return false;
  const std::size_t i = left.corner_of(a);
  const bool forward = left.v[(i + 1) % 3] == b;
  const std::size_t edge = forward ? i : (i + 2) % 3;
  if (left.curve[edge].valid()) return false;
  const VertexId u = left.v[edge], v = left.v[(edge + 1) % 3], c = left.v[(edge + 2) % 3];
  const VertexId d = right.v[(right.corner_of(v) + 2) % 3];
  LocalFace first = left, second = left;
  first.v = {c, u, d}, second.v = {d, v, c};
  constexpr double kLeastGain = 1e-3;  // of the cost; keeps equal diagonals from swapping for ever
  const double before = cost(faces);
  return cost(first) + cost(second) < before * (1 - kLeastGain);
}

std::optional<Editor::Reach> Editor::reach(VertexId v) const {
  const LocalVertex& at = mesh_.vertex(v);
  const auto neighbours = mesh_.curve_neighbours(v);
  if (!at.curve.valid() || !neighbours[0].valid() || mesh_.curve_at(v, neighbours[0]) != at.curve ||
      mesh_.curve_at(v, neighbours[1]) != at.curve)
    return std::nullopt;
  const Curve& curve = reference_->curve(at.curve);
  const double whole = reference_->length(at.curve);
  const bool loop = curve.chain.front() == curve.chain.back();
  // How far ahead a neighbour is, counted forwards; corners are the ends of the chain.
  const auto ahead = [&](VertexId u) {
    const LocalVertex& other = mesh_.vertex(u);
    if (other.curve == at.curve) return other.arc >= at.arc || !loop ? other.arc - at.arc : other.arc + whole - at.arc;
    if (loop) return whole - at.arc;
    return u == curve.chain.front() ? -at.arc : whole - at.arc;
  };
  const double d0 = ahead(neighbours[0]), d1 = ahead(neighbours[1]);
  const auto [before, after] =
      (d0 < d1) == loop ? std::pair{neighbours[1], neighbours[0]} : std::pair{neighbours[0], neighbours[1]};
  double from = ahead(before), to = ahead(after);
  if (loop) from -= whole;
  if (!(from < 0 && to > 0)) return std::nullopt;
  return Reach{at.arc + from, at.arc + to, before, after};
}

bool Editor::splittable(std::span<const FaceId> faces) const {
  return !faces.empty() && std::ranges::all_of(faces, [&](FaceId f) { return mesh_.face(f).in_zone; });
}

void Editor::split_faces(VertexId a, VertexId b, VertexId middle, std::span<const FaceId> faces) {
  for (const FaceId f : faces) {
    const LocalFace old = mesh_.face(f);
    const std::size_t i = old.v[(old.corner_of(a) + 1) % 3] == b ? old.corner_of(a) : old.corner_of(b);
    LocalFace first = old, second = old;
    first.v[(i + 1) % 3] = middle, first.curve[(i + 1) % 3] = CurveId{};
    second.v[i] = middle, second.curve[(i + 2) % 3] = CurveId{};
    mesh_.remove_face(f);
    mesh_.add_face(first), mesh_.add_face(second);
  }
}

std::optional<VertexId> Editor::split_curve(VertexId a, VertexId b, CurveId curve, double arc) {
  const FacesOfEdge faces = mesh_.faces_at(a, b);
  if (!splittable(faces)) return std::nullopt;
  LocalVertex v;
  v.position = reference_->point(curve, arc);
  v.dimension = Dimension::kCurve, v.fixed = false, v.curve = curve, v.arc = reference_->wrapped(curve, arc);
  const VertexId id = mesh_.add_vertex(v);
  split_faces(a, b, id, faces);
  return id;
}

std::optional<VertexId> Editor::split(VertexId a, VertexId b) {
  const FacesOfEdge faces = mesh_.faces_at(a, b);
  if (!splittable(faces)) return std::nullopt;
  const double allowed = allowed_deviation(faces);
  const Mark start = mark();
  const CurveId curve = mesh_.curve_at(a, b);
  std::optional<VertexId> id;
  if (curve.valid()) {
    if (brep_.curves[curve.value].fixed) return std::nullopt;
    const std::optional<double> arc = middle_arc(a, b, curve);
    if (!arc) return std::nullopt;
    id = split_curve(a, b, curve, *arc);
  } else {
    const SheetId sheet = mesh_.face(faces[0]).sheet;
    const Vec3 middle = midpoint(mesh_.position(a), mesh_.position(b));
    LocalVertex v;
    v.dimension = Dimension::kSheet, v.fixed = false, v.sheet = sheet;
    for (const VertexId end : {a, b})
      if (mesh_.vertex(end).dimension == Dimension::kSheet) v.beneath = mesh_.vertex(end).beneath;
    const Foot foot = reference_->place(sheet, middle, v.beneath);
    v.position = foot.point, v.beneath = foot.face;
    id = mesh_.add_vertex(v);
    split_faces(a, b, *id, faces);
  }
  // Off the old edge, a face can have turned over.
  const Vec3 chord = midpoint(mesh_.position(a), mesh_.position(b));
  for (const FaceId f : mesh_.star(*id))
    if (!faces_right(mesh_.face(f)) || mesh_.quality(mesh_.face(f), *id, chord) <= kFlat || deviation(f) > allowed) {
      undo(start);
      return std::nullopt;
    }
  return id;
}

std::optional<VertexId> Editor::insert(FaceId f, const Foot& at) {
  const LocalFace old = mesh_.face(f);
  const Mark start = mark();
  LocalVertex v;
  v.position = at.point, v.dimension = Dimension::kSheet, v.fixed = false;
  v.sheet = old.sheet, v.beneath = at.face;
  const VertexId id = mesh_.add_vertex(v);
  const Vec3 normal = area_vector(mesh_.corners(f));
  mesh_.remove_face(f);
  for (std::size_t k = 0; k < 3; ++k) {
    LocalFace piece = old;
    piece.v = {old.v[k], old.v[(k + 1) % 3], id};
    piece.curve = {old.curve[k], CurveId{}, CurveId{}};
    const FaceId made = mesh_.add_face(piece);
    if (signed_aspect_ratio(mesh_.corners(made), normal) > kFlat) continue;
    undo(start);
    return std::nullopt;
  }
  return id;
}

void Editor::replace(std::span<const FaceId> faces, std::span<const LocalFace> by) {
  for (const FaceId f : faces) mesh_.remove_face(f);
  for (const LocalFace& f : by) mesh_.add_face(f);
}

void Editor::put(VertexId v, Vec3 p) {
  LocalVertex to = mesh_.vertex(v);
  to.position = p, to.beneath = reference_->project(to.sheet, p, to.beneath).face, to.size = 0;
  mesh_.set_vertex(v, to);
}

void Editor::hold(VertexId v, bool held) {
  LocalVertex to = mesh_.vertex(v);
  to.held = held;
  mesh_.set_vertex(v, to);
}

std::optional<double> Editor::middle_arc(VertexId a, VertexId b, CurveId curve) const {
  for (const auto& [v, other] : {std::pair{a, b}, std::pair{b, a}}) {
    if (mesh_.vertex(v).curve != curve) continue;
    const auto span = reach(v);
    if (!span) return std::nullopt;
    return 0.5 * (mesh_.vertex(v).arc + (span->after == other ? span->to : span->from));
  }
  return 0.5 * reference_->length(curve);  // both ends are corners: the edge is the whole curve
}

}  // namespace meshgraft
