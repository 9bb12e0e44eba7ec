#include "fill/beams.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

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
    for (const Rim& rim : hole) {
      for (const VertexId v : rim.vertices) box_.add(at(v));
      n += static_cast<double>(rim.vertices.size());
    }
    side_ = length_of(complex, hole) / n;
  }

  FollowedBeams run() {
    for (const Complex::Line& line : complex_.lines)
      if (lies_in_hole(line.ends))
        beams_.insert({std::min(line.ends[0], line.ends[1]), std::max(line.ends[0], line.ends[1])});
    const std::optional<std::vector<Region>> cut = drop_loose_beams() ? regions() : std::nullopt;
    if (cut) {
      FollowedBeams followed{*cut, {}, inner_};
      for (const auto& [a, b] : beams_) followed.beams.insert(nodes_of(complex_, a, b));
      return followed;
    }
    Region whole;
    for (const Rim& rim : hole_) whole.push_back(rim.vertices);
    return {{whole}, {}, {}};
  }

 private:
  using Beam = std::array<VertexId, 2>;

  [[nodiscard]] Vec3 at(VertexId v) const { return complex_.position[v.value]; }
  [[nodiscard]] bool is_of_rim(VertexId v) const { return normals_.contains(v); }
  [[nodiscard]] Vec3 normal(VertexId v) const { return is_of_rim(v) ? normals_.at(v) : inner_.at(v); }

  bool lies_in_hole(const Beam& ends) {
    const auto [a, b] = ends;
    if (a == b || edges_.find(a, b).valid() || !is_open(a) || !is_open(b)) return false;
    if (is_of_rim(a) && is_of_rim(b) && !is_inside(plane_(midpoint(at(a), at(b))))) return false;
    if (distance(at(a), at(b)) > kLongest * side_) return false;
    const Vec3 way = normalized(at(b) - at(a));
    return std::abs(dot(way, normal(a))) <= kSteepest && std::abs(dot(way, normal(b))) <= kSteepest;
  }

  /// Of the rim, or inside of it without a face.
  bool is_open(VertexId v) {
    if (is_of_rim(v)) return true;
    if (!faces_at_[v].empty() || !box_.overlaps({at(v), at(v)}) || !is_inside(plane_(at(v)))) return false;
    if (inner_.contains(v)) return true;
    Vec3 sum;
    for (const auto& [u, n] : normals_) sum += n / squared_norm(at(v) - at(u));
    inner_[v] = normalized(sum);
    return true;
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

  /// Beams that hang together with no rim go. Whether the rest tells what is one region: where beams close a circle,
  /// all must hang together.
  bool drop_loose_beams() {
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
    for (const Beam& beam : beams_) together.unite(number.at(beam[0]), number.at(beam[1]));
    const auto is_loose = [&](std::uint32_t k) { return together.find(k) >= hole_.size(); };
    std::erase_if(beams_, [&](const Beam& beam) { return is_loose(number.at(beam[0])); });
    std::size_t pieces = 0, nodes = 0;
    for (std::uint32_t k = 0; k < n; ++k) {
      if (is_loose(k)) continue;
      ++nodes;
      if (together.find(k) == k) ++pieces;
    }
    is_one_piece_ = pieces == 1;
    return !beams_.empty() && (is_one_piece_ || beams_.size() == nodes - pieces);
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
  [[nodiscard]] std::size_t next(std::size_t k) const {
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
  Box box_;
  double side_ = 0;  // of the rims, mean length
  std::set<Beam> beams_;
  std::map<VertexId, Vec3> inner_;  // normals
  bool is_one_piece_ = true;        // the rims and the beams
  std::vector<Step> steps_;
  std::map<VertexId, std::vector<std::size_t>> from_;  // steps
};

}  // namespace

FollowedBeams follow_beams(const Complex& complex, const VertexFaces& faces_at, const EdgeTable& edges,
                           const Hole& hole, const std::map<VertexId, Vec3>& normals) {
  return Follower(complex, faces_at, edges, hole, normals).run();
}

}  // namespace meshgraft
