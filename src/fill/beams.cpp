#include "fill/beams.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/union_find.hpp"
#include "geometry/plane.hpp"
#include "meshgraft/vec3.hpp"

namespace meshgraft {
namespace {

const double kSteepest = std::sin(20 * std::numbers::pi / 180);  // of a beam to the surface at its ends

constexpr double kLongest = 2;  // sides of the rims, on average: a longer beam would leave poor faces beside it

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
    for (const Rim& rim : hole) n += static_cast<double>(rim.vertices.size());
    longest_ = kLongest * length_of(complex, hole) / n;
  }

  FollowedBeams run(const LeftOut& left_out) {
    const std::set<Beam> all = hanging(open_beams());
    find_places(all);
    std::set<Beam> along;
    std::map<Beam, Obstacle> obstacles;
    for (const Beam& beam : all) {
      const std::optional<Obstacle> obstacle = obstacle_of(beam, left_out);
      if (obstacle != Obstacle::kBeside && obstacle != Obstacle::kTooSteep) along.insert(beam);
      if (obstacle)
        obstacles[beam] = *obstacle;
      else
        beams_.insert(beam);
    }
    const std::set<Beam> free_of_obstacles = std::exchange(beams_, hanging(beams_));
    for (const Beam& beam : free_of_obstacles)
      if (!beams_.contains(beam)) obstacles[beam] = Obstacle::kCutOff;
    const auto cut = beams_.empty() || !tell_regions_apart() ? std::nullopt : regions();
    if (!cut)
      for (const Beam& beam : std::exchange(beams_, {})) obstacles[beam] = Obstacle::kNoFaces;

    FollowedBeams followed;
    followed.regions = cut ? *cut : std::vector<Region>{whole()};
    for (const auto& [a, b] : beams_) {
      followed.beams.insert(nodes_of(complex_, a, b));
      for (const VertexId v : {a, b})
        if (!is_of_rim(v)) followed.normal[v] = normal(v);
    }
    const std::set<Beam> in_hole = hanging(along), across = without_dead_ends(all);
    for (const Complex::Line& line : complex_.lines)
      if (const auto it = obstacles.find(beam_of(line));
          it != obstacles.end() && (in_hole.contains(it->first) || across.contains(it->first)))
        followed.unfollowed.push_back({line.parent.element, it->second});
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

  [[nodiscard]] Region whole() const {
    Region rims;
    for (const Rim& rim : hole_) rims.push_back(rim.vertices);
    return rims;
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

  [[nodiscard]] std::optional<Obstacle> obstacle_of(const Beam& beam, const LeftOut& left_out) {
    const auto [a, b] = beam;
    if (at(a) == at(b)) return Obstacle::kNoLength;
    const auto is_over_hole = [&](VertexId v) { return is_of_rim(followed_at(v)) || is_inside(plane_(at(v))); };
    if (is_of_rim(followed_at(a)) && is_of_rim(followed_at(b))) {
      if (!is_inside(plane_(midpoint(at(a), at(b))))) return Obstacle::kBeside;
    } else if (!is_over_hole(a) || !is_over_hole(b)) {
      return Obstacle::kBeside;
    }
    const Vec3 way = normalized(at(b) - at(a));
    if (std::abs(dot(way, normal(a))) > kSteepest || std::abs(dot(way, normal(b))) > kSteepest)
      return Obstacle::kTooSteep;
    if (followed_at(a) != a || followed_at(b) != b) return Obstacle::kSamePlace;
    if (distance(at(a), at(b)) > longest_) return Obstacle::kTooLong;
    const auto it = left_out.find(nodes_of(complex_, a, b));
    return it == left_out.end() ? std::nullopt : std::optional(it->second);
  }

  /// By the sides that a ray to the right crosses.
  [[nodiscard]] bool is_inside(Vec2 p) const {
    bool inside = false;
    for (const Rim& rim : hole_)
      for (std::size_t k = 0; k < rim.vertices.size(); ++k) {
        const Vec2 a = plane_(at(rim.vertices[k])), b = plane_(at(rim.vertices[(k + 1) % rim.vertices.size()]));
        if ((a.y > p.y) != (b.y > p.y) && turn_sign(a, b, p) == (b.y > a.y ? 1 : -1)) inside = !inside;
      }
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
  double longest_ = 0;  // a length
  std::map<std::array<double, 3>, VertexId> place_;
  std::set<Beam> beams_;            // that are followed
  std::map<VertexId, Vec3> inner_;  // normals
  bool is_one_piece_ = true;        // the rims and the beams
  std::vector<Step> steps_;
  std::map<VertexId, std::vector<std::size_t>> from_;  // steps
};

}  // namespace

FollowedBeams follow_beams(const Complex& complex, const VertexFaces& faces_at, const EdgeTable& edges,
                           const Hole& hole, const std::map<VertexId, Vec3>& normals, const LeftOut& left_out) {
  return Follower(complex, faces_at, edges, hole, normals).run(left_out);
}

}  // namespace meshgraft
