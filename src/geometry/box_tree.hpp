// A hierarchy of boxes for overlap and nearest queries.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "meshgraft/vec3.hpp"

namespace meshgraft {

/// Binary tree over n boxes, ordered along a Morton curve through their centres (Lauterbach et al., "Fast BVH
/// construction on GPUs", 2009). Building costs O(n), a query O(log n) plus what it finds where the boxes are of
/// one size. Immutable; queries may run concurrently.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::span<const Box> boxes);

  [[nodiscard]] bool empty() const { return order_.empty(); }

  /// Calls f(i) for each box i that overlaps `box`; order fixed by the input.
  template <class F>
  void overlapping(const Box& box, F&& f) const {
    if (!empty()) visit(0, box, f);
  }

  /// Whether any box overlaps `box`; ends at the first.
  [[nodiscard]] bool meets(const Box& box) const { return !empty() && meets(0, box); }

  struct Nearest {
    std::uint32_t item = std::numeric_limits<std::uint32_t>::max();
    double squared_distance = std::numeric_limits<double>::infinity();
    [[nodiscard]] bool found() const { return item != std::numeric_limits<std::uint32_t>::max(); }
  };
  /// The item nearest to p by squared_distance(i), which must not be less than that to its box;
  /// only items nearer than sqrt(limit) are found. Equal distances: the smallest item.
  template <class F>
  [[nodiscard]] Nearest nearest(Vec3 p, F&& squared_distance,
                                double limit = std::numeric_limits<double>::infinity()) const {
    Nearest best;
    best.squared_distance = limit;
    if (!empty()) descend(0, p, squared_distance, best);
    return best;
  }

 private:
  struct TreeNode {
    Box box;
    std::uint32_t first = 0;  // leaf: position in order_; inner: left child (right is first + 1)
    std::uint32_t count = 0;  // 0 = inner
  };

  /// A box while the tree is built: its place on the curve.
  struct Item {
    std::uint64_t code = 0;
    std::uint32_t index = 0;
  };
  static std::vector<Item> along_curve(std::span<const Box> boxes);
  /// Branches are built at the same time where they are large.
  static void split(std::vector<TreeNode>& nodes, std::uint32_t node, std::uint32_t first, std::span<const Item> items,
                    std::span<const Box> boxes);

  template <class F>
  void visit(std::uint32_t n, const Box& box, F& f) const {
    const TreeNode& node = nodes_[n];
    if (!node.box.overlaps(box)) return;
    if (node.count == 0) {
      visit(node.first, box, f);
      visit(node.first + 1, box, f);
      return;
    }
    for (std::uint32_t k = 0; k < node.count; ++k)
      if (boxes_[node.first + k].overlaps(box)) f(order_[node.first + k]);
  }

  [[nodiscard]] bool meets(std::uint32_t n, const Box& box) const;

  template <class F>
  void descend(std::uint32_t n, Vec3 p, F& squared_distance, Nearest& best) const {
    const TreeNode& node = nodes_[n];
    if (node.count == 0) {
      const double left = squared_distance_to(nodes_[node.first].box, p);
      const double right = squared_distance_to(nodes_[node.first + 1].box, p);
      const bool left_first = left <= right;
      const std::uint32_t near = left_first ? node.first : node.first + 1;
      const std::uint32_t far = left_first ? node.first + 1 : node.first;
      if (std::min(left, right) <= best.squared_distance) descend(near, p, squared_distance, best);
      if (std::max(left, right) <= best.squared_distance) descend(far, p, squared_distance, best);
      return;
    }
    for (std::uint32_t k = 0; k < node.count; ++k) {
      const std::uint32_t i = order_[node.first + k];
      if (squared_distance_to(boxes_[node.first + k], p) > best.squared_distance) continue;
      const double d = squared_distance(i);
      if (d < best.squared_distance || (d == best.squared_distance && i < best.item)) best = {i, d};
    }
  }

  static double squared_distance_to(const Box& box, Vec3 p) {
    const Vec3 d{std::max({box.low.x - p.x, 0.0, p.x - box.high.x}), std::max({box.low.y - p.y, 0.0, p.y - box.high.y}),
                 std::max({box.low.z - p.z, 0.0, p.z - box.high.z})};
    return squared_norm(d);
  }

  std::vector<TreeNode> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<Box> boxes_;  // in the order of order_
};

}  // namespace meshgraft
