#include "merge/stitch.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "merge/hand_made.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

using testing_support::HandMade;

Model plate(Vec3 origin = {0, 0, 0}, const std::string& group = "PLATE") {
  return scenes::plate(origin, {4, 0, 0}, {0, 4, 0}, 1, group);
}

bool names(const std::vector<NodeId>& list, std::size_t node) {
  return std::ranges::find(list, NodeId(node)) != list.end();
}

TEST(Stitch, AnUntouchedComplexGivesAnEmptyDifference) {
  HandMade m({plate(), plate({0, 0, 9}, "OTHER")});
  m.stitch_now();
  EXPECT_TRUE(m.graft.new_elements.empty());
  EXPECT_TRUE(m.graft.new_nodes.empty());
  EXPECT_TRUE(m.graft.joined_nodes.empty());
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_TRUE(m.graft.removed_elements[k].empty());
    EXPECT_TRUE(m.graft.removed_nodes[k].empty());
  }
}

TEST(Stitch, ARotatedFaceIsTheSameFaceAndATurnedOneIsNot) {
  HandMade m({plate()});
  std::ranges::rotate(m.final_complex.face[3], m.final_complex.face[3].begin() + 1);
  std::swap(m.final_complex.face[5][0], m.final_complex.face[5][1]);
  m.stitch_now();
  ASSERT_EQ(m.graft.removed_elements[0].size(), 1u);
  EXPECT_EQ(m.graft.removed_elements[0][0], m.original.parent[5].element);
}

TEST(Stitch, ASplitFaceIsReplacedByItsPieces) {
  HandMade m({plate()});
  const ElementRef parent = m.final_complex.parent[4];
  const VertexId c = m.split_face(FaceId(std::size_t{4}));
  const Stitched& s = m.stitch_now();
  EXPECT_EQ(m.graft.removed_elements[0], std::vector{parent.element});
  ASSERT_EQ(m.graft.new_elements.size(), 3u);
  for (const NewElement& e : m.graft.new_elements) {
    EXPECT_EQ(e.parent, parent);
    EXPECT_EQ(e.groups, m.translated.of(parent));
  }
  ASSERT_EQ(m.graft.new_nodes.size(), 1u);
  EXPECT_EQ(s.node[c.value], (NodeRef{kNew, NodeId(std::size_t{0})}));
  EXPECT_EQ(m.graft.new_nodes[0].like.input, 0u);
}

TEST(Stitch, AVertexThatLeftItsPlaceIsANewNodeAndTheOldOneIsRemoved) {
  HandMade m({plate()});
  const VertexId v = m.vertex(0, 12);  // in the middle
  m.final_complex.position[v.value].x += 1e-12;
  m.stitch_now();
  EXPECT_EQ(m.graft.new_nodes.size(), 1u);
  EXPECT_TRUE(names(m.graft.removed_nodes[0], 12));
  EXPECT_EQ(m.graft.new_elements.size(), m.graft.removed_elements[0].size());
}

TEST(Stitch, ANewVertexExactlyWhereANodeWasIsThatNode) {
  HandMade m({plate()});
  m.final_complex.node[m.vertex(0, 12).value] = {};  // as if removed, and another put in its place
  m.stitch_now();
  EXPECT_TRUE(m.graft.new_nodes.empty());
  EXPECT_TRUE(m.graft.removed_nodes[0].empty());
  EXPECT_TRUE(m.graft.new_elements.empty());
}

TEST(Stitch, OneNodeIsGivenBackToOneVertexOnly) {
  HandMade m({plate()});
  const VertexId v = m.vertex(0, 12);
  m.final_complex.node[v.value] = {};
  const VertexId twin =
      m.final_complex.add_vertex(m.final_complex.position[v.value], {}, VertexState::kOpen, GroupSets::kEmpty);
  const auto face =
      std::ranges::find_if(m.final_complex.face, [&](const auto& f) { return std::ranges::find(f, v) != f.end(); });
  std::ranges::replace(*face, v, twin);
  m.stitch_now();
  EXPECT_EQ(m.graft.new_nodes.size(), 1u);
}

