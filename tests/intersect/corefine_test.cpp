// The situations of figure 6 of the paper, and those that real models are in.
#include "intersect/corefine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "checks.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

using scenes::plate;

struct Joined {
  std::vector<Model> models;
  GroupSets sets;
  Complex before;
  tl::expected<Corefined, JunctionFault> result;
};

Joined join(std::vector<Model> models, const CorefineOptions& options = {}) {
  Joined j{std::move(models), {}, {}, {}};
  j.before = checks::complex_of(j.models, j.sets);
  j.result = corefine(j.before, j.sets, options);
  return j;
}

/// Joins, and expects a sound result with a junction of the given length.
Joined expect_joined(std::vector<Model> models, double length, const checks::Check& check = {0.01, false}) {
  const CorefineOptions options;
  Joined j = join(std::move(models), options);
  EXPECT_TRUE(j.result.has_value()) << j.result.error().what;
  if (!j.result) return j;
  for (const std::string& fault : checks::faults(j.before, *j.result, options, check)) ADD_FAILURE() << fault;
  EXPECT_NEAR(checks::junction_length(*j.result), length, 1e-3 * length);
  return j;
}

Model face(Vec3 a, Vec3 b, Vec3 c) {
  ModelBuilder builder;
  const NodeId p = builder.add_node(a), q = builder.add_node(b), r = builder.add_node(c);
  builder.add_face(p, q, r);
  return builder.build();
}

/// One face in the plane z = 0 with a corner in the origin.
Model ground() { return face({0, 0, 0}, {4, 0, 0}, {0, 4, 0}); }
Model wall() { return plate({0, 0, 0}, {10, 0, 0}, {0, 10, 0}, 1, "WALL", 0.2); }
Model grid() { return plate({0, 0, 0}, {10, 0, 0}, {0, 10, 0}, 1, "WALL"); }

/// A wall with a rib on y = 5, one mesh.
Model ribbed() {
  return scenes::welded(scenes::together(std::array{plate({0, 0, 0}, {10, 0, 0}, {0, 5, 0}, 1, "WALL"),
                                                    plate({0, 5, 0}, {10, 0, 0}, {0, 5, 0}, 1, "WALL"),
                                                    plate({0, 5, 0}, {10, 0, 0}, {0, 0, 3}, 1, "RIB")}));
}

TEST(CorefinePair, ProperCrossing) { expect_joined({ground(), face({1, 1, -1}, {2, 1, -1}, {1.5, 1, 1})}, 0.5); }
TEST(CorefinePair, EdgeInFace) { expect_joined({ground(), face({1, 1, 0}, {2, 1, 0}, {1.5, 1, 1})}, 1); }
TEST(CorefinePair, EdgeOnEdge) { expect_joined({ground(), face({1, 0, 0}, {2, 0, 0}, {1.5, 0, 1})}, 1); }
TEST(CorefinePair, EdgeOnWholeEdge) { expect_joined({ground(), face({0, 0, 0}, {4, 0, 0}, {1.5, 0, 1})}, 4); }
TEST(CorefinePair, EdgeOverhangingAnEdge) { expect_joined({ground(), face({-1, 0, 0}, {2, 0, 0}, {1.5, 0, 1})}, 2); }
TEST(CorefinePair, CoplanarSideBySide) { expect_joined({ground(), face({1, 0, 0}, {2, -2, 0}, {3, 0, 0})}, 2); }
TEST(CorefinePair, EdgeThroughEdges) { expect_joined({ground(), face({-1, 1, 0}, {5, 1, 0}, {2, 1, 2})}, 3); }

void expect_point(const Model& part, Vec3 at) {
  const Joined j = expect_joined({ground(), part}, 0);
  ASSERT_TRUE(j.result);
  ASSERT_EQ(j.result->junction_points.size(), 1u);
  EXPECT_LT(distance(j.result->complex.position[j.result->junction_points[0].value], at), 1e-12);
  EXPECT_EQ(j.result->met.size(), 1u);
}

