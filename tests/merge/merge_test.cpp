// The whole pipeline: laws that every merge keeps, whatever the scene.
#include "meshgraft/merge.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "geometry/quality.hpp"
#include "meshgraft/check.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

constexpr double kSize = 0.1;

Model wall(double jitter = 0.15) { return scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, kSize, "WALL", jitter); }

Model stiffener(double x0, double x1, double y, double below, double above, double size = kSize,
                const std::string& group = "STIFFENER") {
  return scenes::plate({x0, y, -below}, {x1 - x0, 0, 0}, {0, 0, below + above}, size, group, 0.15);
}

Merged merged(const Model& base, const std::vector<Model>& parts, const MergeOptions& options = {}) {
  Result<Merged> result = merge(base, parts, options);
  if (!result) throw std::runtime_error(to_string(result.error()));
  return std::move(*result);
}

std::map<std::int64_t, ElementId> elements_by_label(const Model& m) {
  std::map<std::int64_t, ElementId> all;
  for (std::size_t e = 0; e < m.n_elements(); ++e) all[m.element_label[e]] = ElementId(e);
  return all;
}

std::map<std::int64_t, NodeId> nodes_by_label(const Model& m) {
  std::map<std::int64_t, NodeId> all;
  for (std::size_t n = 0; n < m.n_nodes(); ++n) all[m.node_label[n]] = NodeId(n);
  return all;
}

std::set<std::string> names(const Model& m, GroupSetId set) {
  std::set<std::string> all;
  for (const GroupId g : m.group_sets.members(set)) all.insert(m.groups[g.value].name);
  return all;
}

/// (1), (3) of merge(): what is kept is the same, what is new is like its parent.
void expect_laws(const Model& base, const std::vector<Model>& parts, const Merged& m) {
  for (const Error& e : m.report.broken_promises) ADD_FAILURE() << to_string(e);
  const Model result = apply(base, parts, m);
  EXPECT_TRUE(check(result).sound());
  EXPECT_EQ(check(result).n_orphan_nodes, 0u);
  const auto nodes = nodes_by_label(result);
  const auto elements = elements_by_label(result);
  EXPECT_EQ(nodes.size(), result.n_nodes());  // labels are unique
  EXPECT_EQ(elements.size(), result.n_elements());

  const std::set<NodeId> removed_nodes(m.graft.removed_nodes[0].begin(), m.graft.removed_nodes[0].end());
  for (std::size_t n = 0; n < base.n_nodes(); ++n) {
    const auto it = nodes.find(base.node_label[n]);
    ASSERT_EQ(it == nodes.end(), removed_nodes.contains(NodeId(n)));
    if (it != nodes.end()) {
      EXPECT_EQ(result.position[it->second.value], base.position[n]);
    }
  }
  const std::set<ElementId> removed(m.graft.removed_elements[0].begin(), m.graft.removed_elements[0].end());
  for (std::size_t e = 0; e < base.n_elements(); ++e) {
    const auto it = elements.find(base.element_label[e]);
    ASSERT_EQ(it == elements.end(), removed.contains(ElementId(e)));
    if (it == elements.end()) continue;
    EXPECT_EQ(names(result, result.element_groups[it->second.value]), names(base, base.element_groups[e]));
    EXPECT_EQ(result.attributes_of(it->second), base.attributes_of(ElementId(e)));
    const auto before = base.nodes_of(ElementId(e)), after = result.nodes_of(it->second);
    for (std::size_t k = 0; k < before.size(); ++k)
      EXPECT_EQ(result.node_label[after[k].value], base.node_label[before[k].value]);
  }
  for (std::size_t i = 0; i < m.graft.new_elements.size(); ++i) {
    const NewElement& e = m.graft.new_elements[i];
    const Model& from = e.parent.input == 0 ? base : parts[e.parent.input - 1];
    const ElementId id = elements.at(m.labels.first_new_element + static_cast<std::int64_t>(i));
    EXPECT_EQ(names(result, result.element_groups[id.value]), names(from, from.element_groups[e.parent.element.value]));
    EXPECT_EQ(result.attributes_of(id), from.attributes_of(e.parent.element));
  }
}

