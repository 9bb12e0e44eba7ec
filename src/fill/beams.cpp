#include "fill/beams.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/union_find.hpp"
#include "fill/steepness.hpp"
#include "geometry/plane.hpp"
#include "meshgraft/vec3.hpp"

namespace meshgraft {
namespace {

constexpr double kLongest = 2;  // sides of the rims, on average: faces beside a longer beam would be larger than around

/// One side of a rim, or a beam in one of its directions.
struct Step {
  VertexId from, to;
  bool is_beam = false;
  std::size_t next_on_rim = 0;  // of a side: the one after it
};

class Follower {
 public:
  Follower(const Complex& complex, const VertexFaces& faces_at, const EdgeTable& edges, const Hole& hole,
           const std::map<VertexId, Vec3>& normals)
      : complex_(complex),
        faces_at_(faces_at),
        edges_(edges),
        hole_(hole),
        normals_(normals),
        plane_(area_of(complex, hole)) {
    double n = 0;
    for (const Rim& rim : hole) {
      auto& in_plane = rims_in_plane_.emplace_back();
      for (const VertexId v : rim.vertices) in_plane.push_back(plane_(at(v)));
      n += static_cast<double>(rim.vertices.size());
    }
    longest_ = kLongest * length_of(complex, hole) / n;
  }

  FollowedBeams run(const LeftOut& left_out) {
    const std::set<Beam> all = hanging(open_beams());
    find_places(all);
    find_obstacles(all, left_out);
    const auto cut = beams_.empty() || !tell_regions_apart() ? std::nullopt : regions();
    if (!cut)
      for (const Beam& beam : std::exchange(beams_, {})) obstacle_[beam] = Obstacle::kNoFaces;

    FollowedBeams followed;
    followed.regions = cut ? *cut : std::vector<Region>{region_of(hole_)};
    for (const auto& [a, b] : beams_) {
      followed.beams.insert(nodes_of(complex_, a, b));
      for (const VertexId v : {a, b})
        if (!is_of_rim(v)) followed.normal[v] = normal(v);
    }
    followed.unfollowed = unfollowed(all);
    return followed;
  }

 private:
  using Beam = std::array<VertexId, 2>;  // the smaller first

  [[nodiscard]] static Beam beam_of(const Complex::Line& line) {
    return {std::min(line.ends[0], line.ends[1]), std::max(line.ends[0], line.ends[1])};
  }
  [[nodiscard]] Vec3 at(VertexId v) const { return complex_.position[v.value]; }
  [[nodiscard]] bool is_of_rim(VertexId v) const { return normals_.contains(v); }

  [[nodiscard]] Vec3 normal(VertexId v) {
    if (const VertexId there = followed_at(v); is_of_rim(there)) return normals_.at(there);
    const auto [it, is_new] = inner_.try_emplace(v);
    if (is_new) {
      Vec3 sum;
      for (const auto& [u, n] : normals_) sum += n / squared_norm(at(v) - at(u));
      it->second = normalized(sum);
    }
    return it->second;
  }

  /// Beams between nodes that are of a rim or of no face, but not along faces.
  [[nodiscard]] std::set<Beam> open_beams() const {
    const auto is_open = [&](VertexId v) { return is_of_rim(v) || faces_at_[v].empty(); };
    std::set<Beam> beams;
    for (const Complex::Line& line : complex_.lines)
      if (std::ranges::all_of(line.ends, is_open) && !edges_.find(line.ends[0], line.ends[1]).valid())
        beams.insert(beam_of(line));
    return beams;
  }

  /// Those that hang together with a rim.
  [[nodiscard]] std::set<Beam> hanging(std::set<Beam> beams) const {
    std::map<VertexId, std::uint32_t> number;
    for (const auto& [v, n] : normals_) number[v] = 0;
    std::uint32_t n = 1;
    for (const Beam& beam : beams)
      for (const VertexId v : beam)
        if (number.try_emplace(v, n).second) ++n;
    UnionFind together(n);
    for (const auto& [a, b] : beams) together.unite(number.at(a), number.at(b));
    std::erase_if(beams, [&](const Beam& beam) { return together.find(number.at(beam[0])) != 0; });
    return beams;
  }

