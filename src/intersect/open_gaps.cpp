#include "intersect/open_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"

namespace meshgraft {
namespace {

/// A joint nearer than this many tolerances is the joint of that place: surfaces that diverge from
/// it at a small angle are still near each other there.
constexpr double kBeside = 6;

struct Found {
  std::array<std::uint32_t, 2> feature;  // vertex and kNowhere, or the two edges
  Corefined::OpenGap gap;
};

class Search {
 public:
  explicit Search(const Meeting& meeting)
      : m_(meeting),
        ending_(ending_features(meeting, &Snap::asked)),
        joints_(joints_of(meeting)),
        tree_(boxes_of(joints_)) {}

  std::vector<Corefined::OpenGap> run() {
    for (const FacePair& p : m_.pairs) {
      const FaceId f = m_.side[0].face(p[0]), g = m_.side[1].face(p[1]);
      tolerance_ = m_.rule.at(std::min(m_.size[f.value], m_.size[g.value])).asked;
      for (const std::size_t s : kSides) look_at_vertices(p, s);
      look_at_edges(p);
    }
    std::sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
      return std::tie(a.feature, a.gap.distance, a.gap.faces) < std::tie(b.feature, b.gap.distance, b.gap.faces);
    });
    const auto same = [](const Found& a, const Found& b) { return a.feature == b.feature; };
    found_.erase(std::unique(found_.begin(), found_.end(), same), found_.end());
    std::vector<Corefined::OpenGap> gaps;
    for (const Found& f : found_) gaps.push_back(f.gap);
    return gaps;
  }

 private:
  using Joint = std::array<Vec3, 2>;

  /// The places of the symbols, and the edges that both sides have, which may be long.
  static std::vector<Joint> joints_of(const Meeting& m) {
    std::vector<Joint> joints;
    for (const Symbol& symbol : m.symbols) joints.push_back({m.at(symbol.vertex), m.at(symbol.vertex)});
    for (LocalEdge e = 0; e < m.side[1].n_edges(); ++e)
      if (const auto& [a, b] = m.side[1].ends(e); m.side[0].find(a, b) != kNowhere)
        joints.push_back({m.at(a), m.at(b)});
    return joints;
  }

  static std::vector<Box> boxes_of(const std::vector<Joint>& joints) {
    std::vector<Box> boxes(joints.size());
    for (std::size_t k = 0; k < boxes.size(); ++k)
      for (const Vec3 p : joints[k]) boxes[k].add(p);
    return boxes;
  }

  void look_at_vertices(const FacePair& p, std::size_t s) {
    const Triangle t = m_.triangle(1 - s, p[1 - s]);
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    for (const VertexId v : m_.side[s].corners(p[s])) {
      if (ending_.vertex[s][v.value] == 0 || !m_.side[s].is_feature(v) || m_.has_symbol(s, v)) continue;
      if (std::abs(dot(n, m_.at(v) - t[0])) > tolerance_ * norm(n)) continue;
      add({v.value, kNowhere}, p, s, m_.at(v), distance(m_.at(v), closest_on_triangle(m_.at(v), t).point));
    }
  }

  void look_at_edges(const FacePair& p) {
    for (const LocalEdge e : m_.side[0].edges(p[0]))
      for (const LocalEdge f : m_.side[1].edges(p[1])) {
        if ((!ends(0, e) && !ends(1, f)) || m_.share_end(e, f)) continue;
        const auto& [a, b] = m_.side[0].ends(e);
        const auto& [c, d] = m_.side[1].ends(f);
        if (are_apart(m_.at(a), m_.at(b), m_.at(c), m_.at(d), tolerance_)) continue;
        const SegmentPair near = closest_between_segments(m_.at(a), m_.at(b), m_.at(c), m_.at(d));
        add({e, f}, p, ends(1, f) ? 1 : 0, near.first.point, distance(near.first.point, near.second.point));
      }
  }

  /// Other lines of a mesh need not end on anything.
  [[nodiscard]] bool ends(std::size_t s, LocalEdge e) const {
    return ending_.edge[s][e] != 0 && m_.side[s].is_feature_edge(e);
  }

  void add(std::array<std::uint32_t, 2> feature, const FacePair& p, std::size_t of, Vec3 at, double apart) {
    if (apart > tolerance_ || is_joined_beside(at)) return;
    const FaceId f = m_.side[0].face(p[0]), g = m_.side[1].face(p[1]);
    found_.push_back({feature, {{m_.complex.parent[f.value], m_.complex.parent[g.value]}, at, apart, of}});
  }

  [[nodiscard]] bool is_joined_beside(Vec3 at) const {
    Box place;
    place.add(at);
    const double beside = kBeside * tolerance_;
    bool any = false;
    tree_.overlapping(place.grown(beside), [&](std::uint32_t k) {
      any = any || distance(at, closest_on_segment(at, joints_[k][0], joints_[k][1]).point) <= beside;
    });
    return any;
  }

  const Meeting& m_;
  EndingFeatures ending_;
  std::vector<Joint> joints_;
  BoxTree tree_;
  double tolerance_ = 0;
  std::vector<Found> found_;
};

}  // namespace

std::vector<Corefined::OpenGap> find_open_gaps(const Meeting& meeting) { return Search(meeting).run(); }

}  // namespace meshgraft
