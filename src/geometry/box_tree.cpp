#include "geometry/box_tree.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

namespace meshgraft {
namespace {

constexpr std::uint32_t kLeafSize = 4;  // boxes tested one by one; 2 to 8 measure alike
constexpr std::size_t kAtOnce = 32768;  // boxes below which a branch is not worth a task

constexpr int kAxisBits = 21;                        // of a place on the curve: three times 21 are 63
constexpr double kLastCell = (1u << kAxisBits) - 1;  // along each axis
constexpr int kDigitBits = 11;                       // of a place, sorted by in one pass
constexpr std::size_t kDigits = 6;                   // 66 bits
constexpr std::size_t kWorthCounting = 1024;         // items below which comparing them is faster

/// The bits of a cell number with two zeros after each.
std::uint64_t spread(double cell) {
  // What is no number, or beyond all, is somewhere; boxes tell where it is not.
  auto bits = static_cast<std::uint64_t>(cell > 0 ? std::min(cell, kLastCell) : 0.0);
  bits = (bits | bits << 32) & 0x001f00000000ffff;
  bits = (bits | bits << 16) & 0x001f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  bits = (bits | bits << 2) & 0x1249249249249249;
  return bits;
}

/// The place of a cell on the Morton curve.
std::uint64_t code_of(Vec3 cell) { return spread(cell.x) << 2 | spread(cell.y) << 1 | spread(cell.z); }

/// Digit by digit from the lowest one; items of one code stay in order.
template <class Item>
void sort_by_code(std::vector<Item>& items) {
  constexpr std::uint64_t kMask = (1u << kDigitBits) - 1;
  const auto digit = [](std::uint64_t code, std::size_t d) { return code >> (d * kDigitBits) & kMask; };
  std::vector<std::array<std::uint32_t, kMask + 1>> starts(kDigits);
  for (const Item& item : items)
    for (std::size_t d = 0; d < kDigits; ++d) ++starts[d][digit(item.code, d)];
  std::vector<Item> sorted(items.size());
  for (std::size_t d = 0; d < kDigits; ++d) {
    if (starts[d][digit(items.front().code, d)] == items.size()) continue;  // all alike
    std::exclusive_scan(starts[d].begin(), starts[d].end(), starts[d].begin(), 0u);
    for (const Item& item : items) sorted[starts[d][digit(item.code, d)]++] = item;
    items.swap(sorted);
  }
}

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

std::vector<BoxTree::Item> BoxTree::along_curve(std::span<const Box> boxes) {
  Box centres;
  for (const Box& box : boxes) centres.add(box.low + box.high);
  const Vec3 extent = centres.high - centres.low;
  // The same scale along all axes, so that cells are cubes however long and thin a set of boxes is.
  const double scale = kLastCell / std::max({extent.x, extent.y, extent.z});
  std::vector<Item> items(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    items[i] = {code_of(scale * (boxes[i].low + boxes[i].high - centres.low)), static_cast<std::uint32_t>(i)};
  if (items.size() < kWorthCounting)
    std::ranges::stable_sort(items, {}, &Item::code);
  else
    sort_by_code(items);
  return items;
}

BoxTree::BoxTree(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  const std::vector<Item> items = along_curve(boxes);
  nodes_.reserve(boxes.size());
  nodes_.emplace_back();
  split(nodes_, 0, 0, items, boxes);
  order_.reserve(boxes.size()), boxes_.reserve(boxes.size());
  for (const Item& item : items) order_.push_back(item.index), boxes_.push_back(boxes[item.index]);
}

/// `items` become those of the node, of which `first` is the position in order_.
void BoxTree::split(std::vector<TreeNode>& nodes, std::uint32_t node, std::uint32_t first, std::span<const Item> items,
                    std::span<const Box> boxes) {
  if (items.size() <= kLeafSize) {
    nodes[node].first = first, nodes[node].count = static_cast<std::uint32_t>(items.size());
    for (const Item& item : items) nodes[node].box.add(boxes[item.index]);
    return;
  }
  // Halves of the smallest cell that holds all of them; of boxes with one centre, halves of their number.
  std::size_t half = items.size() / 2;
  if (const std::uint64_t differ = items.front().code ^ items.back().code; differ != 0) {
    const std::uint64_t bit = std::bit_floor(differ);
    const auto is_lower = [bit](const Item& item) { return (item.code & bit) == 0; };
    half = static_cast<std::size_t>(std::ranges::partition_point(items, is_lower) - items.begin());
  }
  const auto child = static_cast<std::uint32_t>(nodes.size());
  const std::array<std::span<const Item>, 2> part{items.first(half), items.subspan(half)};
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
