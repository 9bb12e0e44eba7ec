#include "intersect/extend.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/distinct.hpp"
#include "intersect/free_ends.hpp"
#include "intersect/landing_surface.hpp"

namespace meshgraft {
namespace {

constexpr double kOneEnd = 0.85;       // cosine to their mean, from which directions across free edges are of one end
constexpr double kStays = 0.3;         // cosine to the way across from which an end goes along an edge that stays
constexpr double kInPlane = 0.5;       // sine of the angle by which a way may leave the tangent plane
constexpr double kLeastHeight = 0.05;  // of a face, over what it was
constexpr double kAcross = 0.95;       // cosine to the normal from which the way to a surface is no way past its border
constexpr double kStraight = 1e-3;     // sine of a turn in a line that nobody sees
constexpr double kWithIt = 0.9;        // over the way back of an end that stays, from which those beside it stay too

class Extender {
 public:
  Extender(const Complex& complex, std::span<const FaceId> own, std::span<const FaceId> other,
           std::span<const std::uint8_t> owns, std::span<const double> size, std::span<const std::uint8_t> exact,
           const ExtendRule& rule)
      : complex_(complex),
        own_(own),
        size_(size),
        exact_(exact),
        rule_(rule),
        surface_(complex, other),
        ends_(free_ends(complex, own, owns)),
        held_(complex.n_vertices()) {
    for (std::size_t f = 0; f < complex.n_faces(); ++f)
      for (const VertexId v : complex.face[f])
        if (owns[f] == 0 || complex.state[v.value] == VertexState::kFrozen) held_[v.value] = 1;
  }

  Extensions run() {
    for (const auto& [v, ends] : ends_) find_gap(v, ends);
    find_gaps_past_border();
    for (const auto& [v, gap] : gaps_)
      if (const auto to = target(v, gap); to && distance(*to, at(v)) > gap.weld) target_.emplace(v, *to);
    extend_past_border();
    while (take_back_bad_ones()) {
    }
    Extensions all;
    for (const auto& [v, to] : target_) {
      all.moved.push_back({v, to});
      all.ended_on.push_back(complex_.component[face_at(to, gaps_.at(v)).value]);
    }
    make_distinct(all.ended_on);
    all.bends = bends();
    find_half_reached(all);
    return all;
  }

 private:
  struct Gap {
    Vec3 across;  // to the nearest point of the surface
    Vec3 normal;  // of the face there
    double tolerance = 0, weld = 0;
    FaceId face;
    bool is_open = false;  // it is wider than rounding; a corner may end on one wall and be short of the next
  };

  [[nodiscard]] Vec3 at(VertexId v) const { return complex_.position[v.value]; }
  /// The nearest place of the surface that free edges at v may end on.
  [[nodiscard]] LandingSurface::Foot nearest(VertexId v, Vec3 p, double limit) const {
    return surface_.nearest(p, limit, [&](Vec3 normal) {
      return rule_.least_angle <= 0 || std::ranges::all_of(ends_.at(v), [&](const End& e) {
               return std::abs(dot(normal, unit_normal(complex_.corners(e.face)))) < std::cos(rule_.least_angle);
             });
    });
  }
  /// The face that an end goes to; that across its gap where it goes past the border of the surface.
  [[nodiscard]] FaceId face_at(Vec3 to, const Gap& gap) const {
    const LandingSurface::Foot foot = surface_.nearest(to, gap.weld, [](Vec3) { return true; });
    return foot.face.valid() ? foot.face : gap.face;
  }
  [[nodiscard]] bool is_exact(FaceId f) const { return !exact_.empty() && exact_[f.value] != 0; }

  void find_gap(VertexId v, const std::vector<End>& ends) {
    double finest = std::numeric_limits<double>::infinity();
    for (const End& e : ends) {
      if (is_exact(e.face)) return;
      finest = std::min(finest, size_[e.face.value]);
    }
    const LandingSurface::Foot foot = nearest(v, at(v), rule_.tolerance.at(finest));
    if (!foot.face.valid() || is_exact(foot.face)) return;
    const double size = std::min(finest, size_[foot.face.value]);
    const Vec3 across = foot.point - at(v);
    const double weld = rule_.snap.at(size).weld;
    if (norm(across) <= rule_.tolerance.at(size))
      gaps_[v] = {across,
                  unit_normal(complex_.corners(foot.face)),
                  rule_.tolerance.at(size),
                  weld,
                  foot.face,
                  norm(across) > weld};
  }

