#include "zone/size_limits.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/closest.hpp"

namespace meshgraft {
namespace {

double size_at(const SizeLimit& limit, double t) { return limit.at_a + t * (limit.at_b - limit.at_a); }

}  // namespace

SizeLimits::SizeLimits(std::vector<SizeLimit> limits, double gradation)
    : limits_(std::move(limits)), gradation_(gradation) {
  std::vector<Box> boxes;
  boxes.reserve(limits_.size());
  for (const SizeLimit& limit : limits_) {
    Box& box = boxes.emplace_back();
    box.add(limit.a), box.add(limit.b);
    largest_ = std::max({largest_, limit.at_a, limit.at_b});
    smallest_ = std::min({smallest_, limit.at_a, limit.at_b});
  }
  tree_ = BoxTree(boxes);
}

double SizeLimits::least(Vec3 p, double below) const {
  // (distance + size / gradation)^2 is never less than the squared distance, as the tree asks. Counting sizes
  // from the smallest one keeps the search short where they are alike.
  const double reach = (below - smallest_) / gradation_;
  if (!(reach > 0)) return below;
  const auto found = tree_.nearest(
      p,
      [&](std::uint32_t i) {
        const SegmentPoint q = closest_on_segment(p, limits_[i].a, limits_[i].b);
        const double d = distance(p, q.point) + (size_at(limits_[i], q.t) - smallest_) / gradation_;
        return d * d;
      },
      reach * reach);
  return found.found() ? std::min(below, smallest_ + gradation_ * std::sqrt(found.squared_distance)) : below;
}

SizeLimits::Nearest SizeLimits::nearest(Vec3 p, double within) const {
  const auto found = tree_.nearest(
      p, [&](std::uint32_t i) { return squared_norm(p - closest_on_segment(p, limits_[i].a, limits_[i].b).point); },
      within * within);
  if (!found.found()) return {};
  const SizeLimit& limit = limits_[found.item];
  return {true, std::sqrt(found.squared_distance), size_at(limit, closest_on_segment(p, limit.a, limit.b).t)};
}

}  // namespace meshgraft
