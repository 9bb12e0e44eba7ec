#include "fill/rim_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "geometry/quality.hpp"
#include "zone/edge_table.hpp"

namespace meshgraft {
namespace {

constexpr double kSideMisfit = 1.2;  // of the size at a side to its length: beyond that faces beside it are poor
constexpr double kCoarseFrom = 0.5;  // of a side: where sizes of a first mesh start, so that some rows are fine,
constexpr double kCoarsening = 0.2;  // and what they grow by per unit of distance: n sides, some 6 n nodes in all
constexpr double kNearby = 0.2;      // radius of samples over their distance, up to which they count as one
constexpr std::size_t kLeaf = 8;     // samples that are not parted
constexpr double kAtSample = 1e-6;   // of its length: nearer than this counts as this

/// A length at a place.
struct Sample {
  Vec3 at;
  double length;
};

/// Samples that are asked for what they say together, in a binary tree, split at the median of the widest axis.
class SampleTree {
 public:
  explicit SampleTree(std::vector<Sample> samples) : samples_(std::move(samples)) {
    if (!samples_.empty()) split(0, samples_.size());
  }

  /// The mean of the lengths, with the inverse squares of the distances as weights.
  [[nodiscard]] double mean(Vec3 p) const {
    double sum = 0, weight = 0;
    visit(
        [&](const Branch& b) {
          const double squared = squared_norm(p - b.centre);
          if (b.radius * b.radius > kNearby * kNearby * squared) return true;
          sum += b.sum / squared, weight += static_cast<double>(b.count) / squared;
          return false;
        },
        [&](const Sample& s) {
          const double w = 1 / std::max(squared_norm(p - s.at), kAtSample * kAtSample * s.length * s.length);
          sum += w * s.length, weight += w;
        });
    return sum / weight;
  }

  /// The least of `share` times each length, and `gradation` more by unit of distance from it.
  [[nodiscard]] double at_most(Vec3 p, double share, double gradation) const {
    double most = std::numeric_limits<double>::infinity();
    visit([&](const Branch& b) { return b.least * share + gradation * to_ball(p, b) < most; },
          [&](const Sample& s) { most = std::min(most, s.length * share + gradation * distance(p, s.at)); });
    return most;
  }

  /// The greatest of `share` times each length, and `gradation` less by unit of distance from it; 0 if none is left.
  [[nodiscard]] double at_least(Vec3 p, double share, double gradation) const {
    double least = 0;
    visit([&](const Branch& b) { return b.most * share - gradation * to_ball(p, b) > least; },
          [&](const Sample& s) { least = std::max(least, s.length * share - gradation * distance(p, s.at)); });
    return least;
  }

 private:
  /// Some of the samples, in a ball.
  struct Branch {
    Vec3 centre;
    double radius = 0;
    double sum = 0, least = 0, most = 0;  // of their lengths
    std::size_t first = 0, count = 0;     // in samples_
    std::size_t right = 0;                // the second half in branches_; the first comes next; 0: not parted
  };

  static double to_ball(Vec3 p, const Branch& b) { return std::max(distance(p, b.centre) - b.radius, 0.0); }

  std::size_t split(std::size_t first, std::size_t count) {
    const std::size_t n = branches_.size();
    branches_.push_back(branch(first, count));
    if (count <= kLeaf) return n;
    const auto begin = samples_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = begin + static_cast<std::ptrdiff_t>(count);
    Box box;
    for (auto s = begin; s != end; ++s) box.add(s->at);
    const Vec3 wide = box.high - box.low;
    double Vec3::*const axis = wide.x >= wide.y && wide.x >= wide.z ? &Vec3::x : wide.y >= wide.z ? &Vec3::y : &Vec3::z;
    std::stable_sort(begin, end, [&](const Sample& a, const Sample& b) { return a.at.*axis < b.at.*axis; });
    split(first, count / 2);
    const std::size_t right = split(first + count / 2, count - count / 2);
    branches_[n].right = right;
    return n;
  }

  [[nodiscard]] Branch branch(std::size_t first, std::size_t count) const {
    const auto samples = std::span(samples_).subspan(first, count);
    Branch b{{}, 0, 0, samples.front().length, samples.front().length, first, count, 0};
    for (const Sample& s : samples) {
      b.centre += s.at / static_cast<double>(count), b.sum += s.length;
      b.least = std::min(b.least, s.length), b.most = std::max(b.most, s.length);
    }
    for (const Sample& s : samples) b.radius = std::max(b.radius, distance(s.at, b.centre));
    return b;
  }

  /// Goes into the branches that `enter` wants to see, and to the samples of those that are not parted.
  template <class Enter, class At>
  void visit(Enter&& enter, At&& at, std::size_t n = 0) const {
    if (branches_.empty() || !enter(branches_[n])) return;
    const Branch& b = branches_[n];
    if (b.right == 0) {
      for (const Sample& s : std::span(samples_).subspan(b.first, b.count)) at(s);
      return;
    }
    visit(enter, at, n + 1);
    visit(enter, at, b.right);
  }

  std::vector<Sample> samples_;
  std::vector<Branch> branches_;
};

}  // namespace

RimSizing rim_sizing(const Complex& around, std::span<const Hole> holes, const std::set<NodePair>& beams,
                     std::optional<double> size) {
  std::vector<Sample> behind, sides;  // faces behind the rims; sides of rims and beams, which stay as they are
  const VertexFaces faces_at(around);
  for (const Hole& hole : holes)
    for (const Rim& rim : hole)
      for (std::size_t k = 0, n = rim.vertices.size(); k < n; ++k) {
        const VertexId v = rim.vertices[k];
        double sum = 0;
        for (const FaceId f : faces_at[v]) sum += mean_edge_length(around.corners(f));
        const Vec3 at = around.position[v.value];
        behind.push_back({at, sum / static_cast<double>(faces_at[v].size())});
        sides.push_back({at, 0.5 * (side_length(around, rim, k) + side_length(around, rim, (k + n - 1) % n))});
      }
  for (const Complex::Line& line : around.lines) {
    if (!beams.contains(nodes_of(around, line.ends[0], line.ends[1]))) continue;
    const Vec3 a = around.position[line.ends[0].value], b = around.position[line.ends[1].value];
    for (const Vec3 at : {a, b}) sides.push_back({at, distance(a, b)});
  }
  struct Trees {
    SampleTree behind, sides;
  };
  const auto trees = std::make_shared<const Trees>(Trees{SampleTree(std::move(behind)), SampleTree(std::move(sides))});
  const auto fine = [trees, size](Vec3 p) {
    const double gradation = SizeOptions{}.gradation;
    const double wanted = size ? *size : trees->behind.mean(p);
    return std::min(trees->sides.at_most(p, kSideMisfit, gradation),
                    std::max(trees->sides.at_least(p, 1 / kSideMisfit, gradation), wanted));
  };
  const auto coarse = [trees, fine](Vec3 p) {
    return std::max(fine(p), trees->sides.at_most(p, kCoarseFrom, kCoarsening));
  };
  const auto everywhere = [](const auto& at) {
    return Sizing{[at](SheetId, Vec3 p) { return at(p); }, [at](CurveId, Vec3 p) { return at(p); }};
  };
  return {everywhere(fine), everywhere(coarse)};
}

}  // namespace meshgraft
