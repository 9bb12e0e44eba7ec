#include "merge/result_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "merge/coverage.hpp"
#include "merge/creases.hpp"
#include "merge/fidelity.hpp"
#include "merge/hand_made.hpp"
#include "merge/near_misses.hpp"
#include "merge/quality_summary.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

using testing_support::HandMade;

Model plate(Vec3 origin = {0, 0, 0}, const std::string& group = "PLATE") {
  return scenes::plate(origin, {4, 0, 0}, {0, 4, 0}, 1, group);
}

ResultVerdict verdict_of(HandMade& m) {
  m.stitch_now();
  return check_result(m.outcome(), m.translated, Tolerance{});
}

std::vector<Error> findings(HandMade& m) { return verdict_of(m).broken; }

bool says(const std::vector<Error>& errors, const std::string& words) {
  return std::ranges::any_of(errors, [&](const Error& e) {
    return e.code == ErrorCode::kPromiseBroken && e.what.find(words) != std::string::npos;
  });
}

TEST(ResultCheck, NothingIsSaidAgainstAnUntouchedModelOrAFlatSplit) {
  HandMade m({plate(), plate({0, 0, 9}, "PART")});
  EXPECT_TRUE(findings(m).empty());
  HandMade split({plate(), plate({0, 0, 9}, "PART")});
  for (const std::size_t f : {0u, 9u, 20u}) split.split_face(FaceId(f));
  EXPECT_TRUE(findings(split).empty());
}

TEST(ResultCheck, NodesPutBackWhereTheyWereLeaveTheirFreeEdgesAsTheyWere) {
  HandMade m({plate()});
  m.split_face(FaceId(std::size_t{20}));  // elsewhere
  for (NodeRef& node : m.final_complex.node) node = {};
  EXPECT_TRUE(findings(m).empty());
}

TEST(ResultCheck, AMissingFaceIsACrackAroundIt) {
  HandMade m({plate()});
  m.remove_face(FaceId(std::size_t{14}));
  const auto errors = findings(m);
  EXPECT_EQ(errors.size(), 3u);
  EXPECT_TRUE(says(errors, "is free and was not"));
}

TEST(ResultCheck, ADoubledNodeIsACrack) {
  HandMade m({plate()});
  const VertexId v = m.vertex(0, 12);
  const VertexId twin =
      m.final_complex.add_vertex(m.final_complex.position[v.value], {}, VertexState::kOpen, GroupSets::kEmpty);
  for (auto& face : m.final_complex.face)
    if (std::ranges::find(face, v) != face.end()) {
      std::ranges::replace(face, v, twin);
      break;
    }
  EXPECT_TRUE(says(findings(m), "is free and was not"));
}

TEST(ResultCheck, ACutBackFreeEdgeIsNoticed) {
  HandMade m({plate()});
  const VertexId corner = m.vertex(0, 0);
  for (std::size_t f = m.final_complex.n_faces(); f-- > 0;)
    if (std::ranges::find(m.final_complex.face[f], corner) != m.final_complex.face[f].end()) m.remove_face(FaceId(f));
  EXPECT_TRUE(says(findings(m), "is gone"));
}

TEST(ResultCheck, ResamplingAFreeEdgeIsNoCrack) {
  HandMade m({plate()});
  // Node 2 slides along the border y = 0.
  m.final_complex.position[m.vertex(0, 2).value].x += 0.1;
  EXPECT_TRUE(findings(m).empty());
}

TEST(ResultCheck, ATurnedFaceIsNoticed) {
  HandMade m({plate()});
  std::swap(m.final_complex.face[7][0], m.final_complex.face[7][1]);
  EXPECT_TRUE(says(findings(m), "is turned against element"));
}

TEST(ResultCheck, AFaceInOtherGroupsThanItsParentIsNoticed) {
  HandMade m({plate()});
  m.split_face(FaceId(std::size_t{3}));
  m.final_complex.face_groups.back() = GroupSets::kEmpty;
  EXPECT_TRUE(says(findings(m), "is not in the groups of element"));
}

TEST(ResultCheck, FacesThatIntersectAreNamedWithLabelsAndPlace) {
  HandMade m({plate(), plate({0, 0, 0.5}, "PART")});
  const VertexId c = m.split_face(FaceId(std::size_t{5}));
  m.final_complex.position[c.value].z = 1;
  const auto errors = findings(m);
  ASSERT_TRUE(says(errors, "intersect"));
  EXPECT_TRUE(says(errors, "new element "));
}

