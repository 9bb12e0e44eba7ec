// The edges of the face and the segments are a plane graph; its loops are triangulated one by one.
// Pieces of the graph inside the face are bridged to the rest first, so that no loop has holes.
#include "intersect/cut_face.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geometry/plane.hpp"
#include "geometry/quality.hpp"
#include "intersect/polygon.hpp"

namespace meshgraft {
namespace {

using Local = std::uint32_t;  // position in the list of points of the face

class Graph {
 public:
  Graph(const FaceToCut& face, std::span<const Vec3> position) : to_plane_(area_vector(corners(face, position))) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t line = 1u << k, previous_line = 1u << (k + 2) % 3;
      add_point(face.corner[k], position, line | previous_line);
      for (const VertexId v : face.on_edge[k]) add_point(v, position, line);
    }
    n_border_ = static_cast<Local>(points_.size());
    for (const VertexId v : face.inside) add_point(v, position, 0);
    next_.resize(points_.size());
    for (Local i = 0; i < n_border_; ++i) next_[i].push_back((i + 1) % n_border_);
  }

  /// False if an end is not a point of the face.
  bool add_segment(const std::array<VertexId, 2>& ends) {
    const Local a = find(ends[0]), b = find(ends[1]);
    if (a == points_.size() || b == points_.size()) return false;
    if (!is_border(a, b)) connect(a, b);
    return true;
  }

  /// Joins pieces that hang free inside the face to the rest. False if a way is always blocked.
  bool bridge() {
    while (true) {
      const std::vector<std::uint8_t> reached = reached_from_border();
      if (std::all_of(reached.begin(), reached.end(), [](std::uint8_t r) { return r != 0; })) return true;
      if (!bridge_to(reached)) return false;
    }
  }

  /// The loops around the pieces of the face, counter-clockwise. Nothing if edges lie on each other.
  [[nodiscard]] std::optional<std::vector<std::vector<Local>>> loops() const {
    std::vector<std::vector<Local>> all;
    std::vector<std::vector<std::uint8_t>> used(points_.size());
    for (Local i = 0; i < points_.size(); ++i) used[i].resize(next_[i].size());
    for (Local start = 0; start < points_.size(); ++start)
      for (std::size_t k = 0; k < next_[start].size(); ++k) {
        if (used[start][k]) continue;
        std::vector<Local> loop;
        Local from = start;
        std::size_t way = k;
        while (!used[from][way]) {
          used[from][way] = 1;
          loop.push_back(from);
          const Local to = next_[from][way];
          const auto turn = leftmost(to, from);
          if (!turn) return std::nullopt;
          from = to, way = *turn;
        }
        if (from != start || way != k) return std::nullopt;
        all.push_back(std::move(loop));
      }
    return all;
  }

  [[nodiscard]] const PolygonCorner& point(Local i) const { return points_[i]; }
  [[nodiscard]] VertexId vertex(Local i) const { return VertexId(std::size_t{points_[i].id}); }

 private:
  static Triangle corners(const FaceToCut& face, std::span<const Vec3> position) {
    return {position[face.corner[0].value], position[face.corner[1].value], position[face.corner[2].value]};
  }
  void add_point(VertexId v, std::span<const Vec3> position, std::uint32_t lines) {
    points_.push_back({to_plane_(position[v.value]), v.value, lines});
  }
  [[nodiscard]] Local find(VertexId v) const {
    Local i = 0;
    while (i < points_.size() && points_[i].id != v.value) ++i;
    return i;
  }
  [[nodiscard]] bool is_border(Local a, Local b) const {
    return a < n_border_ && b < n_border_ && ((a + 1) % n_border_ == b || (b + 1) % n_border_ == a);
  }
  void connect(Local a, Local b) { next_[a].push_back(b), next_[b].push_back(a); }

  [[nodiscard]] int turn(Local a, Local b, Local c) const {
    return turn_sign(points_[a].at, points_[b].at, points_[c].at);
  }

  /// The way out of `at` that comes first clockwise from the way back to `back`.
  [[nodiscard]] std::optional<std::size_t> leftmost(Local at, Local back) const {
    const auto& ways = next_[at];
    std::optional<std::size_t> best;
    for (std::size_t k = 0; k < ways.size(); ++k) {
      if (ways[k] == back) continue;
      if (!best) {
        best = k;
        continue;
      }
      const int order = clockwise_order(at, back, ways[k], ways[*best]);
      if (order == 0) return std::nullopt;
      if (order < 0) best = k;
    }
    if (best) return best;
    for (std::size_t k = 0; k < ways.size(); ++k)
      if (ways[k] == back) return k;  // a dangling end
    return std::nullopt;
  }

