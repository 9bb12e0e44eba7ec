// Line segments that others are looked for on.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"

namespace meshgraft {

using Segment = std::array<Vec3, 2>;

/// Ends and middle.
inline std::array<Vec3, 3> places_on(const Segment& s) { return {s[0], midpoint(s[0], s[1]), s[1]}; }

class Segments {
 public:
  explicit Segments(std::vector<Segment> segments) : segments_(std::move(segments)) {
    std::vector<Box> boxes(segments_.size());
    for (std::size_t k = 0; k < boxes.size(); ++k)
      for (const Vec3& p : segments_[k]) boxes[k].add(p);
    tree_ = BoxTree(boxes);
  }

  /// Whether the nearest segment is within `distance`, or within `share` of its own length.
  [[nodiscard]] bool are_near(Vec3 p, double distance, double share = 0) const {
    const auto squared_distance = [&](std::uint32_t k) {
      return squared_norm(p - closest_on_segment(p, segments_[k][0], segments_[k][1]).point);
    };
    const auto nearest = tree_.nearest(p, squared_distance);
    if (!nearest.found()) return false;
    const Segment& s = segments_[nearest.item];
    return nearest.squared_distance <= std::max(distance * distance, share * share * squared_norm(s[1] - s[0]));
  }

  /// Whether ends and middle of `s` are within `distance` of the segments.
  [[nodiscard]] bool cover(const Segment& s, double distance) const {
    return std::ranges::all_of(places_on(s), [&](Vec3 p) { return are_near(p, distance); });
  }

 private:
  std::vector<Segment> segments_;
  BoxTree tree_;
};

}  // namespace meshgraft