TEST(CorefinePair, NodeOnFace) { expect_point(face({1, 1, 0}, {1, 1.3, 1}, {1.5, 1, 1}), {1, 1, 0}); }
TEST(CorefinePair, NodeOnEdge) { expect_point(face({1, 0, 0}, {1, 0.3, 1}, {1.5, 0, 1}), {1, 0, 0}); }
TEST(CorefinePair, NodeOnNode) { expect_point(face({0, 0, 0}, {1, 0.3, 1}, {1.5, 0, 1}), {0, 0, 0}); }
TEST(CorefinePair, EdgeAcrossEdge) { expect_point(face({1, -1, -1}, {1, 1, 1}, {1, -2, 2}), {1, 0, 0}); }

TEST(CorefinePair, FacesThatMissEachOtherStayAsTheyAre) {
  const Joined j = join({ground(), face({1, 1, 0.5}, {2, 1, 0.5}, {1.5, 1, 1})});
  ASSERT_TRUE(j.result);
  EXPECT_EQ(j.result->complex.face, j.before.face);
  EXPECT_TRUE(j.result->met.empty());
}

TEST(CorefinePair, CoplanarFacesThatShareAreaAreAFaultWhereOnlyCrossingIsAskedFor) {
  CorefineOptions options;
  options.mode = Mode::kFaceEdge;
  for (const double height : {0.0, 1e-9, 0.004}) {
    const Joined j = join({ground(), face({1, 1, height}, {2, 1, height}, {1, 2, height})}, options);
    ASSERT_FALSE(j.result);
    EXPECT_EQ(j.result.error().code, ErrorCode::kOverlap);
    EXPECT_EQ(j.result.error().elements.size(), 2u);
    EXPECT_LT(distance(j.result.error().at, {1.3, 1.3, 0}), 1);
  }
}

TEST(CorefinePair, ADoublerWithinTheToleranceIsAFaultWhereOnlyCrossingIsAskedFor) {
  CorefineOptions options;
  options.mode = Mode::kFaceEdge;
  const Joined j = join({wall(), plate({2.3, 2.3, 0.006}, {4, 0, 0}, {0, 4, 0}, 0.8)}, options);
  ASSERT_FALSE(j.result);
  EXPECT_EQ(j.result.error().code, ErrorCode::kOverlap);
}

TEST(Corefine, AFreeEdgeNearTheWallIsPulledOntoIt) {
  for (const double gap : {0.0, 1e-16, -1e-16, 0.006, -0.006}) {
    const Joined j = expect_joined({wall(), plate({2.3, 4.7, gap}, {5, 0, 0}, {0, 0, 3}, 0.9)}, 5);
    for (const auto& m : j.result->moves) EXPECT_LE(distance(m.from, m.to), std::abs(gap) + 1e-12);
    EXPECT_EQ(j.result->moves.empty(), std::abs(gap) < 1e-15);  // rounding is no move
  }
}

TEST(Corefine, AFreeEdgeHalfAboveAndHalfBelowIsPulledOntoTheWall) {
  Model part = plate({2.3, 4.7, 0}, {5, 0, 0}, {0, 0, 3}, 0.9);
  for (std::size_t i = 0; i < part.n_nodes(); ++i)
    if (part.position[i].z == 0) part.position[i].z = i % 2 == 0 ? 0.005 : -0.005;
  expect_joined({wall(), part}, 5);
}

TEST(Corefine, AGapBeyondTheToleranceStaysOpen) {
  const Joined j = join({wall(), plate({2.3, 4.7, 0.02}, {5, 0, 0}, {0, 0, 3}, 0.9)});
  ASSERT_TRUE(j.result);
  EXPECT_TRUE(j.result->met.empty());
  EXPECT_TRUE(j.result->moves.empty());
}

TEST(Corefine, APartInAGridPlaneUsesTheNodesOfTheBase) {
  for (const double y : {5.0, std::nextafter(5.0, 0.0), std::nextafter(5.0, 9.0)}) {
    const Joined j = expect_joined({grid(), plate({2, y, -2}, {5, 0, 0}, {0, 0, 4}, 1)}, 5);
    EXPECT_EQ(j.result->replaced.size(), 6u);
    EXPECT_EQ(j.result->complex.n_faces(), j.before.n_faces());
    EXPECT_EQ(j.result->junction_edges.size(), 5u);
  }
}

