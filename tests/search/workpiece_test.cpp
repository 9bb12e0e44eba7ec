#include "search/workpiece.hpp"

#include <gtest/gtest.h>

#include <map>

#include "search/candidates.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

struct Cut {
  std::vector<Model> models;
  std::vector<std::vector<ElementId>> candidates;
  GroupSets sets;
  Complex complex;
};

/// Merged groups are numbered by input here: group g of input k becomes 100 k + g.
Cut cut(std::vector<Model> models, double reach = 2) {
  Cut c;
  c.models = std::move(models);
  std::vector<const Model*> inputs;
  std::vector<std::vector<GroupId>> groups;
  for (const Model& m : c.models) {
    groups.emplace_back();
    for (std::size_t g = 0; g < m.groups.size(); ++g) groups.back().emplace_back(100 * inputs.size() + g);
    inputs.push_back(&m);
  }
  const FaceRuns runs(inputs);
  c.candidates = candidate_faces(inputs, runs, one_for_each_input(inputs.size()), {});
  c.complex = workpiece(inputs, runs, one_for_each_input(inputs.size()), c.candidates, groups, c.sets, {reach});
  return c;
}

VertexId vertex_of(const Complex& c, NodeRef node) {
  const auto at = std::find(c.node.begin(), c.node.end(), node);
  return at == c.node.end() ? VertexId{} : VertexId(static_cast<std::size_t>(at - c.node.begin()));
}