TEST(Stitch, ANodeThatNoFaceUsesAnyMoreIsRemoved) {
  HandMade m({plate()});
  const VertexId corner = m.vertex(0, 0);
  for (std::size_t f = m.final_complex.n_faces(); f-- > 0;)
    if (std::ranges::find(m.final_complex.face[f], corner) != m.final_complex.face[f].end()) m.remove_face(FaceId(f));
  m.stitch_now();
  EXPECT_TRUE(names(m.graft.removed_nodes[0], 0));
  EXPECT_EQ(m.graft.removed_nodes[0].size(), 1u);
}

/// Two faces on the first four nodes, and a mass on the first.
Model square_with_mass(int n_nodes) {
  ModelBuilder b;
  for (int k = 0; k < n_nodes; ++k) b.add_node({double(k % 2), double(k / 2), 0});
  b.add_face(NodeId(std::size_t{0}), NodeId(std::size_t{1}), NodeId(std::size_t{2}));
  b.add_face(NodeId(std::size_t{1}), NodeId(std::size_t{3}), NodeId(std::size_t{2}));
  ElementAttributes mass;
  mass.shape = Shape::kPoint, mass.type = 161;
  b.add_element(mass, std::array{NodeId(std::size_t{0})});
  return b.build();
}

TEST(Stitch, NodesOfOtherElementsAndOrphansStay) {
  HandMade m({square_with_mass(5)});  // the last node is an orphan
  m.remove_face(FaceId(std::size_t{0}));
  m.stitch_now();
  EXPECT_TRUE(m.graft.removed_nodes[0].empty());
  EXPECT_EQ(m.graft.removed_elements[0].size(), 1u);
}

TEST(Stitch, APinnedNodeMissingFromTheComplexIsReported) {
  HandMade m({square_with_mass(4)});
  m.remove_face(FaceId(std::size_t{0}));
  const VertexId v = m.vertex(0, 0);
  m.final_complex.node[v.value] = {};
  m.final_complex.position[v.value].z = 1;
  EXPECT_EQ(m.stitch_now().lost_nodes, (std::vector<NodeRef>{{0, NodeId(std::size_t{0})}}));
}

TEST(Stitch, ANodePulledIntoPlaceMovesAndItsFacesAreKeptButChanged) {
  HandMade m({plate(), plate({0, 0, 1}, "PART")});
  const NodeRef node{1, NodeId(std::size_t{6})};
  const VertexId v = m.vertex(1, 6);
  const Vec3 from = m.final_complex.position[v.value], to = from - Vec3{0, 0, 0.001};
  m.corefined.moves.push_back({node, v, from, to});
  m.corefined.complex.position[v.value] = m.final_complex.position[v.value] = to;
  const Stitched& s = m.stitch_now();
  ASSERT_EQ(m.graft.moved_nodes.size(), 1u);
  EXPECT_EQ(m.graft.moved_nodes[0].node, node);
  EXPECT_EQ(m.graft.moved_nodes[0].to, to);
  EXPECT_TRUE(m.graft.new_nodes.empty());
  EXPECT_TRUE(m.graft.removed_nodes[1].empty());
  EXPECT_TRUE(m.graft.new_elements.empty());
  for (std::size_t f = 0; f < m.final_complex.n_faces(); ++f)
    EXPECT_EQ(s.changed[f] != 0, std::ranges::find(m.final_complex.face[f], v) != m.final_complex.face[f].end());
}

/// Two plates side by side; the nodes of the second on the line x = 4 become those of the first.
void weld(HandMade& m) {
  for (std::size_t v = 0; v < m.original.n_vertices(); ++v) {
    const NodeRef n = m.original.node[v];
    if (n.input != 1 || m.original.position[v].x != 4) continue;
    for (std::size_t w = 0; w < m.original.n_vertices(); ++w) {
      if (m.original.node[w].input != 0 || m.original.position[w] != m.original.position[v]) continue;
      m.corefined.replaced.push_back({n, VertexId(w)});
      for (Complex* c : {&m.corefined.complex, &m.final_complex})
        for (auto& face : c->face) std::ranges::replace(face, VertexId(v), VertexId(w));
    }
  }
  std::ranges::sort(m.corefined.replaced, {}, &Corefined::Replaced::node);
}