  /// Ends past the border of the surface, in its plane, of edges along it whose other ends are in reach.
  void find_gaps_past_border() {
    std::map<VertexId, Gap> past;
    for (const auto& [v, gap] : gaps_)
      for (const End& e : ends_.at(v)) {
        if (!gap.is_open || gaps_.contains(e.other) || is_exact(e.face) || !runs_along(e, v, gap)) continue;
        const LandingSurface::Foot foot = nearest(e.other, at(e.other), gap.tolerance + distance(at(e.other), at(v)));
        if (!foot.face.valid() || is_exact(foot.face)) continue;
        const Vec3 n = unit_normal(complex_.corners(foot.face)), way = foot.point - at(e.other);
        const double height = dot(n, way);
        if (std::abs(height) > gap.tolerance || std::abs(height) >= kAcross * norm(way)) continue;
        past.insert({e.other, {height * n, n, gap.tolerance, gap.weld, foot.face, std::abs(height) > gap.weld}});
      }
    gaps_.insert(past.begin(), past.end());
  }

  /// Whether an edge at v runs along the surface across the gap there.
  [[nodiscard]] bool runs_along(const End& edge, VertexId v, const Gap& gap) const {
    const Vec3 along = normalized(at(edge.other) - at(v));
    return std::abs(dot(along, gap.across)) <= kAlong * norm(gap.across);
  }

  /// Whether a free edge ends on the surface: it is near that as a whole and runs along it.
  [[nodiscard]] bool is_ending(VertexId v, const Gap& gap, const End& edge) const {
    const auto far = gaps_.find(edge.other);
    if (far == gaps_.end()) return false;
    if (!(gap.is_open && runs_along(edge, v, gap)) && !(far->second.is_open && runs_along(edge, v, far->second)))
      return false;
    return !leaves(v, edge, far->second.normal) && !leaves(edge.other, {v, edge.face, edge.across}, gap.normal);
  }

  /// Whether the edge is the one of an acute corner at v that leaves a wall along which the other edge runs. `normal`:
  /// of what is nearest to its other end.
  [[nodiscard]] bool leaves(VertexId v, const End& edge, Vec3 normal) const {
    const auto way = [&](const End& e) { return normalized(at(e.other) - at(v)); };
    return std::ranges::any_of(ends_.at(v), [&](const End& e) {
      const auto beside = gaps_.find(e.other);
      return beside != gaps_.end() && leaves_at_corner({way(edge), way(e)}, {normal, beside->second.normal});
    });
  }

  [[nodiscard]] std::optional<Vec3> target(VertexId v, const Gap& gap) const {
    if (held_[v.value] != 0) return std::nullopt;
    const std::vector<End>& ends = ends_.at(v);
    std::vector<const End*> ending;
    for (const End& e : ends)
      if (is_ending(v, gap, e)) ending.push_back(&e);
    if (ending.empty()) return std::nullopt;
    Vec3 mean;
    for (const End* e : ending) mean += e->across;
    mean = normalized(mean);
    const bool one_end = std::ranges::all_of(ending, [&](const End* e) { return dot(e->across, mean) >= kOneEnd; });
    if (!one_end) return ending.size() == 2 ? corner_target(v, gap, *ending[0], *ending[1]) : std::nullopt;
    if (const auto hit = gap.is_open ? hit_along(v, gap, way_of(v, gap, mean))
                                     : end_of_corner(v, gap, way_of(v, gap, mean), *ending.front()))
      return hit->point;
    if (!gap.is_open) return std::nullopt;
    if (const auto hit = hit_along(v, gap, mean)) return hit->point;
    return nearest_in_plane(v, gap, ending, mean);
  }

  /// An edge that ends on the surface and passes its border goes on straight: its end there goes to the plane of the
  /// last face.
  void extend_past_border() {
    std::map<VertexId, Vec3> past;
    for (const auto& [v, gap] : gaps_) {
      if (!gap.is_open || target_.contains(v) || held_[v.value] != 0) continue;
      const std::vector<End>& ends = ends_.at(v);
      const auto over =
          std::ranges::find_if(ends, [&](const End& e) { return target_.contains(e.other) && is_ending(v, gap, e); });
      const auto of_one_end = [&](const End& e) {
        return !is_ending(v, gap, e) || dot(e.across, over->across) >= kOneEnd;
      };
      if (over == ends.end() || !std::ranges::all_of(ends, of_one_end)) continue;
      const Vec3 u = way_of(v, gap, over->across);
      const double sine = dot(gap.normal, u);
      if (std::abs(sine) < LandingSurface::kLeastSine) continue;
      const double way = dot(gap.normal, gap.across) / sine;
      if (std::abs(way) <= rule_.longest_way * gap.tolerance) past.emplace(v, at(v) + way * u);
    }
    target_.merge(past);
  }