  /// Those on a way from a rim to a rim.
  [[nodiscard]] std::set<Beam> without_dead_ends(std::set<Beam> beams) const {
    std::map<VertexId, std::set<Beam>> beams_at;
    for (const Beam& beam : beams)
      if (beam[0] != beam[1])
        for (const VertexId v : beam) beams_at[v].insert(beam);
    std::vector<VertexId> ends;
    const auto add_end = [&](VertexId v) {
      if (!is_of_rim(v) && beams_at.at(v).size() == 1) ends.push_back(v);
    };
    for (const auto& [v, there] : beams_at) add_end(v);
    while (!ends.empty()) {
      const VertexId end = ends.back();
      ends.pop_back();
      if (beams_at.at(end).empty()) continue;
      const Beam beam = *beams_at.at(end).begin();
      beams.erase(beam);
      for (const VertexId v : beam) beams_at.at(v).erase(beam), add_end(v);
    }
    return beams;
  }

  /// Faces can be made on one node in a place only: one of a rim, else that with the most beams.
  void find_places(const std::set<Beam>& beams) {
    std::map<VertexId, int> n_beams;
    for (const auto& [a, b] : beams)
      if (at(a) != at(b)) ++n_beams[a], ++n_beams[b];
    for (const auto& [v, n] : normals_) place_.try_emplace(key_of(v), v);
    for (const auto& [v, n] : n_beams) {
      VertexId& there = place_.try_emplace(key_of(v), v).first->second;
      if (!is_of_rim(there) && n > n_beams.at(there)) there = v;
    }
  }
  [[nodiscard]] std::array<double, 3> key_of(VertexId v) const { return {at(v).x, at(v).y, at(v).z}; }
  /// The node in the place of v that is followed.
  [[nodiscard]] VertexId followed_at(VertexId v) const {
    const auto it = place_.find(key_of(v));
    return it == place_.end() || is_of_rim(v) ? v : it->second;
  }

  /// Parts those that can be followed from the rest.
  void find_obstacles(const std::set<Beam>& all, const LeftOut& left_out) {
    std::set<Beam> free;
    for (const Beam& beam : all) {
      if (const std::optional<Obstacle> obstacle = obstacle_of(beam, left_out))
        obstacle_[beam] = *obstacle;
      else
        free.insert(beam);
    }
    beams_ = hanging(free);
    for (const Beam& beam : free)
      if (!beams_.contains(beam)) obstacle_[beam] = Obstacle::kCutOff;
  }

  /// Those that the user would miss: what lies along the surface, and what is on a way from a rim to a rim.
  [[nodiscard]] std::vector<UnfollowedBeam> unfollowed(const std::set<Beam>& all) const {
    std::set<Beam> along = all;
    std::erase_if(along, [&](const Beam& beam) {
      const auto it = obstacle_.find(beam);
      return it != obstacle_.end() && (it->second == Obstacle::kBeside || it->second == Obstacle::kTooSteep);
    });
    along = hanging(std::move(along));
    const std::set<Beam> across = without_dead_ends(all);
    std::vector<UnfollowedBeam> told;
    for (const Complex::Line& line : complex_.lines) {
      const auto it = obstacle_.find(beam_of(line));
      if (it != obstacle_.end() && (along.contains(it->first) || across.contains(it->first)))
        told.push_back({line.parent.element, it->second});
    }
    return told;
  }

  /// What keeps a beam from being followed, by itself.
  [[nodiscard]] std::optional<Obstacle> obstacle_of(const Beam& beam, const LeftOut& left_out) {
    const auto [a, b] = beam;
    if (at(a) == at(b)) return Obstacle::kNoLength;
    const bool a_is_of_rim = is_of_rim(followed_at(a)), b_is_of_rim = is_of_rim(followed_at(b));
    const bool is_beside = a_is_of_rim && b_is_of_rim
                               ? !is_over_hole(midpoint(at(a), at(b)))
                               : (!a_is_of_rim && !is_over_hole(at(a))) || (!b_is_of_rim && !is_over_hole(at(b)));
    if (is_beside) return Obstacle::kBeside;
    const Vec3 way = normalized(at(b) - at(a));
    if (std::abs(dot(way, normal(a))) > kSteepest || std::abs(dot(way, normal(b))) > kSteepest)
      return Obstacle::kTooSteep;
    if (followed_at(a) != a || followed_at(b) != b) return Obstacle::kSamePlace;
    if (distance(at(a), at(b)) > longest_) return Obstacle::kTooLong;
    const auto it = left_out.find(nodes_of(complex_, a, b));
    return it == left_out.end() ? std::nullopt : std::optional(it->second);
  }

  /// Over the opening: inside of an odd number of rims.
  [[nodiscard]] bool is_over_hole(Vec3 p) const {
    bool inside = false;
    for (const auto& rim : rims_in_plane_) inside = inside != is_inside(rim, plane_(p));
    return inside;
  }

