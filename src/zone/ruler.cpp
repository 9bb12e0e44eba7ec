#include "zone/ruler.hpp"

#include <algorithm>
#include <cmath>

#include "core/blocks.hpp"
#include "geometry/closest.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kSizeBlock = 64;  // points or segments at which the size is asked for in one go
constexpr double kSampleStep = 0.125;   // share of the size between two samples of it where it changes
constexpr double kSteadyStep = 0.5;     // and where it does not
constexpr double kSteady = 0.1;         // relative change between two samples up to which it does not
constexpr double kTie = 1 + 1e-7;       // see its uses
constexpr int kMaxHalvings = 12;        // of a sample interval
constexpr int kMaxRounds = 24;          // of refinement for the sagitta; each at least mends the worst piece

/// Wanted size along the curve; 1 / size is linear between samples.
struct Sampling {
  std::vector<double> s, size, units;  // units: the integral of ds / size from the start

  void integrate() {
    units.assign(s.size(), 0);
    for (std::size_t i = 1; i < s.size(); ++i)
      units[i] = units[i - 1] + (s[i] - s[i - 1]) * 0.5 * (1 / size[i - 1] + 1 / size[i]);
  }

  [[nodiscard]] double units_at(double at) const {
    const std::size_t i = interval(s, at);
    const double t = at - s[i], slope = (1 / size[i + 1] - 1 / size[i]) / (s[i + 1] - s[i]);
    return units[i] + t * (1 / size[i] + 0.5 * slope * t);
  }

  [[nodiscard]] double arc_at(double u) const {
    const std::size_t i = interval(units, u);
    const double need = u - units[i], length = s[i + 1] - s[i];
    const double b = 1 / size[i], slope = (1 / size[i + 1] - b) / length;
    // The root of slope/2 t^2 + b t = need that stays finite when slope is 0.
    const double t = 2 * need / (b + std::sqrt(std::max(0.0, b * b + 2 * slope * need)));
    return s[i] + std::clamp(t, 0.0, length);
  }

 private:
  static std::size_t interval(const std::vector<double>& ascending, double x) {
    const auto it = std::upper_bound(ascending.begin() + 1, ascending.end() - 1, x);
    return static_cast<std::size_t>(it - ascending.begin()) - 1;
  }
};

class Ruler {
 public:
  Ruler(std::span<const Vec3> polyline, const std::function<double(double, Vec3)>& size, const RulerOptions& options)
      : polyline_(polyline), arc_(arc_lengths(polyline)), size_(size), options_(options) {}

  std::vector<double> place(bool loop) {
    if (arc_.back() <= 0) return {0, arc_.back()};
    sample();
    stops_ = {0, arc_.back()};
    std::vector<double> nodes = evenly(loop);
    for (int round = 0; round < kMaxRounds && !mend(nodes); ++round) nodes = evenly(loop);
    return nodes;
  }

 private:
  [[nodiscard]] Vec3 at(double s) const { return point_at(polyline_, arc_, s); }

  struct Sample {
    double s, size;
  };

  /// Samples the size on every segment, symmetrically, so that it changes little between neighbours.
  void sample() {
    std::vector<double> size(arc_.size());  // by point of the polyline
    for_blocks(
        size.size(),
        [&](std::size_t first, std::size_t last) {
          for (std::size_t i = first; i < last; ++i) size[i] = size_(arc_[i], polyline_[i]);
        },
        kSizeBlock);
    const auto samples = collected<Sample>(
        arc_.size() - 1,
        [&](std::size_t i, std::vector<Sample>& out) {
          if (arc_[i] < arc_[i + 1]) halve({arc_[i], size[i]}, {arc_[i + 1], size[i + 1]}, 0, out);
        },
        kSizeBlock);
    sampling_.s = {0}, sampling_.size = {size.front()};
    for (const Sample& sample : samples) sampling_.s.push_back(sample.s), sampling_.size.push_back(sample.size);
    sampling_.integrate();
  }

  void halve(Sample a, Sample b, int depth, std::vector<Sample>& out) const {
    // Lengths and shares of sizes are often equal by design; rounding shall not decide then.
    const double length = (b.s - a.s) * kTie, least = std::min(a.size, b.size);
    const bool steady = depth > 0 && length <= kSteadyStep * least && std::abs(b.size - a.size) <= kSteady * least;
    const bool fine = length <= kSampleStep * least || steady;
    if (fine || depth == kMaxHalvings) return out.push_back(b);
    const double s = 0.5 * (a.s + b.s);
    const Sample middle{s, size_(s, at(s))};
    halve(a, middle, depth + 1, out);
    halve(middle, b, depth + 1, out);
  }