TEST(Corefine, OtherNodesOnAGridLineSplitItsEdges) {
  expect_joined({grid(), plate({2.3, 5, -2}, {5, 0, 0}, {0, 0, 4}, 0.7)}, 5);
}

TEST(Corefine, AButtJointIsACurve) {
  const Joined same = expect_joined({grid(), plate({10, 2, 0}, {4, 0, 0}, {0, 5, 0}, 1)}, 5);
  EXPECT_EQ(same.result->replaced.size(), 6u);
  expect_joined({grid(), plate({10, 2.2, 0}, {4, 0, 0}, {0, 5, 0}, 0.7)}, 5);
  expect_joined({grid(), plate({10.004, 2.2, 0}, {4, 0, 0}, {0, 5, 0}, 0.9)}, 5);
}

TEST(Corefine, APartOnAnEdgeOrCornerOfTheBaseIsJoinedThere) {
  expect_joined({wall(), plate({2.3, 0, 0}, {5, 0, 0}, {0, 0, 3}, 0.9)}, 5);        // along the free edge
  expect_joined({wall(), plate({6.1, 4.7, 0}, {3.9, 0, 0}, {0, 0, 3}, 0.9)}, 3.9);  // up to it
  expect_joined({wall(), plate({6.1, 0, 0}, {3.9, 0, 0}, {0, 0, 3}, 0.9)}, 3.9);    // into the corner
  expect_joined({wall(), plate({7.1, 4.7, 0.007}, {5.9, 0, 0}, {0, 0, 3}, 0.9)}, 2.9);
}

TEST(Corefine, APartMeetsATLineInItsNodesAndEdges) {
  const double across = 10 + 10 + 3 + 3;
  expect_joined({ribbed(), plate({4.4, -1, -2}, {0, 12, 0}, {0, 0, 7}, 0.9)}, 10 + 3);
  expect_joined({ribbed(), plate({4.4, 1.2, 0}, {0, 3.8, 0}, {0, 0, 2}, 0.9)}, 3.8 + 2);
  expect_joined({ribbed(), plate({2.3, 5, -2}, {5, 0, 0}, {0, 0, 2}, 0.9)}, 5);  // ends on it from below
  expect_joined(
      {ribbed(), plate({4.4, -1, -2}, {0, 12, 0}, {0, 0, 7}, 0.9), plate({6.1, -1, -2}, {0, 12, 0}, {0, 0, 7}, 1)},
      across);
}

TEST(Corefine, APartThatPassesBesideANodeOfATLineIsNotDrawnAside) {
  const Joined j = expect_joined({ribbed(), plate({4.004, -1, -2}, {0, 12, 0}, {0, 0, 7}, 0.9)}, 10 + 3);
  ASSERT_TRUE(j.result);
  EXPECT_TRUE(j.result->moves.empty());
  for (const auto& edge : j.result->junction_edges)
    for (const VertexId v : edge) EXPECT_NEAR(j.result->complex.position[v.value].x, 4.004, 1e-12);
}

TEST(Corefine, ThreeComponentsShareTheirCommonPoint) {
  const Joined j = expect_joined(
      {wall(), plate({2.3, 4.7, -2}, {5, 0, 0}, {0, 0, 4}, 0.9), plate({4.6, 2.2, -2}, {0, 5, 0}, {0, 0, 4}, 0.8)},
      5 + 5 + 4);
  const std::vector<std::array<std::uint32_t, 2>> all{{0, 1}, {0, 2}, {1, 2}};
  EXPECT_EQ(j.result->met, all);
}

TEST(Corefine, ATubeThroughAPlateGivesAClosedCurve) {
  const Joined j = expect_joined({wall(), scenes::cylinder({5.1, 4.9, -2}, {5.1, 4.9, 2}, 2.3, 0.8)},
                                 2 * 2.3 * 18 * std::sin(std::numbers::pi / 18));
  std::map<VertexId, int> degree;
  for (const auto& e : j.result->junction_edges) ++degree[e[0]], ++degree[e[1]];
  for (const auto& [v, n] : degree) EXPECT_EQ(n, 2);
}

