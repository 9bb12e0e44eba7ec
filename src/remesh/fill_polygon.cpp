#include "remesh/fill_polygon.hpp"

#include <algorithm>
#include <compare>
#include <limits>

#include "remesh/few.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kUsualFaces = 6, kUsualParts = 64;  // of the polygons around a vertex
constexpr double kNothing = std::numeric_limits<double>::infinity();

using Scores = Few<double, kUsualFaces>;

/// The best filling of the part of the polygon from corner i to corner j.
struct Part {
  std::uint32_t apex = 0;  // of the face on edge i j
  Scores scores;           // ascending, the worst `depth` of them
};

/// Two ascending lists read as one.
class Both {
 public:
  Both(const Scores& a, const Scores& b) : a_(a), b_(b) {}
  [[nodiscard]] bool done() const { return i_ == a_.size() && j_ == b_.size(); }
  double next() {
    if (j_ == b_.size() || (i_ < a_.size() && a_[i_] <= b_[j_])) return a_[i_++];
    return b_[j_++];
  }

 private:
  const Scores &a_, &b_;
  std::size_t i_ = 0, j_ = 0;
};

/// The first corner of the smallest among the rotations of the polygon, so that equal choices do not depend on
/// where it starts.
std::uint32_t first_corner(std::span<const VertexId> polygon) {
  const auto n = polygon.size();
  const VertexId least = *std::ranges::min_element(polygon);
  std::size_t best = n;
  const auto smaller = [&](std::size_t a, std::size_t b) {
    for (std::size_t k = 0; k < n; ++k) {
      const VertexId u = polygon[(a + k) % n], v = polygon[(b + k) % n];
      if (u != v) return u < v;
    }
    return false;
  };
  for (std::size_t k = 0; k < n; ++k)
    if (polygon[k] == least && (best == n || smaller(k, best))) best = k;
  return static_cast<std::uint32_t>(best);
}

class Filling {
 public:
  Filling(std::span<const VertexId> polygon, const FillRules& rules)
      : n_(static_cast<std::uint32_t>(polygon.size())),
        first_(first_corner(polygon)),
        polygon_(polygon),
        rules_(rules),
        depth_(rules.depth == 0 ? polygon.size() : rules.depth),
        part_(std::size_t{n_} * (n_ - 1) / 2),
        worst_from_(std::size_t{n_} * n_, 0),
        worst_to_(std::size_t{n_} * n_, 0) {}

  std::optional<PolygonFill> run() {
    for (std::uint32_t i = 0; i + 1 < n_; ++i) set_worst(i, i + 1, kNothing);
    for (std::uint32_t width = 2; width < n_; ++width)
      for (std::uint32_t i = 0; i + width < n_; ++i) fill(i, i + width);
    if (!(worst_from_[n_ - 1] > 0)) return std::nullopt;
    return collected();
  }

 private:
  Part& part(std::uint32_t i, std::uint32_t j) {
    return part_[std::size_t{i} * (2 * std::size_t{n_} - i - 1) / 2 + (j - i - 1)];
  }
  [[nodiscard]] std::uint32_t corner(std::uint32_t i) const { return (first_ + i) % n_; }

  /// The worst score of a part, twice, so that all parts from i and all parts to j lie side by side; infinite for
  /// an edge, 0 where there is no filling.
  void set_worst(std::uint32_t i, std::uint32_t j, double worst) {
    worst_from_[std::size_t{i} * n_ + j] = worst_to_[std::size_t{j} * n_ + i] = worst;
  }

  [[nodiscard]] double score(std::uint32_t i, std::uint32_t k, std::uint32_t j) const {
    std::array<std::uint32_t, 3> c{corner(i), corner(k), corner(j)};
    std::ranges::sort(c);
    return rules_.score(c[0], c[1], c[2]);
  }

  void fill(std::uint32_t i, std::uint32_t j) {
    if (!(i == 0 && j == n_ - 1) && !rules_.may_join(corner(i), corner(j))) return;
    Part& best = part(i, j);
    double worst = 0;  // of the best
    const double* from = &worst_from_[std::size_t{i} * n_];
    const double* to = &worst_to_[std::size_t{j} * n_];
    for (std::uint32_t k = i + 1; k < j; ++k) {
      const double bound = std::min(from[k], to[k]);
      if (bound < worst || !(bound > 0)) continue;
      const Part &left = part(i, k), &right = part(k, j);
      if (worst > 0 && is_less(left.scores, right.scores, best.scores)) continue;
      const double q = score(i, k, j);
      if (!(q > 0) || q < worst) continue;
      merge(left.scores, right.scores, q);
      const bool better = !(worst > 0) || trial_ > best.scores ||
                          (trial_ == best.scores && polygon_[corner(k)] < polygon_[corner(best.apex)]);
      if (!better) continue;
      best.apex = k;
      best.scores.swap(trial_);
      worst = best.scores.front();
    }
    if (worst > 0) set_worst(i, j, worst);
  }

  /// Whether the two sides alone are worse already than the best: a further score cannot make them better.
  static bool is_less(const Scores& left, const Scores& right, const Scores& best) {
    Both both(left, right);
    for (std::size_t k = 0; k < best.size() && !both.done(); ++k)
      if (const double s = both.next(); s != best[k]) return s < best[k];
    return false;
  }

  /// trial_ = the worst scores of both sides and q, ascending.
  void merge(const Scores& left, const Scores& right, double q) {
    trial_.clear();
    Both both(left, right);
    bool placed = false;
    double s = both.done() ? kNothing : both.next();
    while (trial_.size() < depth_ && !(placed && s == kNothing)) {
      if (!placed && q <= s) {
        trial_.push_back(q), placed = true;
      } else {
        trial_.push_back(s);
        s = both.done() ? kNothing : both.next();
      }
    }
  }

  PolygonFill collected() {
    PolygonFill result;
    std::vector<std::array<std::uint32_t, 2>> open{{0, n_ - 1}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (j - i < 2) continue;
      const std::uint32_t k = part(i, j).apex;
      result.faces.push_back({corner(i), corner(k), corner(j)});
      result.scores.push_back(score(i, k, j));
      open.push_back({k, j});
      open.push_back({i, k});
    }
    std::ranges::sort(result.scores);
    return result;
  }

  std::uint32_t n_, first_;
  std::span<const VertexId> polygon_;
  const FillRules& rules_;
  std::size_t depth_;
  Few<Part, kUsualParts> part_;                     // by i < j
  Few<double, kUsualParts> worst_from_, worst_to_;  // by i and j; by j and i
  Scores trial_;
};

}  // namespace

std::optional<PolygonFill> fill_polygon(std::span<const VertexId> polygon, const FillRules& rules) {
  return Filling(polygon, rules).run();
}

}  // namespace meshgraft