TEST(Merge, ACrossingPlateKeepsAllPromises) {
  const Model base = wall();
  const std::vector<Model> parts{stiffener(0.33, 1.61, 0.97, 0.31, 0.43)};
  const Merged m = merged(base, parts);
  expect_laws(base, parts, m);
  ASSERT_EQ(m.report.junction.size(), 1u);
  EXPECT_NEAR(m.report.junction[0].length, 1.28, 1e-9);
  EXPECT_GE(m.report.quality.min, 0.5);
}

TEST(Merge, APlateThatEndsOnTheWallKeepsAllPromises) {
  const Model base = wall();
  const std::vector<Model> parts{stiffener(0.33, 1.61, 0.97, 0, 0.43)};
  const Merged m = merged(base, parts);
  expect_laws(base, parts, m);
  EXPECT_GE(m.report.quality.min, 0.5);
}

TEST(Merge, ARibOnACylinderStaysOnItsSurface) {
  const Model base = scenes::cylinder({0, 0, 0}, {0, 0, 2}, 0.7, kSize);
  const std::vector<Model> parts{scenes::plate({0.45, 0.11, 0.31}, {0.7, 0, 0}, {0, 0, 1.3}, kSize, "RIB", 0.15)};
  const Merged m = merged(base, parts);
  expect_laws(base, parts, m);
  EXPECT_LT(m.report.fidelity.max_distance_relative, 0.1);
}

TEST(Merge, TwoPartsThatCrossEachOtherAndTheWallMeetInOneNode) {
  const Model base = wall();
  const std::vector<Model> parts{stiffener(0.33, 1.61, 0.97, 0.31, 0.43),
                                 scenes::plate({0.91, 0.4, 0}, {0, 1.2, 0}, {0, 0, 0.35}, 0.09, "SECOND", 0.15)};
  const Merged m = merged(base, parts);
  expect_laws(base, parts, m);
  const Model result = apply(base, parts, m);
  std::map<NodeId, std::set<std::string>> around;
  for (std::size_t e = 0; e < result.n_elements(); ++e)
    for (const NodeId n : result.nodes_of(ElementId(e))) around[n].merge(names(result, result.element_groups[e]));
  EXPECT_TRUE(std::ranges::any_of(around, [](const auto& n) { return n.second.size() == 3; }));
}

TEST(Merge, RandomStandingPlatesKeepAllPromises) {
  EXPECT_TRUE(rc::check([] {
    const auto unit = [] { return *rc::gen::inRange(0, 1000) / 1000.0; };
    const double x0 = 0.15 + 0.5 * unit(), x1 = x0 + 0.4 + 0.7 * unit(), y = 0.3 + 1.4 * unit();
    const bool ends = *rc::gen::arbitrary<bool>();
    const double size = kSize * (0.6 + 0.8 * unit());
    const Model base = wall(0.2 * unit());
    const std::vector<Model> parts{stiffener(x0, x1, y, ends ? 0 : 0.3, 0.43, size)};
    const Result<Merged> m = merge(base, parts);
    RC_ASSERT(m.has_value());
    RC_LOG(m->report.broken_promises.empty() ? "" : to_string(m->report.broken_promises.front()));
    RC_ASSERT(m->report.broken_promises.empty());
    expect_laws(base, parts, *m);
  }));
}

TEST(Merge, IsTheSameTwice) {
  const Model base = wall();
  const std::vector<Model> parts{stiffener(0.33, 1.61, 0.97, 0.31, 0.43)};
  const Model a = apply(base, parts, merged(base, parts)), b = apply(base, parts, merged(base, parts));
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.element_label, b.element_label);
  EXPECT_EQ(a.element_groups, b.element_groups);
}

