#include "patch/opening.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "geometry/quality.hpp"
#include "patch/chords.hpp"
#include "remesh/fill_polygon.hpp"
#include "remesh/star.hpp"

namespace meshgraft {
namespace {

using Edge = std::array<VertexId, 2>;

Edge edge(VertexId a, VertexId b) { return {std::min(a, b), std::max(a, b)}; }

class Filler {
 public:
  Filler(const Opening& opening, const OpeningOptions& options) : opening_(opening), options_(options) {}

  tl::expected<OpeningFill, std::string> run() {
    std::vector<Ring> rings = opening_.contours;
    if (rings.empty()) return tl::unexpected(std::string("there is no contour"));
    if (!connect(rings)) return tl::unexpected(std::string("a contour cannot be reached from the others"));
    std::vector<Ring> pieces;
    divide(std::move(rings.front()), pieces);
    for (const Ring& piece : pieces)
      if (auto filled = fill(piece); !filled) return tl::unexpected(std::move(filled.error()));
    return std::move(out_);
  }

 private:
  static constexpr std::size_t kLeastShare = 4;  // a chord leaves at least this part of the sides on either side
  static constexpr int kMostAttempts = 200;      // to fill a polygon without making an edge twice

  /// Two corners of a ring.
  using Join = std::array<std::uint32_t, 2>;
  struct Attempt {
    PolygonFill filling;  // the best without
    std::set<Join> barred;
  };

  /// Makes one ring of all, the longest first, by the shortest chords.
  bool connect(std::vector<Ring>& rings) {
    std::ranges::stable_sort(rings, std::greater{}, &Ring::size);
    while (rings.size() > 1) {
      std::optional<Chord> best;
      std::size_t which = 0;
      for (std::size_t k = 1; k < rings.size(); ++k) {
        const auto chord = Chords(opening_, pointers(rings)).shortest_between(rings[0], rings[k]);
        if (chord && (!best || length(rings[0], rings[k], *chord) < length(rings[0], rings[which], *best)))
          best = chord, which = k;
      }
      if (!best) return false;
      join(rings[0], rings[which], *best);
      rings.erase(rings.begin() + static_cast<std::ptrdiff_t>(which));
    }
    return true;
  }

  static std::vector<const Ring*> pointers(const std::vector<Ring>& rings) {
    std::vector<const Ring*> all;
    for (const Ring& r : rings) all.push_back(&r);
    return all;
  }

  [[nodiscard]] double length(const Ring& a, const Ring& b, const Chord& c) const {
    return squared_norm(opening_.position(a[c.from]) - opening_.position(b[c.to]));
  }

  /// The ring goes along the chord, around the other ring, and back.
  void join(Ring& ring, const Ring& other, const Chord& chord) {
    out_.chords.push_back(edge(ring[chord.from], other[chord.to]));
    Ring detour;
    const std::size_t around = other.size() == 1 ? 1 : other.size() + 1;
    for (std::size_t k = 0; k < around; ++k) detour.push_back(other[(chord.to + k) % other.size()]);
    detour.push_back(ring[chord.from]);
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(chord.from) + 1, detour.begin(), detour.end());
  }

  /// Cuts a ring that is too long into pieces.
  void divide(Ring ring, std::vector<Ring>& pieces) {
    std::vector<Ring> open{std::move(ring)};
    while (!open.empty()) {
      Ring r = std::move(open.back());
      open.pop_back();
      std::optional<Chord> chord;
      if (r.size() > options_.most_corners) chord = Chords(opening_, {&r}).shortest_across(r, r.size() / kLeastShare);
      if (!chord) {
        pieces.push_back(std::move(r));
        continue;
      }
      out_.chords.push_back(edge(r[chord->from], r[chord->to]));
      const auto from = r.begin() + static_cast<std::ptrdiff_t>(chord->from);
      const auto to = r.begin() + static_cast<std::ptrdiff_t>(chord->to);
      Ring inner(from, to + 1), outer(r.begin(), from + 1);
      outer.insert(outer.end(), to, r.end());
      open.push_back(std::move(inner)), open.push_back(std::move(outer));
    }
  }

