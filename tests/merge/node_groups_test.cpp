#include "merge/node_groups.hpp"

#include <gtest/gtest.h>

#include "merge/hand_made.hpp"

namespace meshgraft {
namespace {

using testing_support::HandMade;

NodeId id(std::size_t n) { return NodeId(n); }

/// Two triangles on a square; the second one only is in group FACE.
ModelBuilder square() {
  ModelBuilder b;
  for (int k = 0; k < 4; ++k) b.add_node({double(k % 2), double(k / 2), 0});
  b.add_face(id(0), id(1), id(2));
  b.add_to_group("FACE", b.add_face(id(1), id(3), id(2)));
  return b;
}

bool in_group(const HandMade& m, GroupSetId set, const std::string& name) {
  for (const GroupId g : m.graft.group_sets.members(set))
    if (m.graft.groups[g.value].name == name) return true;
  return false;
}

FaceId face_of(const HandMade& m, std::size_t element) {
  for (std::size_t f = 0; f < m.final_complex.n_faces(); ++f)
    if (m.final_complex.parent[f].element == ElementId(element)) return FaceId(f);
  return {};
}

TEST(NodeGroups, AGroupThatCoveredAFaceGroupCoversItsNewFacesToo) {
  ModelBuilder b = square();
  for (const std::size_t n : {1u, 2u, 3u}) b.add_to_group("COVER", id(n));
  HandMade m({b.build()});
  m.split_face(face_of(m, 1));
  m.stitch_now();
  ASSERT_EQ(m.graft.new_nodes.size(), 1u);
  EXPECT_TRUE(in_group(m, m.graft.new_nodes[0].groups, "COVER"));
  EXPECT_TRUE(m.graft.joined_nodes.empty());
}

TEST(NodeGroups, AGroupThatMissedOneNodeCoversNothing) {
  ModelBuilder b = square();
  for (const std::size_t n : {1u, 2u}) b.add_to_group("ALMOST", id(n));
  HandMade m({b.build()});
  m.split_face(face_of(m, 1));
  m.stitch_now();
  EXPECT_EQ(m.graft.new_nodes[0].groups, GroupSets::kEmpty);
}

TEST(NodeGroups, FacesOutsideTheElementGroupDoNotDrawTheirNodesIn) {
  ModelBuilder b = square();
  for (const std::size_t n : {1u, 2u, 3u}) b.add_to_group("COVER", id(n));
  HandMade m({b.build()});
  m.split_face(face_of(m, 0));
  m.stitch_now();
  EXPECT_EQ(m.graft.new_nodes[0].groups, GroupSets::kEmpty);
}

TEST(NodeGroups, OverlappingElementGroupsEachCallTheirCovers) {
  ModelBuilder b = square();
  b.add_to_group("ALL", ElementId(std::size_t{0}));
  b.add_to_group("ALL", ElementId(std::size_t{1}));
  for (std::size_t n = 0; n < 4; ++n) b.add_to_group("COVER_ALL", id(n));
  for (const std::size_t n : {1u, 2u, 3u}) b.add_to_group("COVER_FACE", id(n));
  HandMade m({b.build()});
  m.split_face(face_of(m, 0));
  m.split_face(face_of(m, 1));
  m.stitch_now();
  ASSERT_EQ(m.graft.new_nodes.size(), 2u);  // in the order of the faces they split
  EXPECT_TRUE(in_group(m, m.graft.new_nodes[0].groups, "COVER_ALL"));
  EXPECT_FALSE(in_group(m, m.graft.new_nodes[0].groups, "COVER_FACE"));
  EXPECT_TRUE(in_group(m, m.graft.new_nodes[1].groups, "COVER_ALL"));
  EXPECT_TRUE(in_group(m, m.graft.new_nodes[1].groups, "COVER_FACE"));
}

TEST(NodeGroups, AKeptNodeOfAnotherInputJoinsTheCoverOfTheFaceItNowBelongsTo) {
  ModelBuilder part = square();
  for (const std::size_t n : {1u, 2u, 3u}) part.add_to_group("COVER", id(n));
  ModelBuilder base;  // one node of it lies in the middle of the part's face
  base.add_node({0.7, 0.7, 0}), base.add_node({0.7, 0.7, 1}), base.add_node({1.7, 0.7, 1});
  base.add_face(id(0), id(1), id(2));
  HandMade m({base.build(), part.build()});
  for (std::size_t f = 0; f < m.final_complex.n_faces(); ++f) {
    if (m.final_complex.parent[f] != ElementRef{1, ElementId(std::size_t{1})}) continue;
    const VertexId c = m.split_face(FaceId(f));
    for (auto& v : m.final_complex.face) std::ranges::replace(v, c, m.vertex(0, 0));
    break;
  }
  m.stitch_now();
  EXPECT_TRUE(m.graft.new_nodes.empty());
  ASSERT_EQ(m.graft.joined_nodes.size(), 1u);
  EXPECT_EQ(m.graft.joined_nodes[0].node, (NodeRef{0, id(0)}));
  EXPECT_TRUE(in_group(m, m.graft.joined_nodes[0].groups, "COVER"));
}

}  // namespace
}  // namespace meshgraft
