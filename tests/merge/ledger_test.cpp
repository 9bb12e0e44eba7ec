#include "merge/ledger.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/quality.hpp"
#include "merge/hand_made.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

using testing_support::HandMade;

std::string numbered(std::size_t g) {
  std::string name("G");
  return name.append(std::to_string(g));
}

struct Figures {
  std::uint64_t members = 0;
  double area = 0, length = 0;
};

/// The slow and simple way: group by group.
Figures figures(const Model& model, std::size_t group) {
  Figures f;
  const GroupId g(group);
  for (std::size_t e = 0; e < model.n_elements(); ++e) {
    if (!model.group_sets.contains(model.element_groups[e], g)) continue;
    ++f.members;
    const auto nodes = model.nodes_of(ElementId(e));
    if (model.is_face(ElementId(e))) f.area += area(model.corners(ElementId(e)));
    if (model.shape(ElementId(e)) == Shape::kLine)
      f.length += distance(model.position[nodes[0].value], model.position[nodes[1].value]);
  }
  for (const GroupSetId s : model.node_groups) f.members += model.group_sets.contains(s, g) ? 1 : 0;
  return f;
}

Model random_groups(Vec3 origin) {
  const Model plain = scenes::plate(origin, {4, 0, 0}, {0, 4, 0}, 1, "ALL", 0.2);
  ModelBuilder b = scenes::faces_of(plain);
  const ElementId beam = b.add_line(plain.nodes[0], plain.nodes[1]);
  b.add_to_group("BEAM", beam);
  const auto n_groups = *rc::gen::inRange<std::size_t>(1, 12);
  for (std::size_t g = 0; g < n_groups; ++g) {
    const std::string name = numbered(g);
    for (std::size_t e = 0; e < plain.n_elements(); ++e)
      if (*rc::gen::inRange(0, 3) == 0) b.add_to_group(name, ElementId(e));
    for (std::size_t n = 0; n < plain.n_nodes(); ++n)
      if (*rc::gen::inRange(0, 5) == 0) b.add_to_group(name, NodeId(n));
  }
  return b.build();
}

TEST(Ledger, AddsUpToWhatTheModelsHoldBeforeAndAfter) {
  EXPECT_TRUE(rc::check([] {
    HandMade m({random_groups({0, 0, 0}), random_groups({0, 0, 5})});
    const auto n_splits = *rc::gen::inRange(0, 6);
    for (int k = 0; k < n_splits; ++k)
      m.split_face(FaceId(*rc::gen::inRange<std::size_t>(0, m.final_complex.n_faces())));
    m.stitch_now();
    const Ledger ledger = ledger_of(m.inputs(), m.graft);
    const Model result = m.result();
    RC_ASSERT(ledger.groups.size() == result.groups.size());
    for (std::size_t g = 0; g < result.groups.size(); ++g) {
      const GroupEntry& entry = ledger.groups[g];
      const Figures after = figures(result, g);
      RC_ASSERT(entry.name == result.groups[g].name);
      RC_ASSERT(entry.members_after == after.members);
      RC_ASSERT(after.members == result.groups[g].n_nodes + result.groups[g].n_elements);
      RC_ASSERT(std::abs(entry.area_after - after.area) < 1e-9);
      RC_ASSERT(std::abs(entry.length_after - after.length) < 1e-9);
      Figures before;
      for (const MergedGroup::From from : m.graft.groups[g].from) {
        const Figures f = figures(m.model(from.input), from.group.value);
        before.members += f.members, before.area += f.area;
      }
      RC_ASSERT(entry.members_before == before.members);
      RC_ASSERT(std::abs(entry.area_before - before.area) < 1e-9);
    }
    RC_ASSERT(ledger.broken.empty());  // a split keeps every area
  }));
}

TEST(Ledger, AGroupThatLosesAreaOrAllItsMembersIsABrokenPromise) {
  ModelBuilder b;
  for (int k = 0; k < 4; ++k) b.add_node({double(k % 2), double(k / 2), 0});
  b.add_to_group("LOST", b.add_face(NodeId(std::size_t{0}), NodeId(std::size_t{1}), NodeId(std::size_t{2})));
  b.add_to_group("BOTH", ElementId(std::size_t{0}));
  b.add_to_group("BOTH", b.add_face(NodeId(std::size_t{1}), NodeId(std::size_t{3}), NodeId(std::size_t{2})));
  HandMade m({b.build()});
  m.remove_face(FaceId(std::size_t{0}));
  m.stitch_now();
  const Ledger ledger = ledger_of(m.inputs(), m.graft);
  ASSERT_EQ(ledger.broken.size(), 2u);
  EXPECT_NE(ledger.broken[0].what.find("group LOST had 1 members and is empty now"), std::string::npos);
  EXPECT_NE(ledger.broken[1].what.find("group BOTH had area 1 and has 0.5 now"), std::string::npos);
  EXPECT_EQ(ledger.broken[0].code, ErrorCode::kPromiseBroken);
}

