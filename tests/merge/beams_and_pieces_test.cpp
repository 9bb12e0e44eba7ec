// What a merge does with beams, and with pieces that meet nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "merge/merge_laws.hpp"
#include "meshgraft/check.hpp"
#include "meshgraft/merge.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

using namespace merge_laws;

TEST(Merge, BeamsAlongACrossedEdgeAreRebuiltWithTheirGroups) {
  Model plain = wall(0);
  ModelBuilder b = scenes::faces_of(plain);
  for (std::size_t i = 0; i < 20; ++i) b.add_to_group("BEAM", b.add_line(NodeId(10 * 21 + i), NodeId(10 * 21 + i + 1)));
  const Model base = b.build();
  const std::vector<Model> parts{scenes::plate({0.87, 0.4, -0.3}, {0, 1.2, 0}, {0, 0, 0.7}, kSize, "STIFFENER", 0.15)};
  const Merged m = merged(base, parts);
  expect_laws(base, parts, m);
  const auto beam = std::ranges::find(m.report.groups, "BEAM", &GroupEntry::name);
  ASSERT_NE(beam, m.report.groups.end());
  EXPECT_NEAR(beam->length_before, 2, 1e-12);
  EXPECT_NEAR(beam->length_after, 2, 1e-12);
}

TEST(Merge, BeamsWhoseNodesSlideAlongTheirLineAreNotDoubled) {
  // Ribs with beams on their upper edges, and a frame across them that ends lower.
  std::vector<Model> sheets{scenes::plate({0, 0, 0}, {12, 0, 0}, {0, 9, 0}, 0.5, "PLATE")};
  for (const double y : {1.5, 4.5, 7.5})
    sheets.push_back(scenes::plate({0, y, 0}, {12, 0, 0}, {0, 0, 1.5}, 0.5, "RIBS"));
  const Model plain = scenes::welded(scenes::together(sheets));
  ModelBuilder b = scenes::faces_of(plain);
  std::map<double, std::map<double, NodeId>> upper;  // by y, x
  for (std::size_t v = 0; v < plain.n_nodes(); ++v)
    if (const Vec3 p = plain.position[v]; p.z == 1.5) upper[p.y][p.x] = NodeId(v);
  for (const auto& [y, along] : upper)
    for (auto at = along.begin(); std::next(at) != along.end(); ++at)
      b.add_to_group("BEAM", b.add_line(at->second, std::next(at)->second));
  const Model base = b.build();
  const scenes::Surface frame{[](double u, double v) { return Vec3{5, 9 * u, v}; }, 18, 6, false, false, 0, 1, "FRAME"};
  const std::vector<Model> parts{scenes::surface(frame)};
  const Merged m = merged(base, parts);
  expect_laws(base, parts, m);
  const auto beam = std::ranges::find(m.report.groups, "BEAM", &GroupEntry::name);
  ASSERT_NE(beam, m.report.groups.end());
  EXPECT_NEAR(beam->length_after, 36, 1e-9);
}

const Warning* piece_apart(const Merged& m) {
  const auto warning = std::ranges::find(m.report.warnings, "piece-apart", &Warning::name);
  return warning == m.report.warnings.end() ? nullptr : &*warning;
}

TEST(Merge, PieceOfAPartThatMeetsNothingIsToldWithItsDistance) {
  const Model base = wall(), near = stiffener(0.4, 1.6, 0.63, 0.3, 0.3);
  const Model gap = scenes::plate({0.4, 1.43, 0.25}, {1.2, 0, 0}, {0, 0, 0.6}, kSize, "GAP", 0);
  const Merged alone = merged(base, {near});
  EXPECT_EQ(piece_apart(alone), nullptr);
  const Model both = scenes::together(std::array{near, gap});
  const Merged m = merged(base, {both});
  ASSERT_NE(piece_apart(m), nullptr);
  const std::string first = std::to_string(both.element_label[near.n_elements()]);
  EXPECT_TRUE(piece_apart(m)->what.starts_with("element " + first + " of ")) << piece_apart(m)->what;
  EXPECT_NE(piece_apart(m)->what.find(std::to_string(gap.n_elements() - 1) + " more elements"), std::string::npos);
  EXPECT_NE(piece_apart(m)->what.find(" 0.25 or more away"), std::string::npos) << piece_apart(m)->what;
}

TEST(Merge, PieceOfAFileJoinedWithItselfThatMeetsNothingIsTold) {
  const Model near = stiffener(0.4, 1.6, 0.63, 0.3, 0.3), gap = stiffener(0.4, 1.6, 1.43, -0.25, 0.85),
              other = stiffener(0.4, 1.6, 1.83, -0.25, 0.85);
  EXPECT_EQ(piece_apart(merged(scenes::together(std::array{wall(), near}), {})), nullptr);
  const Merged m = merged(scenes::together(std::array{wall(), near, gap, other}), {});
  ASSERT_NE(piece_apart(m), nullptr);
  EXPECT_NE(piece_apart(m)->what.find("so are 1 more pieces"), std::string::npos) << piece_apart(m)->what;
}