  /// Whether the beams tell what is one region: where they close a circle, all must hang together.
  bool tell_regions_apart() {
    std::map<VertexId, std::uint32_t> number;  // the rims come first
    for (std::uint32_t k = 0; k < hole_.size(); ++k)
      for (const VertexId v : hole_[k].vertices) number[v] = k;
    auto n = static_cast<std::uint32_t>(hole_.size());
    for (const Beam& beam : beams_)
      for (const VertexId v : beam)
        if (number.try_emplace(v, n).second) ++n;
    UnionFind together(n);
    for (std::uint32_t k = 0; k < hole_.size(); ++k)  // rims may share a vertex
      for (const VertexId v : hole_[k].vertices) together.unite(k, number.at(v));
    for (const auto& [a, b] : beams_) together.unite(number.at(a), number.at(b));
    std::size_t pieces = 0;
    for (std::uint32_t k = 0; k < n; ++k)
      if (together.find(k) == k) ++pieces;
    is_one_piece_ = pieces == 1;
    return is_one_piece_ || beams_.size() == n - pieces;
  }

  /// The ways around what is open, with beams on the left as well as sides of rims.
  std::optional<std::vector<Region>> regions() {
    for (const Rim& rim : hole_) {
      const std::size_t first = steps_.size(), n = rim.vertices.size();
      for (std::size_t k = 0; k < n; ++k)
        steps_.push_back({rim.vertices[k], rim.vertices[(k + 1) % n], false, first + (k + 1) % n});
    }
    for (const auto& [a, b] : beams_) steps_.push_back({a, b, true}), steps_.push_back({b, a, true});
    for (std::size_t k = 0; k < steps_.size(); ++k) from_[steps_[k].from].push_back(k);
    std::vector<std::uint8_t> used(steps_.size(), 0);
    Region ways;
    for (std::size_t first = 0; first < steps_.size(); ++first) {
      if (used[first] != 0) continue;
      std::vector<VertexId>& way = ways.emplace_back();
      std::size_t k = first;
      for (; used[k] == 0; k = next(k)) used[k] = 1, way.push_back(steps_[k].from);
      if (k != first) return std::nullopt;
    }
    if (!is_one_piece_) return std::vector<Region>{ways};
    std::vector<Region> all;
    for (auto& way : ways) all.push_back({std::move(way)});
    return all;
  }

  /// The first step clockwise from that on which one came; back only from a dead end.
  [[nodiscard]] std::size_t next(std::size_t k) {
    const VertexId v = steps_[k].to;
    const Vec3 back = at(steps_[k].from) - at(v), n = normal(v);
    const auto clockwise = [&](std::size_t j) {
      if (steps_[j].to == steps_[k].from) return 2 * std::numbers::pi;
      const Vec3 onward = at(steps_[j].to) - at(v);
      const double angle = std::atan2(dot(n, cross(onward, back)), dot(back, onward));
      return angle > 0 ? angle : angle + 2 * std::numbers::pi;
    };
    std::vector<std::size_t> onward;
    for (const std::size_t j : from_.at(v))
      if (steps_[k].is_beam || steps_[j].is_beam || j == steps_[k].next_on_rim) onward.push_back(j);
    return *std::ranges::min_element(onward, {}, clockwise);
  }

  const Complex& complex_;
  const VertexFaces& faces_at_;
  const EdgeTable& edges_;
  const Hole& hole_;
  const std::map<VertexId, Vec3>& normals_;
  Plane plane_;
  std::vector<std::vector<Vec2>> rims_in_plane_;
  double longest_ = 0;                               // that is followed, a length
  std::map<std::array<double, 3>, VertexId> place_;  // the node that is followed, by its coordinates
  std::map<Beam, Obstacle> obstacle_;                // of those that are not followed
  std::set<Beam> beams_;                             // that are followed
  std::map<VertexId, Vec3> inner_;                   // normals
  bool is_one_piece_ = true;                         // the rims and the beams
  std::vector<Step> steps_;
  std::map<VertexId, std::vector<std::size_t>> from_;  // steps
};

}  // namespace

FollowedBeams follow_beams(const Complex& complex, const VertexFaces& faces_at, const EdgeTable& edges,
                           const Hole& hole, const std::map<VertexId, Vec3>& normals, const LeftOut& left_out) {
  return Follower(complex, faces_at, edges, hole, normals).run(left_out);
}

}  // namespace meshgraft
