#include "merge/near_misses.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "core/blocks.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"
#include "merge/edges.hpp"
#include "merge/inputs.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kEnds = 2;
constexpr std::size_t kPlaces = 3;  // on an edge: its ends, then its middle

class NearMisses {
 public:
  NearMisses(const Outcome& outcome, const Tolerance& tolerance, const NearMissLimits& limits)
      : outcome_(outcome), complex_(outcome.final_complex), tolerance_(tolerance), limits_(limits) {}

  std::vector<Warning> warnings() {
    if (outcome_.kind == OperationKind::kFill) return {};
    find_edges();
    find_faces();
    for (std::size_t first = 0; first < near_.size();) {
      std::size_t last = first;
      while (last < near_.size() && near_[last].edge == near_[first].edge &&
             near_[last].component == near_[first].component)
        ++last;
      judge(std::span(near_).subspan(first, last - first));
      first = last;
    }
    return told();
  }

 private:
  /// A face near an edge.
  struct Near {
    std::uint32_t edge, component;
    FaceId face;
    friend constexpr auto operator<=>(const Near&, const Near&) = default;
  };

  /// Of the edges of one input beside another.
  struct Miss {
    std::size_t n = 0;
    double least = std::numeric_limits<double>::infinity(), most = 0;
    FaceOnEdge nearest;
  };

  [[nodiscard]] std::array<Vec3, kPlaces> places(const FaceOnEdge& e) const {
    const Vec3 a = complex_.position[e.low.value], b = complex_.position[e.high.value];
    return {a, b, midpoint(a, b)};
  }
  [[nodiscard]] double allowed(const FaceOnEdge& e) const {
    const auto [a, b, middle] = places(e);
    return limits_.max_distance * distance(a, b);
  }

  /// Free edges of which all faces are known.
  void find_edges() {
    const std::vector<FaceOnEdge> uses = edge_uses(complex_);
    const auto is_known = [&](VertexId v) { return complex_.state[v.value] != VertexState::kFrozen; };
    for_each_edge(uses, [&](std::span<const FaceOnEdge> edge) {
      if (edge.size() == 1 && (is_known(edge[0].low) || is_known(edge[0].high))) edges_.push_back(edge[0]);
    });
  }

  void find_faces() {
    std::vector<Box> boxes(edges_.size());
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      for (const Vec3 p : places(edges_[i])) boxes[i].add(p);
      boxes[i] = boxes[i].grown(allowed(edges_[i]));
    }
    const BoxTree tree(boxes);
    const auto box_of = [&](std::size_t f) {
      Box box;
      for (const Vec3 p : complex_.corners(FaceId(f))) box.add(p);
      return box;
    };
    near_ = collected_near<Near>(
        complex_.n_faces(), box_of, [&](std::size_t, std::size_t, const Box& run) { return tree.meets(run); },
        [&](std::size_t f, std::vector<Near>& out) {
          tree.overlapping(box_of(f), [&](std::uint32_t i) {
            const std::uint32_t own = complex_.component[edges_[i].face.value];
            for (const std::uint32_t c : complex_.components_of(FaceId(f)))
              if (c != own && complex_.joins.are_joined(c, own)) out.push_back({i, c, FaceId(f)});
          });
        });
    std::sort(near_.begin(), near_.end());
  }

  /// The faces of one component near one edge.
  void judge(std::span<const Near> faces) {
    const FaceOnEdge& edge = edges_[faces[0].edge];
    const std::array<Vec3, kPlaces> at = places(edge);
    const std::array<VertexId, kEnds> ends{edge.low, edge.high};
    std::array<double, kPlaces> least;
    least.fill(std::numeric_limits<double>::infinity());
    std::array<bool, kEnds> joined{};
    for (const Near& near : faces) {
      const Triangle t = complex_.corners(near.face);
      for (std::size_t i = 0; i < kPlaces; ++i)
        least[i] = std::min(least[i], distance(at[i], closest_on_triangle(at[i], t).point));
      for (std::size_t i = 0; i < kEnds; ++i)
        joined[i] = joined[i] ||
                    std::ranges::find(complex_.face[near.face.value], ends[i]) != complex_.face[near.face.value].end();
    }
    const double farthest = *std::ranges::max_element(least);
    if (joined[0] || joined[1] || farthest > allowed(edge)) return;  // one that leaves the junction is not meant
    Miss& miss = misses_[{complex_.parent[edge.face.value].input, complex_.parent[faces[0].face.value].input}];
    ++miss.n;
    miss.most = std::max(miss.most, farthest);
    if (farthest < miss.least) miss.least = farthest, miss.nearest = edge;
  }

  /// What is within the tolerance was in reach, and joining it was given up.
  [[nodiscard]] std::string advice(const Miss& miss) const {
    const auto [a, b, middle] = places(miss.nearest);
    if (miss.least > tolerance_.at(distance(a, b))) return "; a larger --tolerance may join them";
    return "; that is within the --tolerance, which could not be used there: look at the place in both meshes";
  }

  [[nodiscard]] std::vector<Warning> told() const {
    std::vector<Warning> warnings;
    for (const auto& [inputs, miss] : misses_) {
      const ElementRef parent = complex_.parent[miss.nearest.face.value];
      const Vec3 at = places(miss.nearest).back();
      const std::string others = miss.n == 1   ? ""
                                 : miss.n == 2 ? "; so does another, "
                                               : "; so do " + std::to_string(miss.n - 1) + " others, up to ";
      warnings.push_back({"near-miss",
                          "the free edge of " + text_of(outcome_.inputs, parent) + " around " + text_of(at) +
                              " comes within " + text_of(miss.least) + " of " + outcome_.inputs[inputs[1]]->path +
                              " and is not joined with it" + others + (miss.n > 1 ? text_of(miss.most) + " away" : "") +
                              advice(miss),
                          place_of(*outcome_.inputs[parent.input], parent.element)});
    }
    return warnings;
  }

  const Outcome& outcome_;
  const Complex& complex_;
  const Tolerance& tolerance_;
  const NearMissLimits& limits_;
  std::vector<FaceOnEdge> edges_;                        // free
  std::vector<Near> near_;                               // ascending
  std::map<std::array<std::uint32_t, 2>, Miss> misses_;  // by the input of the edge and that of the other mesh
};

}  // namespace

std::vector<Warning> near_miss_warnings(const Outcome& outcome, const Tolerance& tolerance,
                                        const NearMissLimits& limits) {
  return NearMisses(outcome, tolerance, limits).warnings();
}

}  // namespace meshgraft
