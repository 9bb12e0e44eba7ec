#include "intersect/polygon.hpp"

#include <algorithm>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

bool is_left_turn(const PolygonCorner& a, const PolygonCorner& b, const PolygonCorner& c) {
  return (a.lines & b.lines & c.lines) == 0 && turn_sign(a.at, b.at, c.at) > 0;
}

double quality(const PolygonCorner& a, const PolygonCorner& b, const PolygonCorner& c) {
  const auto point = [](Vec2 p) { return Vec3{p.x, p.y, 0}; };
  return aspect_ratio({point(a.at), point(b.at), point(c.at)});
}

/// True if p lies beside the segment, not beyond one of its ends.
bool is_beside(Vec2 p, Vec2 a, Vec2 b) {
  const double along = (p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y);
  const double back = (p.x - b.x) * (a.x - b.x) + (p.y - b.y) * (a.y - b.y);
  return along > 0 && back > 0;
}

/// Best triangulation by dynamic programming over pieces of the contour (Klincsek 1980).
class BestTriangulation {
 public:
  explicit BestTriangulation(std::span<const PolygonCorner> p) : p_(p), n_(p.size()), cell_(n_ * n_) {
    for (std::size_t width = 2; width < n_; ++width)
      for (std::size_t i = 0; i + width < n_; ++i) solve(i, i + width);
  }

  [[nodiscard]] std::optional<Triangles> result() const {
    if (cell_[n_ - 1].quality < 0) return std::nullopt;
    Triangles triangles;
    add(0, n_ - 1, triangles);
    return triangles;
  }

 private:
  struct Cell {
    double quality = -1;  // worst Q between corner i and corner j; negative: impossible
    std::uint32_t apex = 0;
  };

  void solve(std::size_t i, std::size_t j) {
    Cell& best = cell_[i * n_ + j];
    for (std::size_t k = i + 1; k < j; ++k) {
      const double left = k == i + 1 ? 1 : cell_[i * n_ + k].quality;
      const double right = k + 1 == j ? 1 : cell_[k * n_ + j].quality;
      if (std::min(left, right) <= best.quality || !is_left_turn(p_[i], p_[k], p_[j])) continue;
      const double q = std::min({left, right, quality(p_[i], p_[k], p_[j])});
      if (q > best.quality) best = {q, static_cast<std::uint32_t>(k)};
    }
  }

  void add(std::size_t i, std::size_t j, Triangles& out) const {
    if (j < i + 2) return;
    const std::uint32_t k = cell_[i * n_ + j].apex;
    out.push_back({static_cast<std::uint32_t>(i), k, static_cast<std::uint32_t>(j)});
    add(i, k, out);
    add(k, j, out);
  }

  std::span<const PolygonCorner> p_;
  std::size_t n_;
  std::vector<Cell> cell_;  // n x n
};

/// Cuts ears off a large polygon, the best first.
class EarCutter {
 public:
  explicit EarCutter(std::span<const PolygonCorner> p) : p_(p), left_(p.size()), quality_(p.size()) {
    for (std::uint32_t i = 0; i < p.size(); ++i) left_[i] = i;
    for (std::size_t i = 0; i < p.size(); ++i) quality_[i] = ear_quality(i);
  }

  std::optional<Triangles> result() {
    Triangles triangles;
    while (left_.size() > 2) {
      const auto best = std::max_element(quality_.begin(), quality_.end());
      if (*best < 0) return std::nullopt;
      const auto i = static_cast<std::size_t>(best - quality_.begin());
      triangles.push_back({corner(i + left_.size() - 1), corner(i), corner(i + 1)});
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
      quality_.erase(best);
      quality_[i % left_.size()] = ear_quality(i % left_.size());
      quality_[(i + left_.size() - 1) % left_.size()] = ear_quality((i + left_.size() - 1) % left_.size());
    }
    return triangles;
  }

 private:
  [[nodiscard]] std::uint32_t corner(std::size_t i) const { return left_[i % left_.size()]; }

  /// Quality of the ear at position i of what is left; negative if it may not be cut. A corner close
  /// to the cut would leave a sliver, so the ear counts as flat as the triangle that it makes there.
  [[nodiscard]] double ear_quality(std::size_t i) const {
    const std::size_t n = left_.size();
    const PolygonCorner &a = p_[corner(i + n - 1)], &b = p_[corner(i)], &c = p_[corner(i + 1)];
    if (!is_left_turn(a, b, c)) return -1;
    double q = quality(a, b, c);
    for (std::size_t k = i + 2; k < i + n - 1; ++k) {
      const PolygonCorner& d = p_[corner(k)];
      if (d.id == a.id || d.id == b.id || d.id == c.id) continue;
      const int ac = turn_sign(c.at, a.at, d.at);
      if (ac >= 0 && turn_sign(a.at, b.at, d.at) >= 0 && turn_sign(b.at, c.at, d.at) >= 0) return -1;
      if (ac < 0 && is_beside(d.at, a.at, c.at)) q = std::min(q, quality(a, c, d));
    }
    return q;
  }

  std::span<const PolygonCorner> p_;
  std::vector<std::uint32_t> left_;  // corners not yet cut off
  std::vector<double> quality_;      // of the ear at each
};

}  // namespace

std::optional<Triangles> triangulated(std::span<const PolygonCorner> polygon) {
  if (polygon.size() < 3) return std::nullopt;
  if (polygon.size() <= kBestPolygon) return BestTriangulation(polygon).result();
  return EarCutter(polygon).result();
}

}  // namespace meshgraft