  /// Across the ending edges, or along another free edge that stays: that remains straight.
  [[nodiscard]] Vec3 way_of(VertexId v, const Gap& gap, Vec3 across) const {
    Vec3 way = across;
    for (const End& e : ends_.at(v))
      if (const Vec3 u = normalized(at(v) - at(e.other)); !is_ending(v, gap, e) && dot(u, across) >= kStays) way = u;
    return way;
  }

  [[nodiscard]] std::optional<LandingSurface::Hit> hit_along(VertexId v, const Gap& gap, Vec3 u) const {
    return surface_.along(at(v), u, rule_.longest_way * gap.tolerance, gap.weld);
  }

  /// Of a corner whose two edges both end: the place where their ends meet.
  [[nodiscard]] std::optional<Vec3> corner_target(VertexId v, const Gap& gap, const End& a, const End& b) const {
    const Vec3 u = normalized(at(v) - at(a.other)), w = normalized(at(v) - at(b.other));
    const auto on_u = end_of_corner(v, gap, u, b), on_w = end_of_corner(v, gap, w, a);
    if (!on_u || !on_w) return std::nullopt;
    const double uu = dot(on_u->normal, u), uw = dot(on_u->normal, w);
    const double wu = dot(on_w->normal, u), ww = dot(on_w->normal, w);
    const double det = uu * ww - uw * wu;
    if (std::abs(det) < LandingSurface::kLeastSine * LandingSurface::kLeastSine) return std::nullopt;
    const double p = uu * on_u->way, q = ww * on_w->way;
    const Vec3 to = at(v) + ((p * ww - q * uw) / det) * u + ((q * uu - p * wu) / det) * w;
    const LandingSurface::Foot foot = nearest(v, to, gap.tolerance);
    if (!foot.face.valid() || distance(foot.point, at(v)) > rule_.longest_way * gap.tolerance) return std::nullopt;
    return foot.point;
  }

  /// What the way u of a corner meets, on which its other edge ends: the surface, or where that is short itself and the
  /// way goes past it, the plane that the far end of that edge goes to.
  [[nodiscard]] std::optional<LandingSurface::Hit> end_of_corner(VertexId v, const Gap& gap, Vec3 u,
                                                                 const End& ending) const {
    if (auto hit = hit_along(v, gap, u)) return hit;
    const Gap& far = gaps_.at(ending.other);
    const double sine = dot(far.normal, u);
    if (std::abs(sine) < LandingSurface::kLeastSine) return std::nullopt;
    const double way = dot(far.normal, at(ending.other) + far.across - at(v)) / sine;
    const Vec3 to = at(v) + way * u;
    const auto faces_alike = [&](Vec3 normal) { return std::abs(dot(normal, far.normal)) >= kOneEnd; };
    if (std::abs(way) > rule_.longest_way * gap.tolerance ||
        !surface_.nearest(to, gap.tolerance, faces_alike).face.valid())
      return std::nullopt;
    return LandingSurface::Hit{way, to, far.normal};
  }

  [[nodiscard]] std::optional<Vec3> nearest_in_plane(VertexId v, const Gap& gap, const std::vector<const End*>& ending,
                                                     Vec3 mean) const {
    const double width = norm(gap.across);
    const auto leaves_plane = [&](const End* e) {
      return std::abs(dot(unit_normal(complex_.corners(e->face)), gap.across)) > kInPlane * width;
    };
    if (std::abs(dot(gap.across, mean)) < kInPlane * width || std::ranges::any_of(ending, leaves_plane))
      return std::nullopt;
    return at(v) + gap.across;
  }

  [[nodiscard]] std::vector<VertexId> bends() const {
    std::vector<VertexId> all;
    for (const auto& [v, to] : target_)
      for (const End& e : ends_.at(v)) {
        if (target_.contains(e.other)) continue;
        const Vec3 before = normalized(at(v) - at(e.other)), after = normalized(to - at(e.other));
        if (norm(cross(before, after)) > kStraight) all.push_back(e.other);
      }
    make_distinct(all);
    return all;
  }

