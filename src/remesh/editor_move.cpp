// Moves of a vertex: a search without derivatives for the place where its faces are best.
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/angles.hpp"
#include "geometry/quality.hpp"
#include "remesh/editor.hpp"
#include "zone/ruler.hpp"

namespace meshgraft {
namespace {

constexpr double kFirstStep = 0.15;      // of the wanted edge length
constexpr double kLastStep = 0.04;       // of the wanted edge length
constexpr int kMostTrials = 16;          // places looked at in one search
constexpr double kLeastGain = 1e-2;      // share by which a move must lower its goal
constexpr double kSameSize = 0.2;        // of the size: a vertex moved less is still wanted the same size
constexpr double kClosestOnCurve = 0.2;  // to a neighbour, share of the room between both
constexpr double kMostSagitta = 0.1;     // of a chord, share of the wanted size
constexpr double kFreeSagitta = 0.07;    // the same of free edges
constexpr double kInfinite = std::numeric_limits<double>::infinity();

}  // namespace

bool Editor::relax(VertexId v) {
  if (!mesh_.stirred(v)) return false;
  const bool moved = search(v, &Star::cost);
  if (!moved) mesh_.calm(v);
  return moved;
}
bool Editor::sharpen(VertexId v) { return search(v, &Star::flatness); }

void Editor::gather(VertexId v) {
  star_.faces.clear();
  for (const FaceId f : mesh_.star(v)) {
    const LocalFace& face = mesh_.face(f);
    const std::size_t k = face.corner_of(v);
    const VertexId a = face.v[(k + 1) % 3], b = face.v[(k + 2) % 3];
    const Sheet& sheet = mesh_.sheet(face.sheet);
    star_.faces.push_back({mesh_.position(a), mesh_.position(b),
                           sheet.planar ? sheet.normal : area_vector(mesh_.corners(f)), length(a, b),
                           (size(v) + size(a) + size(b)) / 3});
  }
}

bool Editor::search(VertexId v, Goal goal) {
  const LocalVertex& vertex = mesh_.vertex(v);
  if (vertex.fixed || vertex.held || mesh_.star(v).empty()) return false;
  gather(v);
  return vertex.curve.valid() ? search_on_curve(v, goal) : search_in_sheet(v, goal);
}

bool Editor::search_in_sheet(VertexId v, Goal goal) {
  LocalVertex to = mesh_.vertex(v);
  const Sheet& sheet = mesh_.sheet(to.sheet);
  const Vec3 normal = sheet.planar ? sheet.normal : reference_->normal(to.beneath);
  const auto [e, f] = directions_across(normal);
  const double wanted = size(v);
  const double before = (star_.*goal)(to.position, kInfinite);
  double best = before;
  int n_trials = 0;
  const auto attempt = [&](Vec3 p) {
    ++n_trials;
    const Foot foot = reference_->place(to.sheet, p, to.beneath);
    const double value = (star_.*goal)(foot.point, best);
    if (!(value < best)) return false;
    best = value, to.position = foot.point, to.beneath = foot.face;
    return true;
  };
  Vec3 sum;
  for (const Star::Face& face : star_.faces) sum += face.a + face.b;
  attempt(sum / (2 * static_cast<double>(star_.faces.size())));  // the mean of the neighbours
  constexpr double kDiagonal = 0.70710678118654752;
  bool turned = false;  // every other round looks along the diagonals
  for (double step = kFirstStep * wanted; step > kLastStep * wanted && n_trials < kMostTrials; turned = !turned) {
    const Vec3 a = step * (turned ? kDiagonal * (e + f) : e), b = step * (turned ? kDiagonal * (f - e) : f);
    bool better = false;
    for (const Vec3 d : {a, b, -a, -b}) better = attempt(to.position + d) || better;
    if (!better) step *= 0.5;
  }
  if (!(best < before * (1 - kLeastGain)) && !(before == kInfinite && best < before)) return false;
  return place(v, to);
}

bool Editor::search_on_curve(VertexId v, Goal goal) {
  const auto span = reach(v);
  if (!span) return false;
  LocalVertex to = mesh_.vertex(v);
  const double margin = kClosestOnCurve * (span->to - span->from);
  const double low = span->from + margin, high = span->to - margin;
  const double wanted = size(v), before = (star_.*goal)(to.position, kInfinite), start = to.arc;
  double best = before, arc = start;
  for (double step = kFirstStep * wanted; step > kLastStep * wanted;) {
    bool better = false;
    for (const double d : {step, -step}) {
      const double trial = arc + d;
      if (trial < low || trial > high) continue;
      const double value = (star_.*goal)(reference_->point(to.curve, trial), best);
      if (value < best) best = value, arc = trial, better = true;
    }
    if (!better) step *= 0.5;
  }
  if (!(best < before * (1 - kLeastGain))) return false;
  to.position = reference_->point(to.curve, arc);
  to.arc = reference_->wrapped(to.curve, arc);
  if (!follows(to.curve, span->from, arc, distance(mesh_.position(span->before), to.position)) ||
      !follows(to.curve, arc, span->to, distance(mesh_.position(span->after), to.position)))
    return false;
  return place(v, to);
}

bool Editor::follows(CurveId curve, double from, double to, double chord) const {
  const double sagitta = reference_->sagitta(curve, from, to), slack = sizing_.slack(curve);
  if (sagitta > kSagittaSlack * std::max(slack, reference_->curve(curve).max_sagitta() * chord)) return false;
  // A long chord may cut off more than the outer shape of a mesh, or the place of a junction, bears.
  const double share = reference_->curve(curve).free ? kFreeSagitta : kMostSagitta;
  return sagitta <= slack || sagitta <= share * sizing_.on_curve(curve, reference_->point(curve, 0.5 * (from + to)));
}

bool Editor::place(VertexId v, const LocalVertex& to) {
  const double allowed = allowed_deviation(mesh_.star(v));
  const Mark start = mark();
  LocalVertex placed = to;
  if (distance(placed.position, placed.sized_at) > kSameSize * placed.size) placed.size = 0;
  mesh_.set_vertex(v, placed);
  for (const FaceId f : mesh_.star(v))
    if (deviation(f) > allowed) {
      undo(start);
      return false;
    }
  return true;
}

}  // namespace meshgraft