TEST(ResultCheck, IntersectionsThatTheInputHadAreNotHeldAgainstTheMerge) {
  const std::array<Model, 2> crossing{plate(), scenes::plate({0.3, 2.2, -1}, {3, 0, 0}, {0, 0, 2}, 1, "RIB")};
  HandMade m({scenes::together(crossing)});
  m.split_face(FaceId(std::size_t{18}));  // the rib passes through it
  const ResultVerdict verdict = verdict_of(m);
  EXPECT_TRUE(verdict.broken.empty());
  ASSERT_EQ(verdict.warnings.size(), 1u);
  EXPECT_EQ(verdict.warnings[0].name, "input-intersects");
}

TEST(ResultCheck, FacesThatTheInputHasTwiceAreNamedWhereTheyAreBesideNewOnes) {
  Model twice = plate();
  ModelBuilder builder;
  for (const Vec3 p : twice.position) builder.add_node(p);
  for (std::size_t e = 0; e < twice.n_elements(); ++e) {
    const auto n = twice.nodes_of(ElementId(e));
    builder.add_face(n[0], n[1], n[2]);
    if (e == 6) builder.add_face(n[0], n[1], n[2]);
  }
  const Model model = builder.build("twice");
  HandMade far({model});
  far.split_face(FaceId(std::size_t{32}));
  EXPECT_TRUE(verdict_of(far).warnings.empty());
  HandMade beside({model});
  beside.split_face(FaceId(std::size_t{5}));
  const ResultVerdict verdict = verdict_of(beside);
  EXPECT_TRUE(verdict.broken.empty());
  ASSERT_EQ(verdict.warnings.size(), 1u);
  EXPECT_EQ(verdict.warnings[0].name, "doubled-face");
}

TEST(ResultCheck, TwoFacesOnTheSameNodesAreNoticed) {
  HandMade m({plate()});
  const Complex like = m.final_complex;
  m.final_complex.add_face(like.face[6], like, FaceId(std::size_t{7}));
  EXPECT_TRUE(says(findings(m), "are on the same nodes"));
}

TEST(ResultCheck, AFaceFoldedOntoItsNeighbourIsNoticed) {
  for (const double degrees : {0.5, 5.0}) {
    HandMade m({plate()});
    const VertexId c = m.split_face(FaceId(std::size_t{12}));
    const Triangle t = m.final_complex.corners(FaceId(std::size_t{12}));  // c is its last corner
    const Vec3 foot = midpoint(t[0], t[1]);
    const Vec3 beyond = foot - t[2];
    m.final_complex.position[c.value] = foot + beyond + Vec3{0, 0, norm(beyond) * degrees / 57.3};
    EXPECT_EQ(says(findings(m), "is folded onto"), degrees < 1);
  }
}

TEST(ResultCheck, BeamsThatCameToLieOnEachOtherAreNoticed) {
  ModelBuilder b;
  for (const double x : {0.0, 1.0, 2.0, 3.0}) b.add_node({x, 0, 0}), b.add_node({x, 1, 0});
  for (std::size_t k = 0; k < 6; k += 2)
    b.add_face(NodeId(k), NodeId(k + 2), NodeId(k + 1)), b.add_face(NodeId(k + 1), NodeId(k + 2), NodeId(k + 3));
  for (std::size_t k = 0; k < 6; k += 2) b.add_line(NodeId(k), NodeId(k + 2));
  b.add_line(NodeId(0), NodeId(2));  // two on one edge, as an input may have them
  const Model model = b.build();
  HandMade as_it_was({model});
  EXPECT_TRUE(findings(as_it_was).empty());
  HandMade m({model});
  m.final_complex.lines[1].ends = m.final_complex.lines[2].ends;
  EXPECT_TRUE(says(findings(m), "are on the same nodes"));
}

TEST(ResultCheck, LongListsAreCutShortWithACount) {
  HandMade m({plate()});
  for (auto& v : m.final_complex.face) std::swap(v[0], v[1]);
  const auto errors = findings(m);
  EXPECT_TRUE(says(errors, "22 more findings like the last one"));
}