  /// With repeated corners the best filling can make an edge twice, between several pairs of corners. A lawful one has
  /// at most one of these joins, so the best without the others is sought for each in turn. What is left out only
  /// lowers the scores: if the best attempt of all is lawful, nothing better is.
  tl::expected<void, std::string> fill(const Ring& ring) {
    std::set<Edge> sides;
    for (std::size_t k = 0; k < ring.size(); ++k) sides.insert(edge(ring[k], ring[(k + 1) % ring.size()]));
    std::vector<Attempt> open;
    std::set<Join> barred;
    const FillRules rules = rules_for(ring, sides, barred);
    const auto attempt = [&] {
      if (auto filling = fill_polygon(ring, rules)) open.push_back({std::move(*filling), barred});
    };
    attempt();
    for (int n_attempts = 1; !open.empty();) {
      const auto best = std::ranges::max_element(
          open, [](const Attempt& a, const Attempt& b) { return a.filling.scores < b.filling.scores; });
      const Attempt at = std::move(*best);
      open.erase(best);
      const std::vector<Join> twice = joins_of_one_edge(ring, at.filling.faces);
      if (twice.empty()) {
        for (const auto& f : at.filling.faces) out_.faces.push_back({ring[f[0]], ring[f[1]], ring[f[2]]});
        return {};
      }
      for (const Join kept : twice) {
        if (++n_attempts > kMostAttempts)
          return tl::unexpected(std::string("no triangulation of the contour has been found that makes no edge twice"));
        barred = at.barred;
        barred.insert(twice.begin(), twice.end());
        barred.erase(kept);
        attempt();
      }
    }
    return tl::unexpected(std::string("no triangulation of the contour is turned like the surface"));
  }

  FillRules rules_for(const Ring& ring, const std::set<Edge>& sides, const std::set<Join>& barred) {
    FillRules rules;
    if (ring.size() > options_.all_scores) rules.depth = options_.depth;
    rules.may_join = [this, &ring, &sides, &barred](std::uint32_t i, std::uint32_t j) {
      const VertexId a = ring[i], b = ring[j];
      return a != b && !barred.contains({std::min(i, j), std::max(i, j)}) && !sides.contains(edge(a, b)) &&
             !opening_.has_edge(a, b);
    };
    position_.clear(), normal_.clear();
    for (const VertexId v : ring) position_.push_back(opening_.position(v)), normal_.push_back(opening_.normal(v));
    rules.score = [this, &ring](std::uint32_t i, std::uint32_t j, std::uint32_t k) { return score(ring, i, j, k); };
    return rules;
  }

  [[nodiscard]] double score(const Ring& ring, std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
    if (ring[i] == ring[j] || ring[j] == ring[k] || ring[k] == ring[i]) return 0;
    const Triangle t{position_[i], position_[j], position_[k]};
    const double q = signed_aspect_ratio(t, normal_[i]);
    if (!(q > kFlat)) return 0;
    if (opening_.planar) return q;
    const Vec3 normal = unit_normal(t);
    for (const std::uint32_t c : {i, j, k})
      if (dot(normal, normal_[c]) < options_.least_cosine) return 0;
    return q;
  }

  /// The joins that make one edge twice or more; none if there is no such edge.
  static std::vector<Join> joins_of_one_edge(const Ring& ring, const std::vector<std::array<std::uint32_t, 3>>& faces) {
    std::map<Edge, std::set<Join>> joins;
    const auto n = static_cast<std::uint32_t>(ring.size());
    for (const auto& f : faces)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [i, j] = std::minmax(f[k], f[(k + 1) % 3]);
        if (j - i != 1 && j - i != n - 1) joins[edge(ring[i], ring[j])].insert({i, j});
      }
    for (const auto& [e, at] : joins)
      if (at.size() > 1) return {at.begin(), at.end()};
    return {};
  }

  const Opening& opening_;
  const OpeningOptions& options_;
  OpeningFill out_;
  std::vector<Vec3> position_, normal_;  // by corner of the ring that is being filled
};

}  // namespace

tl::expected<OpeningFill, std::string> fill_opening(const Opening& opening, const OpeningOptions& options) {
  return Filler(opening, options).run();
}

}  // namespace meshgraft