TEST(Merge, ColumnOfBeamsThatStandsOnTheWallIsApartUnlessSomethingHoldsIt) {
  const Model near = stiffener(0.4, 1.6, 0.63, 0.3, 0.3);
  for (const bool held : {false, true}) {
    ModelBuilder b = scenes::faces_of(near);
    b.add_line(b.add_node({0.7, 1.3, 0}), held ? NodeId(0u) : b.add_node({0.7, 1.3, 1}));
    const Merged m = merged(wall(), {b.build()});
    EXPECT_EQ(piece_apart(m) == nullptr, held);
  }
}

TEST(Merge, PiecesThatLieOnTheWallMeetIt) {
  const std::array pads{scenes::plate({0.4, 0.4, 0}, {0.5, 0, 0}, {0, 0.4, 0}, 0.08, "PAD"),
                        scenes::plate({0.4, 1.2, 0}, {0.5, 0, 0}, {0, 0.4, 0}, 0.08, "PAD"),
                        stiffener(1.2, 1.7, 1.03, 0.3, 0.3)};
  for (const Overlap overlap : {Overlap::kFuse, Overlap::kKeepBase, Overlap::kKeepPart, Overlap::kProject}) {
    MergeOptions options;
    options.overlap = overlap;
    EXPECT_EQ(piece_apart(merged(wall(), {scenes::together(pads)}, options)), nullptr) << static_cast<int>(overlap);
  }
}

/// The model with 1D elements of a type on all edges whose ends are at y = 1, z = 0.
Model with_beams(const Model& plain, std::int64_t type) {
  ModelBuilder b;
  for (const Vec3 p : plain.position) b.add_node(p);
  std::set<std::array<NodeId, 2>> edges;
  const auto is_on = [&](NodeId n) {
    const Vec3 p = plain.position[n.value];
    return std::abs(p.y - 1) < 1e-9 && std::abs(p.z) < 1e-9;
  };
  for (std::size_t e = 0; e < plain.n_elements(); ++e) {
    const auto n = plain.nodes_of(ElementId(e));
    b.add_face(n[0], n[1], n[2]);
    for (std::size_t k = 0; k < 3; ++k)
      if (is_on(n[k]) && is_on(n[(k + 1) % 3]))
        edges.insert({std::min(n[k], n[(k + 1) % 3]), std::max(n[k], n[(k + 1) % 3])});
  }
  ElementAttributes beam;
  beam.shape = Shape::kLine, beam.type = type, beam.physical = 3;
  for (const auto& ends : edges) b.add_element(beam, ends);
  return b.build();
}

TEST(Merge, BeamsOfTwoMeshesOnOneEdgeStayWithAWarning) {
  constexpr std::int64_t kRod = 11, kBeam = 21;
  const Model base = with_beams(wall(0), kBeam);
  for (const double size : {kSize, 0.7 * kSize}) {  // edge on edge, and with nodes between nodes
    const Model rib = scenes::plate({0.4, 1, 0}, {1.2, 0, 0}, {0, 0, 0.7}, size, "RIB", 0);
    for (const std::int64_t type : {kRod, kBeam}) {
      const std::vector<Model> parts{with_beams(rib, type)};
      const Merged m = merged(base, parts);
      const auto warning = std::ranges::find(m.report.warnings, "doubled-line", &Warning::name);
      EXPECT_EQ(warning != m.report.warnings.end(), type == kBeam) << size;
      const CheckResult result = check(apply(base, parts, m));
      EXPECT_EQ(result.n_doubled_lines > 0, type == kBeam);
      if (type != kBeam || warning == m.report.warnings.end()) continue;
      EXPECT_NE(warning->what.find("so do " + std::to_string(result.n_doubled_lines - 1) + " more pairs"),
                std::string::npos)
          << warning->what;
    }
  }
}

TEST(Merge, BeamsThatAnInputDoubledAreNoNewsOfTheMerge) {
  ModelBuilder b;
  const Model plain = wall(0);
  for (const Vec3 p : plain.position) b.add_node(p);
  for (std::size_t e = 0; e < plain.n_elements(); ++e) {
    const auto n = plain.nodes_of(ElementId(e));
    b.add_face(n[0], n[1], n[2]);
  }
  for (int twice = 0; twice < 2; ++twice)
    for (std::size_t i = 0; i < 20; ++i) b.add_line(NodeId(10 * 21 + i), NodeId(10 * 21 + i + 1));
  const std::vector<Model> parts{scenes::plate({0.87, 0.4, -0.3}, {0, 1.2, 0}, {0, 0, 0.7}, kSize, "STIFFENER", 0.15)};
  const Merged m = merged(b.build(), parts);
  EXPECT_EQ(std::ranges::find(m.report.warnings, "doubled-line", &Warning::name), m.report.warnings.end());
}

}  // namespace
}  // namespace meshgraft