TEST(Fidelity, NodesLiftedOffTheSurfaceAreMeasured) {
  HandMade m({plate()});
  const VertexId c = m.split_face(FaceId(std::size_t{5}));
  m.final_complex.position[c.value].z = 0.25;
  m.stitch_now();
  const FidelityVerdict verdict = fidelity_of(m.outcome(), Tolerance{});
  EXPECT_NEAR(verdict.figures.max_distance, 0.25, 1e-12);
  EXPECT_GT(verdict.figures.max_distance_relative, 0.2);
  ASSERT_EQ(verdict.broken.size(), 1u);
  EXPECT_TRUE(says(verdict.broken, "off the input surface"));
}

TEST(Fidelity, FlatSplitsAreOnTheSurface) {
  HandMade m({plate()});
  m.split_face(FaceId(std::size_t{5}));
  m.stitch_now();
  const FidelityVerdict verdict = fidelity_of(m.outcome(), Tolerance{});
  EXPECT_EQ(verdict.figures.max_distance, 0);
  EXPECT_TRUE(verdict.broken.empty());
}

TEST(Creases, AFoldOfNewFacesIsToldWhereTheInputHasNone) {
  for (const double height : {0.1, 0.5}) {  // of a node over a face with edges of about 1: folds of 26 and 96 degrees
    HandMade m({plate()});
    const VertexId c = m.split_face(FaceId(std::size_t{12}));
    m.final_complex.position[c.value].z = height;
    m.stitch_now();
    const std::vector<Warning> told = crease_warnings(m.outcome());
    ASSERT_EQ(told.size(), height > 0.1 ? 1u : 0u);
    if (told.empty()) continue;
    EXPECT_EQ(told[0].name, "new-crease");
    EXPECT_NE(told[0].what.find(" others, by less"), std::string::npos) << told[0].what;
  }
}

TEST(Creases, EdgesThatWereSharpOrThatNoNewFaceHasAreNone) {
  Model bent = plate();
  for (Vec3& p : bent.position) p.z = p.x > 2 ? p.x - 2 : 0;  // along x = 2, by 45 degrees
  HandMade beside({bent});
  for (std::size_t f = 0; f < bent.n_elements(); ++f) beside.split_face(FaceId(f));
  beside.stitch_now();
  EXPECT_TRUE(crease_warnings(beside.outcome()).empty());
  HandMade elsewhere({bent});
  elsewhere.split_face(FaceId(std::size_t{0}));
  elsewhere.stitch_now();
  EXPECT_TRUE(crease_warnings(elsewhere.outcome()).empty());
}

TEST(Coverage, FlatSplitsCoverWhatWasThere) {
  HandMade m({plate()});
  m.split_face(FaceId(std::size_t{5}));
  m.stitch_now();
  const CoverageVerdict verdict = coverage_of(m.outcome(), Tolerance{});
  EXPECT_EQ(verdict.figures.max_distance, 0);
  EXPECT_TRUE(verdict.broken.empty());
}

TEST(Coverage, ABulgeFilledFlatIsMeasuredFromItsTop) {
  Model bulged = plate();
  bulged.position[12].z += 0.4;
  HandMade m({bulged});
  const VertexId top = m.vertex(0, 12);
  m.final_complex.position[top.value].z = 0, m.final_complex.node[top.value] = {};
  m.stitch_now();
  const CoverageVerdict verdict = coverage_of(m.outcome(), Tolerance{});
  EXPECT_NEAR(verdict.figures.max_distance, 0.4, 1e-12);
  EXPECT_EQ(verdict.figures.at.z, 0.4);
  ASSERT_FALSE(verdict.broken.empty());
  EXPECT_TRUE(says(verdict.broken, "the surface of element"));
}

TEST(Coverage, AFaceInOtherGroupsThanTheSurfaceBeneathIsNoticed) {
  HandMade m({plate()});
  m.split_face(FaceId(std::size_t{5}));
  m.final_complex.face_groups.back() = GroupSets::kEmpty;
  m.stitch_now();
  EXPECT_TRUE(says(coverage_of(m.outcome(), Tolerance{}).broken, "is not where the input has its groups"));
}

