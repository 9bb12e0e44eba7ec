#include "geometry/box_tree.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace meshgraft {
namespace {

constexpr std::uint32_t kLeafSize = 4;  // boxes tested one by one; 2 to 8 measure alike
constexpr std::size_t kAtOnce = 4096;   // boxes below which a branch is not worth a task

/// Adds a tree by itself; its root takes the place of `root`.
template <class Node>
void add_branch(std::vector<Node>& nodes, std::uint32_t root, std::span<const Node> branch) {
  const auto ahead = static_cast<std::uint32_t>(nodes.size() - 1);
  for (std::size_t i = 0; i < branch.size(); ++i) {
    Node& added = i == 0 ? nodes[root] : nodes.emplace_back();
    added = branch[i];
    if (added.count == 0) added.first += ahead;
  }
}

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  std::vector<Item> items(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    items[i] = {boxes[i].low + boxes[i].high, static_cast<std::uint32_t>(i)};
  nodes_.reserve(boxes.size());
  nodes_.emplace_back();
  split(nodes_, 0, 0, items, boxes);
  order_.reserve(boxes.size()), boxes_.reserve(boxes.size());
  for (const Item& item : items) order_.push_back(item.index), boxes_.push_back(boxes[item.index]);
}

/// `items` become those of the node, of which `first` is the position in order_.
void BoxTree::split(std::vector<TreeNode>& nodes, std::uint32_t node, std::uint32_t first, std::span<Item> items,
                    std::span<const Box> boxes) {
  if (items.size() <= kLeafSize) {
    nodes[node].first = first, nodes[node].count = static_cast<std::uint32_t>(items.size());
    for (const Item& item : items) nodes[node].box.add(boxes[item.index]);
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
  const auto child = static_cast<std::uint32_t>(nodes.size());
  const std::array<std::span<Item>, 2> part{items.first(half), items.subspan(half)};
  const std::array<std::uint32_t, 2> first_of{first, first + static_cast<std::uint32_t>(half)};
  nodes[node].first = child;
  nodes.resize(nodes.size() + 2);
  if (items.size() < kAtOnce) {
    for (const std::uint32_t k : {0u, 1u}) split(nodes, child + k, first_of[k], part[k], boxes);
  } else {
    std::array<std::vector<TreeNode>, 2> branch;
    tbb::parallel_for(0u, 2u, [&](std::uint32_t k) {
      branch[k].reserve(part[k].size()), branch[k].emplace_back();
      split(branch[k], 0, first_of[k], part[k], boxes);
    });
    for (const std::uint32_t k : {0u, 1u}) add_branch<TreeNode>(nodes, child + k, branch[k]);
  }
  for (const std::uint32_t k : {0u, 1u}) nodes[node].box.add(nodes[child + k].box);
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