  /// Even spacing between each two stops.
  [[nodiscard]] std::vector<double> evenly(bool loop) const {
    std::vector<double> nodes{0};
    const std::size_t least = !loop ? 1 : stops_.size() == 2 ? 3 : stops_.size() == 3 ? 2 : 1;
    for (std::size_t k = 1; k < stops_.size(); ++k) {
      const double from = sampling_.units_at(stops_[k - 1]), to = sampling_.units_at(stops_[k]);
      const std::size_t n = std::max(least, nearest_count(to - from));
      for (std::size_t i = 1; i < n; ++i)
        nodes.push_back(sampling_.arc_at(from + (to - from) * static_cast<double>(i) / static_cast<double>(n)));
      nodes.push_back(stops_[k]);
    }
    return nodes;
  }

  /// The n >= 1 for which units / n is nearest to 1 in ratio.
  static std::size_t nearest_count(double units) {
    const double low = std::max(1.0, std::floor(units));
    return static_cast<std::size_t>(units * units > kTie * low * (low + 1) ? low + 1 : low);
  }

  struct Sag {
    double share = 0;          // of the chord
    std::size_t farthest = 0;  // point of the polyline
  };
  [[nodiscard]] Sag sag(double s0, double s1) const {
    const Vec3 a = at(s0), b = at(s1);
    const double chord = distance(a, b);
    Sag result;
    const auto first = std::upper_bound(arc_.begin(), arc_.end(), s0) - arc_.begin();
    for (auto i = static_cast<std::size_t>(first); i < arc_.size() && arc_[i] < s1; ++i) {
      const double away = distance(polyline_[i], closest_on_segment(polyline_[i], a, b).point);
      if (away <= options_.slack) continue;
      const double d = chord > 0 ? away / chord : away > 0 ? std::numeric_limits<double>::infinity() : 0;
      if (d > result.share) result = {d, i};
    }
    return result;
  }

  /// Refines where a chord leaves the polyline. True if none does.
  bool mend(const std::vector<double>& nodes) {
    std::vector<double> factor(sampling_.s.size(), 1.0), stops;
    bool good = true;
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      const Sag whole = sag(nodes[k - 1], nodes[k]);
      if (whole.share <= options_.max_sagitta) continue;
      good = false;
      // Half an arc has half the sagitta; a kink leaves its two sides straight, at any scale.
      const double kink = arc_[whole.farthest];
      const double sides = std::max(sag(nodes[k - 1], kink).share, sag(kink, nodes[k]).share);
      if (sides < 0.25 * whole.share)
        stops.push_back(kink);
      else {
        // A piece much shorter than the size is split only by a size in proportion to itself.
        const double m = std::min(1.0, sampling_.units_at(nodes[k]) - sampling_.units_at(nodes[k - 1]));
        refine(nodes[k - 1], nodes[k], m * std::clamp(options_.max_sagitta / whole.share, 0.5, 0.9), factor);
      }
    }
    if (good) return true;
    for (std::size_t i = 0; i < factor.size(); ++i) sampling_.size[i] *= factor[i];
    grade();
    stops_.insert(stops_.end(), stops.begin(), stops.end());
    std::ranges::sort(stops_);
    return false;
  }

  void refine(double s0, double s1, double by, std::vector<double>& factor) const {
    for (std::size_t i = 0; i < factor.size(); ++i)
      if (sampling_.s[i] >= s0 && sampling_.s[i] <= s1) factor[i] = std::min(factor[i], by);
  }

  void grade() {
    auto& size = sampling_.size;
    const auto& s = sampling_.s;
    for (std::size_t i = 1; i < s.size(); ++i)
      size[i] = std::min(size[i], size[i - 1] + options_.gradation * (s[i] - s[i - 1]));
    for (std::size_t i = s.size() - 1; i-- > 0;)
      size[i] = std::min(size[i], size[i + 1] + options_.gradation * (s[i + 1] - s[i]));
    sampling_.integrate();
  }

  std::span<const Vec3> polyline_;
  std::vector<double> arc_;
  const std::function<double(double, Vec3)>& size_;
  const RulerOptions& options_;
  Sampling sampling_;
  std::vector<double> stops_;  // arc lengths that get a node
};

}  // namespace

std::vector<double> resampled(std::span<const Vec3> polyline, bool closed,
                              const std::function<double(double s, Vec3 p)>& size, const RulerOptions& options) {
  return Ruler(polyline, size, options).place(closed || polyline.front() == polyline.back());
}

std::vector<double> arc_lengths(std::span<const Vec3> polyline) {
  std::vector<double> arc{0};
  arc.reserve(polyline.size());
  for (std::size_t i = 1; i < polyline.size(); ++i) arc.push_back(arc.back() + distance(polyline[i - 1], polyline[i]));
  return arc;
}

Vec3 point_at(std::span<const Vec3> polyline, std::span<const double> arc, double s) {
  if (s <= arc.front()) return polyline.front();
  if (s >= arc.back()) return polyline.back();
  const auto i = static_cast<std::size_t>(std::ranges::upper_bound(arc, s) - arc.begin()) - 1;
  return s == arc[i] ? polyline[i] : lerp(polyline[i], polyline[i + 1], (s - arc[i]) / (arc[i + 1] - arc[i]));
}

}  // namespace meshgraft
