// Line segments that others are looked for on.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"

namespace meshgraft {

using Segment = std::array<Vec3, 2>;

class Segments {
 public:
  explicit Segments(std::vector<Segment> segments) : segments_(std::move(segments)) {
    std::vector<Box> boxes(segments_.size());
    for (std::size_t k = 0; k < boxes.size(); ++k)
      for (const Vec3& p : segments_[k]) boxes[k].add(p);
    tree_ = BoxTree(boxes);
  }

  /// Whether ends and middle of `s` are within `distance` of the segments.
  [[nodiscard]] bool cover(const Segment& s, double distance) const {
    const std::array<Vec3, 3> points{s[0], midpoint(s[0], s[1]), s[1]};
    return std::ranges::all_of(points, [&](Vec3 p) {
      const auto squared_distance = [&](std::uint32_t k) {
        return squared_norm(p - closest_on_segment(p, segments_[k][0], segments_[k][1]).point);
      };
      const auto nearest = tree_.nearest(p, squared_distance);
      return nearest.found() && nearest.squared_distance <= distance * distance;
    });
  }

 private:
  std::vector<Segment> segments_;
  BoxTree tree_;
};

}  // namespace meshgraft
