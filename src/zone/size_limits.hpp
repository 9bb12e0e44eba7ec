// Places that need small faces, and the size they leave elsewhere.
#pragma once

#include <limits>
#include <vector>

#include "geometry/box_tree.hpp"
#include "meshgraft/vec3.hpp"

namespace meshgraft {

/// A segment (or a point, a == b) with a size at each end, linear between.
struct SizeLimit {
  Vec3 a, b;
  double at_a = 0, at_b = 0;
};

/// Nearest segment of a set, and the size on it there.
class SizeLimits {
 public:
  SizeLimits() = default;
  SizeLimits(std::vector<SizeLimit> limits, double gradation);

  /// The least of size + gradation x distance over all of them, if less than `below`; else `below`.
  [[nodiscard]] double least(Vec3 p, double below) const;

  struct Nearest {
    bool found = false;
    double distance = 0, size = 0;
  };
  /// The nearest one not farther than `within`.
  [[nodiscard]] Nearest nearest(Vec3 p, double within) const;

  [[nodiscard]] double largest() const { return largest_; }
  [[nodiscard]] const std::vector<SizeLimit>& all() const { return limits_; }

 private:
  std::vector<SizeLimit> limits_;
  BoxTree tree_;
  double gradation_ = 1, largest_ = 0, smallest_ = std::numeric_limits<double>::infinity();
};

}  // namespace meshgraft