TEST(Merge, SwappingTheInputsKeepsTheSizeOfEverything) {
  const Model wall_model = wall(), part = stiffener(0.33, 1.61, 0.97, 0.31, 0.43);
  const Merged a = merged(wall_model, {part}), b = merged(part, {wall_model});
  EXPECT_NEAR(a.report.junction.at(0).length, b.report.junction.at(0).length, 1e-9);
  EXPECT_EQ(a.report.junction[0].nodes, b.report.junction[0].nodes);
  ASSERT_EQ(b.report.groups.size(), 2u);
  EXPECT_EQ(a.report.groups[0].name, b.report.groups[1].name);
  EXPECT_NEAR(a.report.groups[0].area_after, b.report.groups[1].area_after, 1e-9);
}

TEST(Merge, BeamsAlongACrossedEdgeAreRebuiltWithTheirGroups) {
  Model plain = wall(0);
  ModelBuilder b;
  for (const Vec3 p : plain.position) b.add_node(p);
  for (std::size_t e = 0; e < plain.n_elements(); ++e) {
    const auto n = plain.nodes_of(ElementId(e));
    b.add_face(n[0], n[1], n[2]);
  }
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
  ModelBuilder b;
  for (const Vec3 p : plain.position) b.add_node(p);
  for (std::size_t e = 0; e < plain.n_elements(); ++e) {
    const auto n = plain.nodes_of(ElementId(e));
    b.add_face(n[0], n[1], n[2]);
  }
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
    ModelBuilder b;
    for (const Vec3 p : near.position) b.add_node(p);
    for (std::size_t e = 0; e < near.n_elements(); ++e) {
      const auto n = near.nodes_of(ElementId(e));
      b.add_face(n[0], n[1], n[2]);
    }
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

TEST(Merge, ExplicitNodesStayAndCoveringGroupsStillCover) {
  Model plain = wall(0);
  ModelBuilder b;
  for (const Vec3 p : plain.position) b.add_node(p);
  for (std::size_t e = 0; e < plain.n_elements(); ++e) {
    const auto n = plain.nodes_of(ElementId(e));
    b.add_to_group("WALL", b.add_face(n[0], n[1], n[2]));
  }
  for (std::size_t n = 0; n < plain.n_nodes(); ++n) b.add_to_group("ALL", NodeId(n));
  const NodeId bolt(10 * 21 + 9);  // at (0.9, 1), close to the junction
  b.add_to_group("BOLT", bolt);
  const Model base = b.build();
  const std::vector<Model> parts{stiffener(0.33, 1.61, 0.96, 0.31, 0.43)};
  const Merged m = merged(base, parts);
  expect_laws(base, parts, m);
  const Model result = apply(base, parts, m);
  std::set<std::string> at_bolt;
  for (std::size_t n = 0; n < result.n_nodes(); ++n)
    if (result.node_label[n] == base.node_label[bolt.value]) at_bolt = names(result, result.node_groups[n]);
  EXPECT_EQ(at_bolt, (std::set<std::string>{"ALL", "BOLT"}));
  for (std::size_t e = 0; e < result.n_elements(); ++e) {
    if (!names(result, result.element_groups[e]).contains("WALL")) continue;
    for (const NodeId n : result.nodes_of(ElementId(e))) {
      EXPECT_TRUE(names(result, result.node_groups[n.value]).contains("ALL"));
    }
  }
  for (const GroupEntry& g : m.report.groups) EXPECT_TRUE(g.name != "BOLT" || g.members_after == 1);
}

TEST(Merge, AnOldTLineOfTheBaseIsCrossedAndStays) {
  const std::array<Model, 3> pieces{scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "WALL"),
                                    scenes::plate({0, 1, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "WALL"),
                                    scenes::plate({0, 1, 0}, {2, 0, 0}, {0, 0, 0.4}, kSize, "RIB")};
  const Model base = scenes::welded(scenes::together(pieces));
  const std::vector<Model> parts{
      scenes::plate({0.87, 0.33, -0.31}, {0, 1.38, 0}, {0, 0, 0.94}, kSize, "STIFFENER", 0.15)};
  expect_laws(base, parts, merged(base, parts));
}

TEST(Merge, APartSharingNodesWithTheBaseIsJoinedThere) {
  const Model base = wall(0);
  const std::vector<Model> parts{scenes::plate({0.3, 1, 0}, {1.2, 0, 0}, {0, 0, 0.7}, kSize, "STIFFENER")};
  const Merged m = merged(base, parts);
  expect_laws(base, parts, m);
  EXPECT_NEAR(m.report.junction.at(0).length, 1.2, 1e-9);
}

TEST(Merge, AShortPartIsPulledOntoTheWallAndEachMoveIsReported) {
  const double gap = 0.004 * kSize;
  const Model base = wall();
  std::vector<Model> parts{stiffener(0.33, 1.61, 0.97, 0, 0.43)};
  parts[0] = scenes::moved(parts[0], [=](Vec3 p) { return p + Vec3{0, 0, gap}; });
  const Merged m = merged(base, parts);
  expect_laws(base, parts, m);
  for (const MovedEntry& moved : m.report.moved) {
    EXPECT_EQ(moved.input, 1u);
    EXPECT_NEAR(moved.distance, gap, 1e-12);
  }
  // The whole foot, also the nodes that the remeshing has taken away.
  const auto of_foot = [&](Vec3 p) { return p.z == gap; };
  EXPECT_EQ(m.report.moved.size(), static_cast<std::size_t>(std::ranges::count_if(parts[0].position, of_foot)));
}

TEST(Merge, ALeaningPartThatEndsShortOfTheWallIsExtendedInItsOwnPlane) {
  const double lean = 0.8, gap = 0.4 * kSize;
  const Vec3 up{0, std::cos(lean), std::sin(lean)}, normal{0, -std::sin(lean), std::cos(lean)};
  const Model base = wall();
  const std::vector<Model> parts{
      scenes::staggered_plate({0.33, 0.97, gap}, {1.28, 0, 0}, 0.43 * up, kSize, "PART", 0.15)};
  MergeOptions options;
  options.tolerance = {0.5 * kSize, false};
  const Merged m = merged(base, parts, options);
  EXPECT_TRUE(m.report.broken_promises.empty());
  ASSERT_FALSE(m.report.moved.empty());
  for (const MovedEntry& moved : m.report.moved) {
    EXPECT_NEAR(dot(moved.to - moved.from, normal), 0, 1e-12);
    EXPECT_NEAR(moved.to.z, 0, 1e-12);
  }
  const auto part = std::ranges::find(m.report.groups, "PART", &GroupEntry::name);
  EXPECT_NEAR(part->area_after - part->area_before, 1.28 * gap / std::sin(lean), 1e-9);
  EXPECT_NE(part->rule.find("stretched over gaps"), std::string::npos);
}

TEST(Merge, ABaseThatEndsShortOfAPartIsToldToBeThePart) {
  const std::vector<Model> parts{wall()};
  const Model base = scenes::staggered_plate({0.33, 0.97, 0.4 * kSize}, {1.28, 0, 0}, {0, 0, 0.43}, kSize, "STIFFENER");
  MergeOptions options;
  options.tolerance = {0.5 * kSize, false};
  const auto result = merge(base, parts, options);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kPartsApart);
  EXPECT_NE(result.error().hint.find("never moved"), std::string::npos) << result.error().hint;
}