TEST(Corefine, ATubeInsideOneFaceCutsAHoleIntoIt) {
  const Joined j =
      join({face({-20, -20, 0}, {20, -20, 0}, {0, 30, 0}), scenes::cylinder({0, 0, -1}, {0, 0, 1}, 1, 0.3)});
  ASSERT_TRUE(j.result) << j.result.error().what;
  const CorefineOptions options;
  EXPECT_EQ(checks::faults(j.before, *j.result, options, {0.01, false}), std::vector<std::string>{});
}

/// A cap of a paraboloid over the middle of the wall, standing through it upside down with its top `deep` beneath.
Model cap(double deep, double slope) {
  scenes::Surface s;
  s.at = [=](double u, double v) {
    const double x = 6 * (u - 0.5), y = 6 * (v - 0.5);
    return Vec3{x + 5.2, y + 5.3, slope * std::hypot(x, y) - deep};
  };
  s.nu = s.nv = 6;
  return scenes::surface(s);
}

TEST(Corefine, SurfacesThatTouchInASpotSmallerThanTheirFacesAreAFaultThatSaysHowSmall) {
  const Joined j = join({wall(), cap(0.02, 0.1)});
  ASSERT_FALSE(j.result.has_value());
  EXPECT_EQ(j.result.error().code, ErrorCode::kOverlap);
  EXPECT_NE(j.result.error().what.find("by only 0.0"), std::string::npos) << j.result.error().what;
  EXPECT_NE(j.result.error().hint.find("deeper in"), std::string::npos);
}

TEST(Corefine, OfSuchSpotsTheDeepestIsTold) {
  const Model second = scenes::moved(cap(0.03, 0.1), [](Vec3 p) { return p + Vec3{8, 0, 0}; });
  const Joined j = join(
      {plate({0, 0, 0}, {20, 0, 0}, {0, 10, 0}, 1, "WALL", 0.2), scenes::together(std::array{cap(0.02, 0.1), second})});
  ASSERT_FALSE(j.result.has_value());
  EXPECT_GT(j.result.error().at.x, 10) << j.result.error().what;
}

/// Faces over the given points.
Model over(const std::vector<Vec3>& points, const std::vector<std::array<std::size_t, 3>>& faces) {
  ModelBuilder builder;
  std::vector<NodeId> node;
  for (const Vec3 p : points) node.push_back(builder.add_node(p));
  for (const auto& [a, b, c] : faces) builder.add_face(node[a], node[b], node[c]);
  return builder.build();
}

/// Two folds cross, and closing gaps brings places on both folds and a corner beside them onto one face: a flat spot
/// that neither mesh has.
TEST(Corefine, AFlatSpotThatClosingGapsMadeIsNoPocket) {
  const Model fold = over({{-1.1, 0, 0.11},
                           {0.12, -0.82, -0.58},
                           {0.51, 0.09, 0},
                           {0.05, 0.33, 0.6},
                           {1.67, 0.46, 0.35},
                           {2.47, 0.47, -0.12}},
                          {{0, 1, 2}, {2, 3, 0}, {4, 2, 5}});
  const Model other = over({{1.1, 0.96, -0.01}, {-4.04, -2.01, -0.07}, {-0.93, -4.86, 0.22}, {-3.07, 1.68, -0.82}},
                           {{0, 1, 2}, {1, 0, 3}});
  CorefineOptions options;
  options.tolerance = {0.015, false};
  const Joined j = join({fold, other}, options);
  ASSERT_TRUE(j.result) << j.result.error().what;
  EXPECT_EQ(checks::faults(j.before, *j.result, options, {0.02, true}), std::vector<std::string>{});
}

TEST(Corefine, SurfacesAtASmallAngleAreJoinedWhereTheSpotHoldsFaces) {
  EXPECT_TRUE(join({wall(), cap(0.15, 0.1)}).result.has_value());
  CorefineOptions crossing;
  crossing.mode = Mode::kFaceEdge;
  EXPECT_TRUE(join({wall(), cap(0.15, 0.1)}, crossing).result.has_value());
  EXPECT_TRUE(join({wall(), cap(0.02, 1)}).result.has_value());  // a corner that comes through
}

TEST(Corefine, APartThatMeetsTheBaseInFivePlacesIsJoinedInAll) {
  std::vector<Model> feet;
  for (int k = 0; k < 5; ++k) feet.push_back(plate({1.0 + 1.7 * k, 2.2, 0}, {0, 5, 0}, {0, 0, 2}, 0.8));
  expect_joined({wall(), scenes::together(feet)}, 25);
}