/// A plate with quadrilaterals and beams beside and on its triangles, crossed by a small stiffener.
std::vector<Model> mixed_scene() {
  ModelBuilder b;
  const auto node = [](std::size_t i, std::size_t j) { return NodeId(31 * j + i); };
  for (int j = 0; j <= 30; ++j)
    for (int i = 0; i <= 30; ++i) b.add_node({i * 1.0, j * 1.0, 0});
  const NodeId above = b.add_node({10.5, 11, 3}), far_above = b.add_node({0, 0, 300});
  for (std::size_t j = 0; j < 30; ++j)
    for (std::size_t i = 0; i < 30; ++i) {
      const std::array<NodeId, 4> q{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
      if (j == 12 && i < 15) {
        b.add_element({Shape::kQuad, 94, 1, 1, 7, 0, 0}, q);
        continue;
      }
      b.add_face(q[0], q[1], q[2], 1 + std::int64_t(i % 2));
      b.add_to_group("RIGHT", b.add_face(q[0], q[2], q[3]));
    }
  for (std::size_t i = 0; i < 30; ++i) b.add_to_group("BEAMS", b.add_line(node(i, 9), node(i + 1, 9)));
  b.add_line(node(10, 10), above);
  b.add_line(node(11, 10), far_above);
  b.add_element({Shape::kPoint, 161, 1, 1, 7, 0, 0}, std::array{node(12, 11)});
  b.add_to_group("LOADS", node(10, 10));
  std::vector<Model> models;
  models.push_back(b.build("base"));
  models[0].orientation_nodes.push_back({ElementId(0), node(9, 11)});
  models.push_back(scenes::plate({8, 10.3, -1}, {4, 0, 0}, {0, 0, 2}, 0.9));
  return models;
}

TEST(Workpiece, AVertexThatIsNotFrozenHasAllItsFacesAndLines) {
  const Cut c = cut(mixed_scene());
  std::map<ElementRef, int> there;
  for (const ElementRef e : c.complex.parent) ++there[e];
  for (const auto& l : c.complex.lines) ++there[l.parent];
  for (const auto& [e, times] : there) EXPECT_EQ(times, 1);
  std::size_t open = 0, frozen = 0;
  for (std::size_t v = 0; v < c.complex.n_vertices(); ++v) {
    if (c.complex.state[v] == VertexState::kFrozen) {
      ++frozen;
      continue;
    }
    ++open;
    const auto [input, node] = c.complex.node[v];
    const Model& m = c.models[input];
    for (std::size_t e = 0; e < m.n_elements(); ++e) {
      const Shape shape = m.shape(ElementId(e));
      const auto nodes = m.nodes_of(ElementId(e));
      if ((shape == Shape::kTriangle || shape == Shape::kLine) &&
          std::find(nodes.begin(), nodes.end(), node) != nodes.end()) {
        EXPECT_TRUE(there.contains({input, ElementId(e)}));
      }
    }
  }
  EXPECT_GT(open, 50u);
  EXPECT_GT(frozen, 20u);
  EXPECT_LT(c.complex.n_faces(), c.models[0].n_elements() / 2);
}

TEST(Workpiece, EveryFaceWithinReachOfACandidateIsThere) {
  const double reach = 2;
  const Cut c = cut(mixed_scene(), reach);
  for (std::uint32_t k = 0; k < 2; ++k)
    for (std::size_t e = 0; e < c.models[k].n_elements(); ++e) {
      if (!c.models[k].is_face(ElementId(e))) continue;
      Box box;
      for (const Vec3 p : c.models[k].corners(ElementId(e))) box.add(p);
      for (std::uint32_t input = 0; input < 2; ++input)
        for (const ElementId f : c.candidates[input]) {
          Box near;
          double longest = 0;
          const auto t = c.models[input].corners(f);
          for (std::size_t i = 0; i < 3; ++i)
            near.add(t[i]), longest = std::max(longest, distance(t[i], t[(i + 1) % 3]));
          if (near.grown(reach * longest).overlaps(box)) {
            ASSERT_NE(std::find(c.complex.parent.begin(), c.complex.parent.end(), ElementRef{k, ElementId(e)}),
                      c.complex.parent.end());
          }
        }
    }
}

TEST(Workpiece, AHugeFaceAcrossTheRegionIsThereAndFrozen) {
  ModelBuilder b;
  b.add_face(b.add_node({-10, -10, 1.5}), b.add_node({14, -10, 1.5}), b.add_node({2, 14, 1.5}));
  std::vector<Model> models;
  models.push_back(scenes::together(std::array{scenes::plate({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, 0.5), b.build()}));
  models.push_back(scenes::plate({1, 2.1, -0.5}, {2, 0, 0}, {0, 0, 1}, 0.5));
  const Cut c = cut(models);
  const ElementRef huge{0, ElementId(models[0].n_elements() - 1)};
  const auto at = std::find(c.complex.parent.begin(), c.complex.parent.end(), huge);
  ASSERT_NE(at, c.complex.parent.end());
  for (const VertexId v : c.complex.face[std::size_t(at - c.complex.parent.begin())])
    EXPECT_EQ(c.complex.state[v.value], VertexState::kFrozen);
}

TEST(Workpiece, NodesOfOtherElementsArePinned) {
  const Cut c = cut(mixed_scene());
  const auto state = [&](std::size_t i, std::size_t j) {
    return c.complex.state[vertex_of(c.complex, {0, NodeId(31 * j + i)}).value];
  };
  EXPECT_EQ(state(10, 12), VertexState::kPinned);  // of a quadrilateral
  EXPECT_EQ(state(12, 11), VertexState::kPinned);  // of a mass
  EXPECT_EQ(state(9, 11), VertexState::kPinned);   // orientation of a beam
  EXPECT_EQ(state(10, 9), VertexState::kOpen);     // of beams that are rebuilt
}

TEST(Workpiece, SidesOfQuadrilateralsAreFixedWhereFacesHaveThem) {
  const Cut c = cut(mixed_scene());
  const auto has = [&](NodeId a, NodeId b) {
    const VertexId v = vertex_of(c.complex, {0, a}), w = vertex_of(c.complex, {0, b});
    return std::find(c.complex.fixed_edges.begin(), c.complex.fixed_edges.end(),
                     std::array{std::min(v, w), std::max(v, w)}) != c.complex.fixed_edges.end();
  };
  EXPECT_TRUE(has(NodeId(31 * 12 + 10), NodeId(31 * 12 + 11)));
  EXPECT_TRUE(has(NodeId(31 * 13 + 10), NodeId(31 * 13 + 11)));
  EXPECT_FALSE(has(NodeId(31 * 12 + 10), NodeId(31 * 13 + 10)));  // between two quadrilaterals
  EXPECT_FALSE(has(NodeId(31 * 12 + 10), NodeId(31 * 13 + 11)));  // a diagonal
}

TEST(Workpiece, ALineThatLeavesTheRegionEndsInAFrozenVertex) {
  const Cut c = cut(mixed_scene());
  const VertexId far_end = vertex_of(c.complex, {0, NodeId(std::size_t{31 * 31 + 1})});
  ASSERT_TRUE(far_end.valid());
  EXPECT_EQ(c.complex.state[far_end.value], VertexState::kFrozen);
}

TEST(Workpiece, GroupsAndAttributesCompareAcrossInputs) {
  const Cut c = cut(mixed_scene());
  const Complex& x = c.complex;
  const VertexId loaded = vertex_of(x, {0, NodeId(31 * 10 + 10)});
  ASSERT_EQ(c.sets.members(x.vertex_groups[loaded.value]).size(), 1u);
  EXPECT_EQ(c.models[0].groups[c.sets.members(x.vertex_groups[loaded.value])[0].value].name, "LOADS");
  for (std::size_t f = 0; f < x.n_faces(); ++f) {
    EXPECT_EQ(x.component[f], x.parent[f].input);
    const Model& m = c.models[x.parent[f].input];
    for (const GroupId g : c.sets.members(x.face_groups[f])) EXPECT_EQ(g.value / 100, x.parent[f].input);
    EXPECT_EQ(c.sets.members(x.face_groups[f]).size(),
              m.group_sets.members(m.element_groups[x.parent[f].element.value]).size());
    for (std::size_t g = 0; g < x.n_faces(); g += 17)
      EXPECT_EQ(x.face_attributes[f] == x.face_attributes[g],
                m.attributes_of(x.parent[f].element) == c.models[x.parent[g].input].attributes_of(x.parent[g].element));
  }
}

}  // namespace
}  // namespace meshgraft