TEST(Stitch, FacesOnReplacedNodesAreKeptAndPointToTheSurvivor) {
  HandMade m({plate(), plate({4, 0, 0}, "PART")});
  weld(m);
  m.stitch_now();
  EXPECT_TRUE(m.graft.new_elements.empty());
  EXPECT_EQ(m.graft.removed_nodes[1].size(), 5u);
  ASSERT_EQ(m.graft.replaced_nodes.size(), 5u);
  for (const Graft::ReplacedNode& r : m.graft.replaced_nodes) {
    EXPECT_EQ(r.by.input, 0u);
    EXPECT_TRUE(std::ranges::binary_search(m.graft.removed_nodes[1], r.node.node));
  }
  const Model result = m.result();
  EXPECT_EQ(result.n_nodes(), 45u);
  EXPECT_EQ(result.n_elements(), 64u);
}

TEST(Stitch, TheSurvivorJoinsTheGroupsOfTheNodeItReplaces) {
  ModelBuilder b;
  const NodeId n0 = b.add_node({4, 0, 0}), n1 = b.add_node({5, 0, 0}), n2 = b.add_node({4, 1, 0});
  b.add_face(n0, n1, n2);
  b.add_to_group("CLAMP", n0);
  HandMade m({plate(), b.build()});
  weld(m);
  m.stitch_now();
  ASSERT_EQ(m.graft.joined_nodes.size(), 1u);
  EXPECT_EQ(m.graft.joined_nodes[0].node, (NodeRef{0, NodeId(std::size_t{4})}));
  const Model result = m.result();
  EXPECT_EQ(result.groups.back().name, "CLAMP");
  EXPECT_EQ(result.groups.back().n_nodes, 1u);
}

TEST(Stitch, LinesAreKeptByTheirNodesAndSplitOnesAreReplaced) {
  ModelBuilder b;
  const NodeId n0 = b.add_node({0, 0, 0}), n1 = b.add_node({1, 0, 0}), n2 = b.add_node({0, 1, 0});
  b.add_face(n0, n1, n2);
  const ElementId kept = b.add_line(n1, n2), split = b.add_line(n0, n1);
  b.add_to_group("BEAM", split);
  HandMade m({b.build()});
  const VertexId middle = m.final_complex.add_vertex({0.5, 0, 0}, {}, VertexState::kOpen, GroupSets::kEmpty);
  m.final_complex.face[0] = {m.vertex(0, 0), middle, m.vertex(0, 2)};
  m.final_complex.add_face({middle, m.vertex(0, 1), m.vertex(0, 2)}, Complex(m.final_complex), FaceId(std::size_t{0}));
  auto& lines = m.final_complex.lines;
  for (std::size_t k = 0, n = lines.size(); k < n; ++k) {
    if (lines[k].parent.element != split) continue;
    Complex::Line second = lines[k];
    lines[k].ends[1] = middle, second.ends[0] = middle;
    lines.push_back(second);
  }
  m.stitch_now();
  const auto& removed = m.graft.removed_elements[0];
  EXPECT_TRUE(std::ranges::binary_search(removed, split));
  EXPECT_FALSE(std::ranges::binary_search(removed, kept));
  const auto is_line = [](const NewElement& e) { return !e.nodes[2].valid(); };
  EXPECT_EQ(std::ranges::count_if(m.graft.new_elements, is_line), 2);
  const Model result = m.result();
  EXPECT_EQ(result.groups.front().n_elements, 2u);
}

TEST(Stitch, NewElementsStandInTheOrderOfTheirParents) {
  HandMade m({plate(), plate({0, 0, 5}, "PART")});
  for (const std::size_t f : {40u, 3u, 17u}) m.split_face(FaceId(f));
  m.stitch_now();
  EXPECT_TRUE(std::ranges::is_sorted(m.graft.new_elements, {}, &NewElement::parent));
  EXPECT_TRUE(std::ranges::is_sorted(m.graft.removed_elements[0]));
}

}  // namespace
}  // namespace meshgraft
