#include "meshgraft/check.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "support/scenes.hpp"

namespace meshgraft {
namespace {

ElementId face(std::size_t i) { return ElementId(i); }

TEST(Check, PlateIsSound) {
  const CheckResult r = check(scenes::plate({0, 0, 0}, {3, 0, 0}, {0, 2, 0}, 1));
  EXPECT_TRUE(r.sound());
  EXPECT_EQ(r.faces, 12u);
  EXPECT_EQ(r.free_edges, 10u);
  EXPECT_EQ(r.non_manifold_edges + r.sharp_edges + r.flipped_edges, 0u);
  EXPECT_NEAR(r.area, 6, 1e-12);
  EXPECT_EQ(r.n_orphan_nodes + r.n_coincident_nodes, 0u);
  EXPECT_EQ(r.box.high, (Vec3{3, 2, 0}));
}

TEST(Check, ClosedSphereHasNoFreeEdge) {
  const CheckResult r = check(scenes::sphere({1, 2, 3}, 5, 6));
  EXPECT_TRUE(r.sound());
  EXPECT_EQ(r.free_edges + r.non_manifold_edges + r.flipped_edges, 0u);
  EXPECT_GT(r.min_q, 0.5);
}

TEST(Check, EmptyModelIsSound) {
  const CheckResult r = check(ModelBuilder().build());
  EXPECT_TRUE(r.sound());
  EXPECT_EQ(r.faces, 0u);
  EXPECT_EQ(r.min_q, 1);
}

TEST(Check, CountsEdgesByTheirFaces) {
  ModelBuilder b;
  const NodeId o = b.add_node({0, 0, 0}), z = b.add_node({0, 0, 1});
  for (int i = 0; i < 3; ++i) {
    const double a = 2 * std::numbers::pi * i / 3;
    b.add_face(o, z, b.add_node({std::cos(a), std::sin(a), 0.5}));
  }
  const CheckResult r = check(b.build());
  EXPECT_EQ(r.non_manifold_edges, 1u);
  EXPECT_EQ(r.free_edges, 6u);
  EXPECT_TRUE(r.sound());
}

TEST(Check, CountsLinesOfOneTypeOnTheSameNodesAndStaysSound) {
  ModelBuilder b;
  const NodeId x = b.add_node({0, 0, 0}), y = b.add_node({1, 0, 0}), z = b.add_node({0, 1, 0});
  b.add_face(x, y, z);
  const ElementId first = b.add_line(x, y, 1), second = b.add_line(y, x, 2);
  b.add_line(y, z);
  ElementAttributes other;
  other.shape = Shape::kLine, other.type = 11;
  b.add_element(other, std::array{y, z});
  const CheckResult r = check(b.build());
  EXPECT_EQ(r.n_doubled_lines, 1u);
  EXPECT_EQ(r.doubled_lines, (std::vector{std::pair{first, second}}));
  EXPECT_TRUE(r.sound());
}

TEST(Check, FoldIsSharpAndFlipIsNot) {
  const auto folded = [](double degrees, bool flip) {
    ModelBuilder b;
    const double a = degrees / 180 * std::numbers::pi;
    const NodeId o = b.add_node({0, 0, 0}), y = b.add_node({0, 1, 0}), l = b.add_node({-1, 0.5, 0});
    const NodeId r = b.add_node({std::cos(a), 0.5, std::sin(a)});
    b.add_face(o, y, l);
    flip ? b.add_face(o, y, r) : b.add_face(y, o, r);
    return check(b.build());
  };
  EXPECT_EQ(folded(29, false).sharp_edges, 0u);
  EXPECT_EQ(folded(31, false).sharp_edges, 1u);
  EXPECT_EQ(folded(29, true).sharp_edges, 0u);
  EXPECT_EQ(folded(29, true).flipped_edges, 1u);
  EXPECT_EQ(folded(31, true).sharp_edges, 1u);
  EXPECT_TRUE(folded(179, false).sound());
  EXPECT_EQ(folded(0, false).flipped_edges, 0u);
}

TEST(Check, NamesDegenerateAndDuplicateFaces) {
  ModelBuilder b;
  const NodeId a = b.add_node({0, 0, 0}), c = b.add_node({1, 0, 0}), d = b.add_node({0, 1, 0});
  const NodeId on = b.add_node({0.5, 0, 0});
  b.add_face(a, c, d);
  b.add_face(a, a, d);
  b.add_face(a, on, c);
  b.add_face(d, c, a);
  const CheckResult r = check(b.build());
  EXPECT_EQ(r.degenerate_faces, (std::vector{face(1), face(2)}));
  EXPECT_EQ(r.duplicate_faces, (std::vector{std::pair(face(0), face(3))}));
  EXPECT_EQ(r.intersections, 0u) << "a pair on the same nodes is counted once";
  EXPECT_FALSE(r.sound());
  EXPECT_EQ(r.min_q, 0);
}

TEST(Check, CountsAllOfWhatItListsInPart) {
  ModelBuilder b;
  const NodeId x = b.add_node({0, 0, 0}), y = b.add_node({1, 0, 0}), z = b.add_node({0, 1, 0});
  for (int k = 0; k < 4; ++k) b.add_face(x, y, z), b.add_face(x, x, b.add_node({2, 1.0 * k, 0}));
  CheckOptions options;
  options.max_places = 2;
  const CheckResult r = check(b.build(), options);
  EXPECT_EQ(r.n_duplicate_faces, 3u);
  EXPECT_EQ(r.n_degenerate_faces, 4u);
  EXPECT_EQ(r.duplicate_faces.size() + r.degenerate_faces.size(), 4u);
  EXPECT_FALSE(r.sound());
}

TEST(Check, CountsIntersectionsBeyondThoseListed) {
  const Model m = scenes::together(std::array{scenes::plate({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, 1),
                                              scenes::plate({0.3, 2.1, -1}, {3, 0.2, 0}, {0, 0, 2}, 0.5)});
  CheckOptions options;
  options.max_places = 3;
  const CheckResult r = check(m, options);
  EXPECT_EQ(r.intersecting_faces.size(), 3u);
  EXPECT_GT(r.intersections, 8u);
  EXPECT_FALSE(r.sound());
}

TEST(Check, DoubledNodesAreCoincidentNotIntersections) {
  const Model m = scenes::together(
      std::array{scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 1), scenes::plate({2, 0, 0}, {2, 0, 0}, {0, 2, 0}, 1)});
  const CheckResult r = check(m);
  EXPECT_EQ(r.n_coincident_nodes, 3u);
  EXPECT_EQ(r.coincident_nodes.size(), 3u);
  EXPECT_EQ(r.intersections, 0u);
}

TEST(Check, ManyNodesAtOnePlaceAreOneLessPairs) {
  ModelBuilder b;
  for (int i = 0; i < 50; ++i) b.add_node({1.0 / 3, 0, 0}), b.add_node({static_cast<double>(i), 1, 0});
  const CheckResult r = check(b.build());
  EXPECT_EQ(r.n_coincident_nodes, 49u);
  EXPECT_EQ(r.n_orphan_nodes, 100u);
  EXPECT_EQ(r.orphan_nodes.size(), CheckOptions().max_places);
}

TEST(Check, CoincidenceDoesNotDependOnWhereNodesLieInTheBox) {
  for (int k = 0; k < 400; ++k) {
    ModelBuilder b;
    const double x = k / 400.0 + 1.0 / 3000;
    b.add_node({0, 0, 0}), b.add_node({1, 1, 1});
    b.add_node({x, x, x}), b.add_node({x + 4e-10, x - 4e-10, x});
    EXPECT_EQ(check(b.build()).n_coincident_nodes, 1u) << x;
  }
}

TEST(Check, NodesOfBeamsAreNoOrphans) {
  ModelBuilder b;
  const NodeId a = b.add_node({0, 0, 0}), c = b.add_node({1, 0, 0});
  b.add_node({2, 0, 0});
  b.add_line(a, c);
  const CheckResult r = check(b.build());
  EXPECT_EQ(r.orphan_nodes, (std::vector{NodeId(std::size_t{2})}));
  EXPECT_EQ(r.faces, 0u);
}

TEST(Check, WorstFacesComeFirst) {
  ModelBuilder b;
  for (int i = 0; i < 5; ++i) {
    const double x = 10.0 * i, h = i == 3 ? 0.1 : i == 1 ? 0.2 : 1;
    b.add_face(b.add_node({x, 0, 0}), b.add_node({x + 1, 0, 0}), b.add_node({x + 0.5, h, 0}));
  }
  const CheckResult r = check(b.build());
  ASSERT_EQ(r.worst_faces.size(), 2u);
  EXPECT_EQ(r.worst_faces[0].first, face(3));
  EXPECT_EQ(r.worst_faces[1].first, face(1));
  EXPECT_EQ(r.worst_faces[0].second, r.min_q);
  EXPECT_EQ(r.below_min_quality, 2u);
}

}  // namespace
}  // namespace meshgraft