TEST(Merge, CoarseTubesKeepTheirSurfaceAndTheirEnds) {
  // Facets that turn by 13, 21 and 24 degrees, of faces that are all Q 0.72.
  const Model base = scenes::cylinder({0, 0, 0}, {0, 0, 2}, 0.45, kSize, "RUN");
  const std::vector<Model> parts{scenes::cylinder({-1, 0.03, 1.04}, {1, 0.03, 1.04}, 0.3, 0.11, "BRANCH"),
                                 scenes::cylinder({0.02, -1, 0.95}, {0, 1, 0.95}, 0.25, 0.105, "BRANCH_2")};
  const Merged m = merged(base, parts);
  for (const Error& e : m.report.broken_promises) ADD_FAILURE() << to_string(e);
  EXPECT_LE(m.report.fidelity.max_distance_relative, 0.085);
  EXPECT_GE(m.report.quality.min, 0.5);
  EXPECT_GE(m.report.quality.mean, 0.83);
}

TEST(Merge, AnEndNearTheJunctionKeepsItsShape) {
  // A pipe of 20 facets through a wall of 40, askew: the end inside is three rows from the junction.
  const auto run = [](double u, double v) {
    const double a = 2 * std::numbers::pi * u;
    return Vec3{50 * std::cos(a), 50 * std::sin(a), 400 * v - 200};
  };
  const auto branch = [](double u, double v) {
    const double a = 2 * std::numbers::pi * u, along = 200 * v / std::numbers::sqrt2,
                 across = 35 * std::sin(a) / std::numbers::sqrt2;
    return Vec3{along - across, 35 * std::cos(a), along + across};
  };
  const Model base = scenes::surface({run, 40, 30, true, false, 0, 1, "RUN"});
  const Merged m = merged(base, {scenes::surface({branch, 20, 15, true, false, 0, 1, "BRANCH"})});
  for (const Error& e : m.report.broken_promises) ADD_FAILURE() << to_string(e);
  EXPECT_GE(m.report.quality.min, 0.5);
}

