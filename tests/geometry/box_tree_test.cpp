#include "geometry/box_tree.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "geometry/generators.hpp"

namespace meshgraft {
namespace {

using test::any_number;
using test::grid_point;

std::vector<Box> any_boxes() {
  std::vector<Box> boxes(*rc::gen::element<std::size_t>(0, 1, 4, 5, 40, 150));
  for (Box& box : boxes) {
    box.add(grid_point());
    if (*rc::gen::arbitrary<bool>()) box.add(grid_point());  // else a point
  }
  return boxes;
}

TEST(BoxTree, EmptyTreeFindsNothing) {
  const BoxTree tree;
  EXPECT_TRUE(tree.empty());
  Box all;
  all.add(Vec3{-1e9, -1e9, -1e9}), all.add(Vec3{1e9, 1e9, 1e9});
  tree.overlapping(all, [](std::uint32_t) { FAIL(); });
  EXPECT_FALSE(tree.nearest({0, 0, 0}, [](std::uint32_t) { return 0.0; }).found());
  EXPECT_TRUE(BoxTree(std::span<const Box>()).empty());
}

RC_GTEST_PROP(BoxTree, OverlapsAreThoseOfBruteForce, ()) {
  const std::vector<Box> boxes = any_boxes();
  Box query;
  query.add(grid_point()), query.add(grid_point());
  std::vector<std::uint32_t> found, expected;
  BoxTree(boxes).overlapping(query, [&](std::uint32_t i) { found.push_back(i); });
  std::ranges::sort(found);
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (boxes[i].overlaps(query)) expected.push_back(i);
  RC_ASSERT(found == expected);
}

RC_GTEST_PROP(BoxTree, NearestIsThatOfBruteForceAndTheSmallestOfEquals, ()) {
  const std::vector<Box> boxes = any_boxes();
  const Vec3 p = *rc::gen::arbitrary<bool>() ? grid_point() : test::any_point();
  const auto to_centre = [&](std::uint32_t i) { return squared_norm(p - midpoint(boxes[i].low, boxes[i].high)); };
  const double limit = *rc::gen::element(0.0, 0.5, 1.0, 9.0, 1e30);
  BoxTree::Nearest expected;
  expected.squared_distance = limit;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (to_centre(i) < expected.squared_distance) expected = {i, to_centre(i)};
  const BoxTree::Nearest found = BoxTree(boxes).nearest(p, to_centre, limit);
  RC_ASSERT(found.squared_distance == expected.squared_distance);
  // At the limit itself the tree may or may not find one.
  if (expected.found()) RC_ASSERT(found.item == expected.item);
}

}  // namespace
}  // namespace meshgraft