TEST(Corefine, LinesAreSplitWithTheirEdges) {
  ModelBuilder b;
  const NodeId p = b.add_node({0, 0, 0}), q = b.add_node({4, 0, 0}), r = b.add_node({0, 4, 0});
  b.add_face(p, q, r);
  b.add_to_group("BEAM", b.add_line(q, p));
  const Joined j = expect_joined({b.build(), face({1, -1, -1}, {1, 1, -1}, {1, 0.2, 2})}, 2.2 / 3, {0.01, true});
  const auto& lines = j.result->complex.lines;
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].ends[0], VertexId(q.value));
  EXPECT_EQ(lines[0].ends[1], lines[1].ends[0]);
  EXPECT_EQ(lines[1].ends[1], VertexId(p.value));
  EXPECT_EQ(lines[1].groups, j.before.lines[0].groups);
}

TEST(Corefine, AGapThatCannotBeClosedIsListed) {
  // The foot of the part is within the tolerance but must not move.
  Joined j{{ground(), face({1, 1, 0.004}, {1.6, 1, 0.004}, {1.3, 1, 2})}, {}, {}, {}};
  j.before = checks::complex_of(j.models, j.sets);
  for (std::size_t v = 3; v < 5; ++v) j.before.state[v] = VertexState::kFrozen;
  j.result = corefine(j.before, j.sets, {});
  ASSERT_TRUE(j.result);
  ASSERT_EQ(j.result->left_open.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const Corefined::OpenGap& gap = j.result->left_open[k];
    EXPECT_EQ(gap.at, j.before.position[3 + k]);
    EXPECT_NEAR(gap.distance, 0.004, 1e-12);
    EXPECT_EQ(gap.faces[0].input, 0u);
    EXPECT_EQ(gap.faces[1].input, 1u);
  }
}

TEST(Corefine, AGapThatIsClosedIsNotListed) {
  for (const double gap : {-0.008, -0.004, 0.0, 0.004, 0.008}) {
    const Joined j = join({wall(), plate({2.3, 4.7, gap}, {5, 0, 0}, {0, 0, 2}, 0.9)});
    ASSERT_TRUE(j.result);
    EXPECT_TRUE(j.result->left_open.empty()) << gap;
  }
}

TEST(Corefine, AFixedEdgeThatWouldBeSplitIsAFault) {
  Joined j{{ground(), face({1, -1, -1}, {1, 1, -1}, {1, 0.2, 2})}, {}, {}, {}};
  j.before = checks::complex_of(j.models, j.sets);
  j.before.fixed_edges.push_back({VertexId(std::size_t{0}), VertexId(std::size_t{1})});
  j.result = corefine(j.before, j.sets, {});
  ASSERT_FALSE(j.result);
  EXPECT_EQ(j.result.error().code, ErrorCode::kUnsupportedElement);
}

TEST(Corefine, FlatAndDoubledFacesAreFaultsOnlyAtTheJunction) {
  const auto with = [](Vec3 a, Vec3 b, Vec3 c, bool twice) {
    ModelBuilder builder;
    const NodeId p = builder.add_node(a), q = builder.add_node(b), r = builder.add_node(c);
    builder.add_face(p, q, r);
    if (twice) builder.add_face(p, q, r);
    return scenes::together(std::array{wall(), builder.build()});
  };
  const Model part = plate({2.3, 4.7, -2}, {5, 0, 0}, {0, 0, 6}, 0.9);
  const auto code = [&](const Model& base) {
    const Joined j = join({base, part});
    return j.result ? std::string("joined") : std::string(name(j.result.error().code));
  };
  EXPECT_EQ(code(with({4, 3, 2}, {4, 5, 2}, {4, 4, 2}, false)), "degenerate-face");
  EXPECT_EQ(code(with({4, 3, 2}, {4, 5, 2}, {5, 4, 2}, true)), "duplicate-face");
  EXPECT_EQ(code(with({4, 8, 2}, {4, 9, 2}, {4, 8.5, 2}, false)), "joined");
  EXPECT_EQ(code(with({4, 8, 2}, {4, 9, 2}, {5, 8.5, 2}, true)), "joined");
}

