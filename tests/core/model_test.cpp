#include "meshgraft/model.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace meshgraft {
namespace {

TEST(ModelBuilder, EmptyModelIsWellFormed) {
  const Model m = ModelBuilder().build();
  EXPECT_EQ(m.n_nodes(), 0u);
  EXPECT_EQ(m.n_elements(), 0u);
  EXPECT_EQ(m.first_node, std::vector<std::uint32_t>{0});
}

TEST(ModelBuilder, LabelsCountFromOneUnlessGiven) {
  ModelBuilder b;
  b.add_node({0, 0, 0}), b.add_node({1, 0, 0}, 904), b.add_node({2, 0, 0});
  EXPECT_EQ(b.build().node_label, (std::vector<std::int64_t>{1, 904, 3}));
}

TEST(ModelBuilder, ElementsKeepKindNodesAndAttributes) {
  ModelBuilder b;
  const NodeId i = b.add_node({0, 0, 0}), j = b.add_node({1, 0, 0}), k = b.add_node({0, 1, 0});
  const ElementId face = b.add_face(i, j, k, 3, 4), line = b.add_line(k, i, 5, 6);
  ElementAttributes mass;
  mass.shape = Shape::kPoint, mass.type = 161;
  const ElementId point = b.add_element(mass, std::array{j}, 77);
  const ElementId other = b.add_face(j, i, k, 3, 4);
  const Model m = b.build("mine.unv");
  EXPECT_EQ(m.path, "mine.unv");
  EXPECT_TRUE(m.is_face(face));
  EXPECT_EQ(m.shape(line), Shape::kLine);
  EXPECT_EQ(m.shape(point), Shape::kPoint);
  EXPECT_EQ(m.nodes_of(line)[0], k);
  EXPECT_EQ(m.nodes_of(line)[1], i);
  EXPECT_EQ(m.nodes_of(point).size(), 1u);
  EXPECT_EQ(m.attributes_of(face).physical, 3);
  EXPECT_EQ(m.attributes_of(line).material, 6);
  EXPECT_EQ(m.element_label[point.value], 77);
  EXPECT_EQ(m.element_attributes[face.value], m.element_attributes[other.value]);
  EXPECT_EQ(m.corners(face)[1], (Vec3{1, 0, 0}));
}

TEST(ModelBuilder, GroupsCountEachMemberOnce) {
  ModelBuilder b;
  const NodeId i = b.add_node({0, 0, 0}), j = b.add_node({1, 0, 0}), k = b.add_node({0, 1, 0});
  const ElementId f = b.add_face(i, j, k);
  b.add_to_group("A", f), b.add_to_group("A", f), b.add_to_group("B", f), b.add_to_group("A", i);
  const Model m = b.build();
  ASSERT_EQ(m.groups.size(), 2u);
  EXPECT_EQ(m.groups[0].name, "A");
  EXPECT_EQ(m.groups[0].n_elements, 1u);
  EXPECT_EQ(m.groups[0].n_nodes, 1u);
  EXPECT_EQ(m.group_sets.members(m.element_groups[f.value]).size(), 2u);
  EXPECT_EQ(m.node_groups[j.value], GroupSets::kEmpty);
}

TEST(ModelBuilder, IsEmptyAfterBuild) {
  ModelBuilder b;
  b.add_node({0, 0, 0});
  EXPECT_EQ(b.build().n_nodes(), 1u);
  EXPECT_EQ(b.build().n_nodes(), 0u);
}

TEST(Model, WithoutASourcePlacesNameTheFileOnly) {
  ModelBuilder b;
  b.add_node({0, 0, 0});
  const Model m = b.build("x.unv");
  EXPECT_EQ(place_of(m, NodeId(std::size_t{0})).file, "x.unv");
  EXPECT_EQ(place_of(m, NodeId(std::size_t{0})).line, 0u);
}

}  // namespace
}  // namespace meshgraft
