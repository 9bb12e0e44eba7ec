#include "geometry/box_tree.hpp"

#include <algorithm>

namespace meshgraft {
namespace {

constexpr std::uint32_t kLeafSize = 4;  // boxes tested one by one; 2 to 8 measure alike

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  std::vector<Item> items(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    items[i] = {boxes[i].low + boxes[i].high, static_cast<std::uint32_t>(i)};
  nodes_.reserve(boxes.size());
  nodes_.emplace_back();
  split(0, 0, items);
  order_.reserve(boxes.size()), boxes_.reserve(boxes.size());
  for (const Item& item : items) order_.push_back(item.index), boxes_.push_back(boxes[item.index]);
  for (std::size_t n = nodes_.size(); n-- > 0;) {  // children come after their parents
    TreeNode& node = nodes_[n];
    for (std::uint32_t k = 0; k < node.count; ++k) node.box.add(boxes_[node.first + k]);
    if (node.count == 0) node.box.add(nodes_[node.first].box), node.box.add(nodes_[node.first + 1].box);
  }
}

/// `items` become those of the node, of which `first` is the position in order_.
void BoxTree::split(std::uint32_t node, std::uint32_t first, std::span<Item> items) {
  if (items.size() <= kLeafSize) {
    nodes_[node].first = first, nodes_[node].count = static_cast<std::uint32_t>(items.size());
    return;
  }
  Box centres;
  for (const Item& item : items) centres.add(item.twice_centre);
  const Vec3 extent = centres.high - centres.low;
  const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::size_t half = items.size() / 2;
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                   [axis](const Item& a, const Item& b) {
                     const double ca = a.twice_centre[axis], cb = b.twice_centre[axis];
                     return ca < cb || (ca == cb && a.index < b.index);
                   });
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = child;
  nodes_.emplace_back();
  nodes_.emplace_back();
  split(child, first, items.first(half));
  split(child + 1, first + static_cast<std::uint32_t>(half), items.subspan(half));
}

bool BoxTree::meets(std::uint32_t n, const Box& box) const {
  const TreeNode& node = nodes_[n];
  if (!node.box.overlaps(box)) return false;
  if (node.count == 0) return meets(node.first, box) || meets(node.first + 1, box);
  for (std::uint32_t k = 0; k < node.count; ++k)
    if (boxes_[node.first + k].overlaps(box)) return true;
  return false;
}

}  // namespace meshgraft