/// A mesh with face k twice, on the same nodes or on nodes of its own.
Model with_doubled_face(const Model& m, std::size_t k, bool own_nodes) {
  ModelBuilder b;
  for (const Vec3 p : m.position) b.add_node(p);
  std::array<NodeId, 3> v{};
  for (std::size_t e = 0; e < m.n_elements(); ++e) {
    std::ranges::copy(m.nodes_of(ElementId(e)), v.begin());
    b.add_face(v[0], v[1], v[2]);
  }
  std::ranges::copy(m.nodes_of(ElementId(k)), v.begin());
  if (own_nodes)
    for (NodeId& n : v) n = b.add_node(m.position[n.value]);
  b.add_face(v[0], v[1], v[2]);
  return b.build();
}

TEST(Corefine, ADoubledFaceOfEitherMeshAtTheJunctionIsNamedWithItsDouble) {
  const Model base = wall(), part = plate({2.3, 4.7, -2}, {5, 0, 0}, {0, 0, 6}, 0.9);
  const Joined sound = join({base, part});
  ASSERT_TRUE(sound.result);
  for (const std::uint32_t input : {0u, 1u}) {
    std::set<std::size_t> crossed;  // of that input
    for (std::size_t f = 0; f < sound.result->complex.n_faces(); ++f)
      if (const ElementRef p = sound.result->complex.parent[f]; p.input == input && sound.result->touched[f])
        crossed.insert(p.element.value);
    ASSERT_FALSE(crossed.empty());
    for (const std::size_t k : crossed)
      for (const bool own_nodes : {false, true}) {
        std::vector<Model> models{base, part};
        models[input] = with_doubled_face(models[input], k, own_nodes);
        const Joined j = join(models);
        ASSERT_FALSE(j.result);
        const ElementRef first{input, ElementId(k)}, second{input, ElementId(models[input].n_elements() - 1)};
        EXPECT_EQ(name(j.result.error().code), std::string("duplicate-face")) << input << ' ' << k << ' ' << own_nodes;
        EXPECT_EQ(j.result.error().elements, (std::vector<ElementRef>{first, second}));
      }
  }
}

TEST(Corefine, NewVerticesTakeTheGroupsThatAllCornersAroundThemHave) {
  std::vector<Model> models;
  ModelBuilder b;
  const std::array<NodeId, 3> v{b.add_node({0, 0, 0}), b.add_node({4, 0, 0}), b.add_node({0, 4, 0})};
  b.add_face(v[0], v[1], v[2]);
  for (const NodeId n : v) b.add_to_group("ALL", n);
  b.add_to_group("EDGE", v[0]), b.add_to_group("EDGE", v[1]);
  models.push_back(b.build());
  models.push_back(face({1, -1, -1}, {1, 1, -1}, {1, 0.2, 2}));
  const Joined j = expect_joined(std::move(models), 2.2 / 3, {0.01, true});
  std::vector<std::size_t> sizes;
  for (std::size_t k = j.before.n_vertices(); k < j.result->complex.n_vertices(); ++k)
    sizes.push_back(j.sets.members(j.result->complex.vertex_groups[k]).size());
  std::sort(sizes.begin(), sizes.end());
  EXPECT_EQ(sizes, (std::vector<std::size_t>{1, 2}));  // inside the face; on the edge
}

TEST(Corefine, TouchedFacesAreThoseThatMeet) {
  const Joined j = expect_joined({grid(), plate({2.3, 4.5, -2}, {5, 0, 0}, {0, 0, 4}, 0.9)}, 5);
  for (std::size_t f = 0; f < j.result->complex.n_faces(); ++f) {
    if (j.result->complex.component[f] != 0) continue;
    Box box;
    for (const Vec3 p : j.models[0].corners(j.result->complex.parent[f].element)) box.add(p);
    const bool meets = box.low.y < 4.5 && box.high.y > 4.5 && box.low.x < 7.3 && box.high.x > 2.3;
    const bool inside = box.low.x > 2.3 && box.high.x < 7.3;  // beside the ends of the part either may be
    if (!meets || inside) {
      EXPECT_EQ(j.result->touched[f], meets);
    }
  }
}

}  // namespace
}  // namespace meshgraft