TEST(Coverage, GroupsThatNoNewFaceHasAreNoticed) {
  HandMade m({plate()});
  m.split_face(FaceId(std::size_t{5}));
  for (const std::size_t f : {std::size_t{5}, m.final_complex.n_faces() - 2, m.final_complex.n_faces() - 1})
    m.final_complex.face_groups[f] = GroupSets::kEmpty;
  m.stitch_now();
  EXPECT_TRUE(says(coverage_of(m.outcome(), Tolerance{}).broken, "no new face has its groups"));
}

TEST(NearMisses, AreSaidToNeedALargerToleranceOnlyBeyondIt) {
  constexpr double kGap = 0.1;
  HandMade m({plate(), scenes::plate({0.5, 1.3, kGap}, {3, 0, 0}, {0, 0, 2}, 1, "STIFFENER")});
  m.stitch_now();
  const auto told = [&](double tolerance) {
    const auto warnings = near_miss_warnings(m.outcome(), {tolerance, false});
    EXPECT_EQ(warnings.size(), 1u);
    return warnings.empty() ? std::string() : warnings.front().what;
  };
  EXPECT_NE(told(0.9 * kGap).find("a larger --tolerance may join them"), std::string::npos);
  EXPECT_NE(told(1.1 * kGap).find("within the --tolerance"), std::string::npos);
}

TEST(Quality, FacesThatAreKeptCountWhereAMovedNodeHasMadeThemPoor) {
  constexpr double kWanted = 0.5;
  HandMade m({plate()});
  const VertexId v = m.vertex(0, 2);  // on the border y = 0
  const Vec3 from = m.final_complex.position[v.value];
  const auto quality_at = [&](Vec3 to) {
    m.final_complex.position[v.value] = m.corefined.complex.position[v.value] = to;
    m.corefined.moves = {{m.original.node[v.value], v, from, to}};
    m.stitch_now();
    return quality_of(m.outcome(), {}, kWanted);
  };
  EXPECT_EQ(quality_at(from + Vec3{0.1, 0, 0}).summary.below, 0u);
  const QualityVerdict poor = quality_at(from + Vec3{0.8, 0, 0});
  EXPECT_TRUE(std::ranges::all_of(m.stitched.new_element, [](auto e) { return e == Stitched::kKept; }));
  ASSERT_EQ(poor.broken.size(), 1u);
  EXPECT_GT(poor.summary.below, 0u);
  EXPECT_LT(poor.summary.min, kWanted);
  EXPECT_TRUE(says(poor.broken, "that stay"));
  EXPECT_TRUE(says(poor.broken, "a node of it was moved"));
}

TEST(Quality, PoorFacesBreakThePromiseUnlessAnInputAngleIsTheCause) {
  HandMade m({plate()});
  m.split_face(FaceId(std::size_t{5}));
  m.stitch_now();
  std::vector<BadFace> bad;
  for (std::size_t f = 0; f < m.final_complex.n_faces(); ++f)
    if (m.stitched.new_element[f] != Stitched::kKept)
      bad.push_back({FaceId(f), 0.3, {Cause::Kind::kZoneEnd, "boundary of the zone too near"}});
  const QualityVerdict poor = quality_of(m.outcome(), bad, 0.5);
  EXPECT_EQ(poor.summary.faces, 3u);
  EXPECT_EQ(poor.summary.below, 1u);
  EXPECT_LT(poor.summary.min, 0.5);
  EXPECT_EQ(poor.summary.worst.size(), 3u);
  EXPECT_EQ(poor.summary.worst[0].q, poor.summary.min);
  ASSERT_EQ(poor.broken.size(), 1u);
  EXPECT_TRUE(says(poor.broken, "boundary of the zone too near"));
  for (BadFace& b : bad) b.cause = {Cause::Kind::kInputAngle, "input angle of 9 degrees"};
  const QualityVerdict excused = quality_of(m.outcome(), bad, 0.5);
  EXPECT_TRUE(excused.broken.empty());
  EXPECT_EQ(excused.warnings.size(), 1u);
  // What no angle excuses is no matter of the size either.
  for (BadFace& b : bad) b.q = 0.01;
  const QualityVerdict narrow = quality_of(m.outcome(), bad, 0.5);
  ASSERT_EQ(narrow.broken.size(), 1u);
  EXPECT_NE(narrow.broken[0].hint.find("no --size or --bandwidth"), std::string::npos) << narrow.broken[0].hint;
}

}  // namespace
}  // namespace meshgraft