  /// Negative if a comes before b clockwise around `at` from `from`; 0 if they are in one direction.
  [[nodiscard]] int clockwise_order(Local at, Local from, Local a, Local b) const {
    const int sector_a = sector(at, from, a), sector_b = sector(at, from, b);
    return sector_a != sector_b ? sector_a - sector_b : turn(at, a, b);
  }
  /// Clockwise from `from`: 0 less than half a turn, 1 half a turn, 2 more.
  [[nodiscard]] int sector(Local at, Local from, Local to) const {
    const int side = turn(at, from, to);
    return side < 0 ? 0 : side == 0 ? 1 : 2;
  }

  [[nodiscard]] std::vector<std::uint8_t> reached_from_border() const {
    std::vector<std::uint8_t> reached(points_.size());
    std::vector<Local> open;
    for (Local i = 0; i < n_border_; ++i) reached[i] = 1, open.push_back(i);
    while (!open.empty()) {
      const Local i = open.back();
      open.pop_back();
      for (const Local j : next_[i])
        if (!reached[j]) reached[j] = 1, open.push_back(j);
    }
    return reached;
  }

  /// Connects the nearest two points, one reached and one not, that see each other.
  bool bridge_to(const std::vector<std::uint8_t>& reached) {
    struct Way {
      double length2;
      Local from, to;
    };
    std::vector<Way> ways;
    for (Local i = 0; i < points_.size(); ++i)
      for (Local j = 0; j < points_.size(); ++j)
        if (!reached[i] && reached[j]) {
          const double dx = points_[i].at.x - points_[j].at.x, dy = points_[i].at.y - points_[j].at.y;
          ways.push_back({dx * dx + dy * dy, i, j});
        }
    std::sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) {
      return std::tie(a.length2, a.from, a.to) < std::tie(b.length2, b.from, b.to);
    });
    for (const Way& w : ways)
      if (is_free(w.from, w.to)) {
        connect(w.from, w.to);
        return true;
      }
    return false;
  }

  /// True if the segment between two points touches no edge and no point of the graph.
  [[nodiscard]] bool is_free(Local a, Local b) const {
    for (Local c = 0; c < points_.size(); ++c) {
      if (c != a && c != b && turn(a, b, c) == 0 && is_between(c, a, b)) return false;
      for (const Local d : next_[c])
        if (c != a && c != b && d != a && d != b && turn(a, b, c) * turn(a, b, d) < 0 &&
            turn(c, d, a) * turn(c, d, b) < 0)
          return false;
    }
    return true;
  }
  [[nodiscard]] bool is_between(Local c, Local a, Local b) const {
    const Vec2 p = points_[c].at, q = points_[a].at, r = points_[b].at;
    return std::min(q.x, r.x) <= p.x && p.x <= std::max(q.x, r.x) && std::min(q.y, r.y) <= p.y &&
           p.y <= std::max(q.y, r.y);
  }

  Plane to_plane_;
  std::vector<PolygonCorner> points_;  // the border first, in order
  Local n_border_ = 0;
  std::vector<std::vector<Local>> next_;  // ways out of each point; outer sides of the border are not there
};

}  // namespace

std::optional<std::vector<std::array<VertexId, 3>>> cut(const FaceToCut& face, std::span<const Vec3> position) {
  const auto& on = face.on_edge;
  if (on[0].empty() && on[1].empty() && on[2].empty() && face.inside.empty()) return std::vector{face.corner};
  Graph graph(face, position);
  for (const auto& s : face.segments)
    if (!graph.add_segment(s)) return std::nullopt;
  if (!graph.bridge()) return std::nullopt;
  const auto loops = graph.loops();
  if (!loops) return std::nullopt;

  std::vector<std::array<VertexId, 3>> triangles;
  std::vector<PolygonCorner> polygon;
  for (const std::vector<Local>& loop : *loops) {
    polygon.clear();
    for (const Local i : loop) polygon.push_back(graph.point(i));
    const auto pieces = triangulated(polygon);
    if (!pieces) return std::nullopt;
    for (const auto& [a, b, c] : *pieces)
      triangles.push_back({graph.vertex(loop[a]), graph.vertex(loop[b]), graph.vertex(loop[c])});
  }
  return triangles;
}

}  // namespace meshgraft
