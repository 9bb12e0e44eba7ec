#include "geometry/box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace meshgraft {
namespace {

constexpr std::uint32_t kLeafSize = 4;  // boxes tested one by one; 2 to 8 measure alike

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(boxes.size());
  nodes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(boxes.size()), boxes);
  boxes_.reserve(boxes.size());
  for (const std::uint32_t i : order_) boxes_.push_back(boxes[i]);
}

void BoxTree::build(std::uint32_t node, std::uint32_t first, std::uint32_t last, std::span<const Box> boxes) {
  Box box, centres;
  for (std::uint32_t k = first; k < last; ++k) {
    box.add(boxes[order_[k]]);
    centres.add(midpoint(boxes[order_[k]].low, boxes[order_[k]].high));
  }
  nodes_[node].box = box;
  if (last - first <= kLeafSize) {
    nodes_[node].first = first, nodes_[node].count = last - first;
    return;
  }
  const Vec3 extent = centres.high - centres.low;
  const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double ca = boxes[a].low[axis] + boxes[a].high[axis];
                     const double cb = boxes[b].low[axis] + boxes[b].high[axis];
                     return ca < cb || (ca == cb && a < b);
                   });
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = child;
  nodes_.emplace_back();
  nodes_.emplace_back();
  build(child, first, middle, boxes);
  build(child + 1, middle, last, boxes);
}

}  // namespace meshgraft