TEST(Merge, EdgesThatNearlyMeetAreNamed) {
  // Two stiffeners, one of them short of the wall by less, or more, than a quarter of an edge; or standing off it.
  const auto misses = [](double short_by) {
    const std::vector<Model> both{stiffener(0.4, 1.6, 0.72, 0.3, 0.4), stiffener(0.4, 1.6, 1.12, -short_by, 0.4)};
    const Merged m = merged(wall(), {scenes::together(both)});
    return std::ranges::count(m.report.warnings, "near-miss", &Warning::name);
  };
  EXPECT_EQ(misses(0.02), 1);
  EXPECT_EQ(misses(0.04), 0);
  EXPECT_EQ(misses(0), 0);
}

TEST(Merge, PartsApartAreAnErrorUnlessAllowed) {
  const Model base = wall();
  const std::vector<Model> parts{stiffener(0.33, 1.61, 0.97, 0.31, 0.43), stiffener(0.3, 1.2, 0.5, -1, 1.5)};
  const auto result = merge(base, parts);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kPartsApart);
  MergeOptions options;
  options.allow_apart = true;
  const Merged m = merged(base, parts, options);
  expect_laws(base, parts, m);
  ASSERT_FALSE(m.report.warnings.empty());
  EXPECT_EQ(m.report.warnings.back().name, "parts-apart");
  const Merged alone = merged(base, {parts[1]}, options);
  EXPECT_TRUE(alone.graft.removed_elements[0].empty());
  EXPECT_EQ(apply(base, std::vector{parts[1]}, alone).n_elements(), base.n_elements() + parts[1].n_elements());
}

TEST(Merge, PartsWithoutFacesAreRefused) {
  const Model base = wall();
  ModelBuilder b;
  b.add_line(b.add_node({0, 0, 0}), b.add_node({1, 0, 0}));
  EXPECT_EQ(merge(base, std::vector{b.build()}).error().code, ErrorCode::kNoFaces);
}

TEST(Merge, TheReportIsValidJsonAndAddsUp) {
  const Model base = wall();
  const std::vector<Model> parts{stiffener(0.33, 1.61, 0.97, 0.31, 0.43)};
  std::vector<std::string> stages;
  MergeOptions options;
  options.progress = [&](std::string_view stage, double done) {
    EXPECT_TRUE(done >= 0 && done <= 1);
    stages.emplace_back(stage);
  };
  const Merged m = merged(base, parts, options);
  EXPECT_FALSE(stages.empty());
  EXPECT_EQ(stages.size(), m.report.timings.size());
  const auto json = nlohmann::json::parse(to_json(m.report));
  const std::uint64_t before = base.n_elements() + parts[0].n_elements();
  EXPECT_EQ(json["zone"]["faces_removed"].get<std::uint64_t>() + json["untouched"]["elements"].get<std::uint64_t>(),
            before);
  EXPECT_EQ(json["quality"]["faces"], json["zone"]["faces_created"]);
  EXPECT_EQ(json["inputs"].size(), 2u);
  EXPECT_EQ(json["labels"].size(), m.labels.shifted_nodes[1].size() + m.labels.shifted_elements[1].size());
}

}  // namespace
}  // namespace meshgraft
