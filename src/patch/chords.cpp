#include "patch/chords.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/closest.hpp"
#include "geometry/plane.hpp"
#include "geometry/predicates.hpp"
#include "geometry/quality.hpp"
#include "remesh/star.hpp"

namespace meshgraft {
namespace {

constexpr double kSteepest = 0.7;     // sine between a chord and the surface at its ends, in curved openings
constexpr std::size_t kAtOnce = 256;  // candidates sorted at a time

/// REQUIRES: c on the line a b.
bool is_between(Vec2 a, Vec2 b, Vec2 c) {
  const bool in_x = std::min(a.x, b.x) <= c.x && c.x <= std::max(a.x, b.x);
  return in_x && std::min(a.y, b.y) <= c.y && c.y <= std::max(a.y, b.y);
}

/// Whether the way from corner `at` to `b` starts between its two sides, on their left.
bool starts_inside(Vec2 before, Vec2 at, Vec2 after, Vec2 b) {
  if (turn_sign(before, at, after) > 0 || (turn_sign(before, at, after) == 0 && is_between(before, after, at)))
    return turn_sign(at, b, before) > 0 && turn_sign(b, at, after) > 0;
  return !(turn_sign(at, b, after) >= 0 && turn_sign(b, at, before) >= 0);
}

bool crosses(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  return turn_sign(a, b, c) * turn_sign(a, b, d) < 0 && turn_sign(c, d, a) * turn_sign(c, d, b) < 0;
}

/// Whether the way from a to b passes so near to c that the face on the three is flat: a piece that it cuts off might
/// have no other face there.
bool grazes(Vec3 a, Vec3 b, Vec3 c) {
  const double along = dot(c - a, b - a);
  return along > 0 && along < squared_norm(b - a) && aspect_ratio({a, b, c}) <= kFlat;
}

}  // namespace

bool Chords::is_clear(const Ring& a, std::size_t i, const Ring& b, std::size_t j) const {
  const VertexId u = a[i], v = b[j];
  if (u == v || opening_.has_edge(u, v)) return false;
  const Vec3 p = opening_.position(u), q = opening_.position(v);
  const Vec3 nu = opening_.normal(u), nv = opening_.normal(v);
  if (!opening_.planar) {
    const Vec3 way = normalized(q - p);
    if (std::abs(dot(way, nu)) > kSteepest || std::abs(dot(way, nv)) > kSteepest || dot(nu, nv) < 0) return false;
  }
  const Vec3 normal = normalized(nu + nv), middle = midpoint(p, q);
  const Plane plane(normal);
  const Vec2 from = plane(p), to = plane(q);
  const auto leaves = [&](const Ring& ring, std::size_t k, Vec2 at, Vec2 other) {
    const std::size_t n = ring.size();
    if (n == 1) return true;
    return starts_inside(plane(opening_.position(ring[(k + n - 1) % n])), at,
                         plane(opening_.position(ring[(k + 1) % n])), other);
  };
  if (!leaves(a, i, from, to) || !leaves(b, j, to, from)) return false;
  const double reach = squared_norm(q - p);
  for (const Ring* ring : rings_)
    for (std::size_t k = 0; k < ring->size(); ++k) {
      const VertexId s = (*ring)[k], t = (*ring)[(k + 1) % ring->size()];
      if ((s == u && t == v) || (s == v && t == u)) return false;
      const Vec3 ps = opening_.position(s), pt = opening_.position(t);
      if (!opening_.planar) {
        const bool near = squared_norm(closest_on_segment(middle, ps, pt).point - middle) <= reach;
        if (!near || dot(opening_.normal(s), normal) <= 0) continue;
      }
      const Vec2 c = plane(ps), d = plane(pt);
      const bool is_on = turn_sign(from, to, c) == 0 && is_between(from, to, c);
      if (s != u && s != v && (is_on || grazes(p, q, ps))) return false;
      if (s != u && s != v && t != u && t != v && crosses(from, to, c, d)) return false;
    }
  return true;
}

std::optional<Chord> Chords::first_clear(std::vector<Candidate>& candidates, const Ring& a, const Ring& b) const {
  const auto before = [](const Candidate& x, const Candidate& y) {
    return std::tie(x.length, x.chord.from, x.chord.to) < std::tie(y.length, y.chord.from, y.chord.to);
  };
  for (auto first = candidates.begin(); first != candidates.end();) {
    const auto left = static_cast<std::size_t>(candidates.end() - first);
    const auto last = first + static_cast<std::ptrdiff_t>(std::min(kAtOnce, left));
    std::partial_sort(first, last, candidates.end(), before);
    for (; first != last; ++first)
      if (is_clear(a, first->chord.from, b, first->chord.to)) return first->chord;
  }
  return std::nullopt;
}

std::optional<Chord> Chords::shortest_between(const Ring& a, const Ring& b) const {
  std::vector<Candidate> candidates;
  candidates.reserve(a.size() * b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      candidates.push_back({squared_norm(opening_.position(a[i]) - opening_.position(b[j])), {i, j}});
  return first_clear(candidates, a, b);
}

std::optional<Chord> Chords::shortest_across(const Ring& ring, std::size_t least) const {
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < ring.size(); ++i)
    for (std::size_t j = i + least; j < ring.size() && j - i <= ring.size() - least; ++j)
      candidates.push_back({squared_norm(opening_.position(ring[i]) - opening_.position(ring[j])), {i, j}});
  return first_clear(candidates, ring, ring);
}

}  // namespace meshgraft