TEST(Ledger, SaysByWhichRuleAGroupIsWhatItIs) {
  HandMade m({scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 1, "BASE"),
              scenes::plate({0, 0, 5}, {2, 0, 0}, {0, 2, 0}, 1, "PART"),
              scenes::plate({0, 0, 9}, {2, 0, 0}, {0, 2, 0}, 1, "BASE")});
  for (std::size_t f = 0; f < m.final_complex.n_faces(); ++f)
    if (m.final_complex.component[f] == 1) {
      m.split_face(FaceId(f));
      break;
    }
  m.stitch_now();
  const Ledger ledger = ledger_of(m.inputs(), m.graft);
  ASSERT_EQ(ledger.groups.size(), 2u);
  EXPECT_EQ(ledger.groups[0].rule, "united from 2 inputs");
  EXPECT_EQ(ledger.groups[1].rule, "inherited from parent");
  EXPECT_EQ(ledger.groups[0].kind, "faces");
}

TEST(Ledger, QuadrilateralsAndBeamsCountByTheirSize) {
  ModelBuilder b;
  for (int k = 0; k < 4; ++k) b.add_node({double(k % 2), double(k / 2), 0});
  ElementAttributes quad;
  quad.shape = Shape::kQuad;
  const auto n = [](std::size_t k) { return NodeId(k); };
  b.add_to_group("MIXED", b.add_element(quad, std::array{n(0), n(1), n(3), n(2)}));
  b.add_to_group("MIXED", b.add_line(n(0), n(3)));
  b.add_to_group("MIXED", n(2));
  b.add_face(n(0), n(1), n(2));
  HandMade m({b.build()});
  m.stitch_now();
  const GroupEntry e = ledger_of(m.inputs(), m.graft).groups.at(0);
  EXPECT_DOUBLE_EQ(e.area_before, 1);
  EXPECT_DOUBLE_EQ(e.length_before, std::sqrt(2.0));
  EXPECT_EQ(e.kind, "nodes+faces+lines");
  EXPECT_EQ(e.rule, "untouched");
}

TEST(Ledger, FiveHundredOverlappingGroupsAllAddUp) {
  const Model plain = scenes::plate({0, 0, 0}, {20, 0, 0}, {0, 20, 0}, 1);
  ModelBuilder b = scenes::faces_of(plain);
  for (std::size_t g = 0; g < 500; ++g)
    for (std::size_t e = g % 7; e < plain.n_elements(); e += 1 + g % 11) b.add_to_group(numbered(g), ElementId(e));
  HandMade m({b.build()});
  for (const std::size_t f : {3u, 77u, 400u}) m.split_face(FaceId(f));
  m.stitch_now();
  const Ledger ledger = ledger_of(m.inputs(), m.graft);
  const Model result = m.result();
  ASSERT_EQ(ledger.groups.size(), 500u);
  for (std::size_t g = 0; g < 500; ++g) {
    EXPECT_EQ(ledger.groups[g].members_after, result.groups[g].n_elements);
    EXPECT_NEAR(ledger.groups[g].area_after, ledger.groups[g].area_before, 1e-9);
  }
}

/// The foot of the leg goes to the base with the nodes of the flat one; the faces of the leg stay as they are else.
TEST(Ledger, FacesThatStayCountAsTheirNodesStandNow) {
  const Model base = scenes::plate({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, 1, "BASE");
  const std::array<Model, 2> legs{scenes::plate({0, 0, 0.1}, {3, 0, 0}, {0, 3, 0}, 1, "FLAT"),
                                  scenes::plate({0, 0, 0.1}, {3, 0, 0}, {0, 0, 3}, 1, "STANDING")};
  const Model profile = scenes::welded(scenes::together(legs));
  MergeOptions options;
  options.tolerance = {0.15, false};
  const auto merged = merge(base, std::span(&profile, 1), options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << to_string(merged->report.broken_promises.front());
  const auto standing = std::ranges::find(merged->report.groups, "STANDING", &GroupEntry::name);
  ASSERT_NE(standing, merged->report.groups.end());
  EXPECT_NEAR(standing->area_after, 3 * 3.1, 1e-9);
}

}  // namespace
}  // namespace meshgraft
