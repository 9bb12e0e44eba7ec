#include "remesh/fill_polygon.hpp"

#include <algorithm>

#include "remesh/few.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kUsualFaces = 6, kUsualParts = 64;  // of the polygons around a vertex

using Scores = Few<double, kUsualFaces>;

/// The best filling of the part of the polygon from corner i to corner j.
struct Part {
  bool possible = false;
  std::uint32_t apex = 0;  // of the face on edge i j
  Scores scores;           // ascending
};

/// Runs over the polygon from its smallest id, so that equal choices do not depend on its rotation.
class Filling {
 public:
  Filling(std::span<const VertexId> polygon, const FillRules& rules)
      : n_(static_cast<std::uint32_t>(polygon.size())),
        first_(static_cast<std::uint32_t>(std::ranges::min_element(polygon) - polygon.begin())),
        polygon_(polygon),
        rules_(rules),
        part_(std::size_t{n_} * n_) {}

  std::optional<PolygonFill> run() {
    for (std::uint32_t i = 0; i + 1 < n_; ++i) part(i, i + 1).possible = true;
    for (std::uint32_t width = 2; width < n_; ++width)
      for (std::uint32_t i = 0; i + width < n_; ++i) fill(i, i + width);
    const Part& all = part(0, n_ - 1);
    if (!all.possible) return std::nullopt;
    PolygonFill result;
    result.scores.assign(all.scores.begin(), all.scores.end());
    collect(0, n_ - 1, result);
    return result;
  }

 private:
  Part& part(std::uint32_t i, std::uint32_t j) { return part_[std::size_t{i} * n_ + j]; }
  [[nodiscard]] std::uint32_t corner(std::uint32_t i) const { return (first_ + i) % n_; }

  [[nodiscard]] double score(std::uint32_t i, std::uint32_t k, std::uint32_t j) const {
    std::array<std::uint32_t, 3> c{corner(i), corner(k), corner(j)};
    std::ranges::sort(c);
    return rules_.score(c[0], c[1], c[2]);
  }

  void fill(std::uint32_t i, std::uint32_t j) {
    if (!(i == 0 && j == n_ - 1) && !rules_.may_join(corner(i), corner(j))) return;
    Part& best = part(i, j);
    for (std::uint32_t k = i + 1; k < j; ++k) {
      const Part &left = part(i, k), &right = part(k, j);
      if (!left.possible || !right.possible) continue;
      const double q = score(i, k, j);
      if (!(q > 0)) continue;
      merge(left.scores, right.scores, q);
      const bool better = !best.possible || trial_ > best.scores ||
                          (trial_ == best.scores && polygon_[corner(k)] < polygon_[corner(best.apex)]);
      if (!better) continue;
      best.possible = true, best.apex = k;
      best.scores.swap(trial_);
    }
  }

  /// trial_ = all scores of both sides and q, ascending.
  void merge(const Scores& left, const Scores& right, double q) {
    trial_.resize(left.size() + right.size());
    std::ranges::merge(left, right, trial_.begin());
    trial_.insert(std::ranges::upper_bound(trial_, q), q);
  }

  void collect(std::uint32_t i, std::uint32_t j, PolygonFill& result) {
    if (j - i < 2) return;
    const std::uint32_t k = part(i, j).apex;
    result.faces.push_back({corner(i), corner(k), corner(j)});
    collect(i, k, result);
    collect(k, j, result);
  }

  std::uint32_t n_, first_;
  std::span<const VertexId> polygon_;
  const FillRules& rules_;
  Few<Part, kUsualParts> part_;
  Scores trial_;
};

}  // namespace

std::optional<PolygonFill> fill_polygon(std::span<const VertexId> polygon, const FillRules& rules) {
  return Filling(polygon, rules).run();
}

}  // namespace meshgraft