  /// Ends out of reach, over the surface, of edges along it whose other ends are in reach.
  void find_half_reached(Extensions& all) const {
    std::map<VertexId, Corefined::HalfReached> found;
    for (const auto& [v, gap] : gaps_)
      for (const End& e : ends_.at(v)) {
        if (!gap.is_open || gaps_.contains(e.other) || is_exact(e.face) || !runs_along(e, v, gap)) continue;
        const LandingSurface::Foot foot =
            nearest(e.other, at(e.other), norm(gap.across) + distance(at(e.other), at(v)));
        if (!foot.face.valid()) continue;
        const Vec3 way = foot.point - at(e.other), normal = unit_normal(complex_.corners(foot.face));
        if (std::abs(dot(normal, way)) >= kAcross * norm(way) && !goes_on_from_leaving(v, e, normal))
          found.insert({e.other, {complex_.parent[e.face.value], at(e.other), norm(way)}}), all.last.push_back(v);
      }
    make_distinct(all.last);
    for (const auto& [v, place] : found) all.half_reached.push_back(place);
  }

  /// Whether an edge at v leaves the surface, or goes on from one that does.
  [[nodiscard]] bool goes_on_from_leaving(VertexId v, const End& edge, Vec3 normal) const {
    const Gap& gap = gaps_.at(v);
    const auto in_reach = [&](const End& e) { return gaps_.contains(e.other); };
    const std::vector<End>& ends = ends_.at(v);
    return leaves(v, edge, normal) || (std::ranges::any_of(ends, in_reach) &&
                                       std::ranges::none_of(ends, [&](const End& e) { return is_ending(v, gap, e); }));
  }

  bool take_back_bad_ones() {
    std::vector<VertexId> bad;
    for (const FaceId f : own_) {
      Triangle after = complex_.corners(f);
      bool moved = false;
      for (std::size_t k = 0; k < 3; ++k)
        if (const auto to = target_.find(complex_.face[f.value][k]); to != target_.end())
          after[k] = to->second, moved = true;
      if (!moved) continue;
      const Vec3 before = area_vector(complex_.corners(f));
      if (dot(area_vector(after), before) < kLeastHeight * squared_norm(before))
        bad.insert(bad.end(), complex_.face[f.value].begin(), complex_.face[f.value].end());
    }
    make_distinct(bad);
    std::erase_if(bad, [&](VertexId v) { return !target_.contains(v); });
    std::ranges::stable_sort(bad, {}, [&](VertexId v) { return way(v); });
    for (const VertexId v : bad)
      if (target_.contains(v)) stay_with(v);
    return !bad.empty();
  }

  [[nodiscard]] double way(VertexId v) const { return distance(target_.at(v), at(v)); }

  /// Takes back an end, and those beside it along the free edge that would be drawn back as far or farther: it is drawn
  /// back there as a whole or not at all, so that it does not become a row of steps.
  void stay_with(VertexId first) {
    const double least = kWithIt * way(first);
    std::vector<VertexId> open{first};
    while (!open.empty()) {
      const VertexId v = open.back();
      open.pop_back();
      const auto target = target_.find(v);
      if (target == target_.end()) continue;
      const Vec3 to = target->second - at(v);
      target_.erase(target);
      for (const End& e : ends_.at(v))
        if (const auto next = target_.find(e.other); dot(to, e.across) < 0 && next != target_.end())
          if (dot(next->second - at(e.other), e.across) < 0 && way(e.other) >= least) open.push_back(e.other);
    }
  }

  const Complex& complex_;
  std::span<const FaceId> own_;
  std::span<const double> size_;
  std::span<const std::uint8_t> exact_;
  const ExtendRule& rule_;
  LandingSurface surface_;
  EndsAt ends_;
  std::vector<std::uint8_t> held_;  // by vertex: it stays
  std::map<VertexId, Gap> gaps_;    // of ends within the tolerance
  std::map<VertexId, Vec3> target_;
};

}  // namespace

std::vector<std::uint8_t> faces_with(const Complex& complex, std::uint32_t component) {
  const Joins& joins = complex.joins;
  std::vector<std::uint8_t> with;
  for (const std::uint32_t c : complex.component)
    with.push_back(c == component || (joins.mesh_of(c) == joins.mesh_of(component) && !joins.are_joined(c, component)));
  return with;
}

Extensions extensions(const Complex& complex, std::span<const FaceId> own, std::span<const FaceId> other,
                      std::span<const std::uint8_t> owns, std::span<const double> size,
                      std::span<const std::uint8_t> exact, const ExtendRule& rule) {
  return Extender(complex, own, other, owns, size, exact, rule).run();
}

}  // namespace meshgraft
