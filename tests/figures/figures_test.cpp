// What each figure of the paper shows.
#include "figures/figures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/components.hpp"
#include "geometry/quality.hpp"
#include "intersect/corefine.hpp"
#include "patch/paper_zone.hpp"
#include "remesh/cut.hpp"

namespace meshgraft::figures {
namespace {

MergeOptions paper() {
  MergeOptions options;
  options.method = Method::kPaper;
  return options;
}

tl::expected<Corefined, JunctionFault> corefined(const Model& a, const Model& b) {
  cut::Scene scene;
  cut::add(scene, a, 0), cut::add(scene, b, 1);
  return corefine(scene.complex, scene.groups, CorefineOptions{});
}

double worst(const std::vector<Vec3>& contour, const Corners& faces) {
  double q = 1;
  for (const auto& f : faces) q = std::min(q, aspect_ratio({contour[f[0]], contour[f[1]], contour[f[2]]}));
  return q;
}

TEST(Figure4, FaceEdgeAndFaceFaceAreToldApart) {
  for (const Configuration& c : configurations()) {
    const auto merged = merge(c.base, std::span(&c.part, 1), paper());
    ASSERT_TRUE(merged.has_value()) << c.name << to_string(merged.error());
    for (const std::string& kind : c.kinds)
      EXPECT_GE(std::ranges::count(merged->report.junction, kind, &PolylineSummary::kind), 1) << c.name << " " << kind;
    const bool lies = c.name != "stiffener";
    EXPECT_EQ(std::ranges::count(merged->report.junction, "overlap", &PolylineSummary::kind) > 0, lies) << c.name;
  }
}

TEST(Figure6, EachIncidenceIsFoundForWhatItIs) {
  for (const Incidence& i : incidences()) {
    const auto c = corefined(model_of({first_triangle()}, "A"), model_of({i.second}, "B"));
    ASSERT_TRUE(c.has_value()) << i.name << c.error().what;
    EXPECT_EQ(!c->covered.empty(), i.overlaps) << i.name;
    EXPECT_EQ(c->junction_points.size(), i.points) << i.name;
    if (i.overlaps) continue;  // its border is what counts there
    // An edge of the junction may be cut where it crosses an edge that the filling of the face made.
    EXPECT_EQ(!c->junction_edges.empty(), i.edges > 0) << i.name;
  }
}

/// Edges with faces of both groups, or more than two faces: the weld line of the result.
std::vector<double> weld_lengths(const Model& m) {
  std::map<std::set<NodeId>, int> faces;
  for (std::size_t e = 0; e < m.n_elements(); ++e)
    for (std::size_t k = 0; k < 3; ++k) ++faces[{m.nodes_of(ElementId(e))[k], m.nodes_of(ElementId(e))[(k + 1) % 3]}];
  std::vector<double> lengths;
  for (const auto& [edge, n] : faces)
    if (n > 2) lengths.push_back(distance(m.position[edge.begin()->value], m.position[edge.rbegin()->value]));
  std::ranges::sort(lengths);
  return lengths;
}

TEST(Figure7, NodesCloserThanTheMeanEdgeLengthAreDroppedAndEndsStay) {
  const auto [wall, rib] = uneven_crossing();
  const auto c = corefined(wall, rib);
  ASSERT_TRUE(c.has_value());
  double shortest = 1;
  for (const auto& e : c->junction_edges)
    shortest = std::min(shortest, distance(c->complex.position[e[0].value], c->complex.position[e[1].value]));
  const double mean = 0.5 * (paper_bandwidth(*c, 0, 1).l1a + paper_bandwidth(*c, 0, 1).l2a);
  EXPECT_LT(shortest, 0.1 * mean);

  const auto merged = merge(wall, std::span(&rib, 1), paper());
  ASSERT_TRUE(merged.has_value());
  const Model result = apply(wall, std::span(&rib, 1), *merged);
  const auto lengths = weld_lengths(result);
  EXPECT_GT(lengths.front(), 0.6 * mean);
  EXPECT_LT(lengths.back(), 1.5 * mean);
  double total = 0;
  for (const double l : lengths) total += l;
  EXPECT_NEAR(total, std::hypot(1.6, 0.73), 1e-9);  // from free edge to free edge of the rib
}

TEST(Figure8, LikeDensitiesGiveTheSameBandwidthOnBoth) {
  const auto [wall, rib] = like_density();
  const auto c = corefined(wall, rib);
  ASSERT_TRUE(c.has_value());
  const PaperBandwidth b = paper_bandwidth(*c, 0, 1);
  EXPECT_EQ(std::lround(std::max(b.l1a, b.l2a) / std::min(b.l1a, b.l2a)), 1);
  EXPECT_EQ(b.n1, b.n2);
  const double half = 0.25 * (b.l1a + b.l2a);
  EXPECT_EQ(b.n1, std::min(2L, std::lround(std::max(b.l_min, half) / std::min(b.l_min, half))));
}

TEST(Figure9, LeastAreaGivesFlatTrianglesAndBestQualityDoesNot) {
  const std::vector<Vec3> contour = wavy_contour();
  EXPECT_LT(worst(contour, of_least_area(contour)), 0.01);
  EXPECT_GT(worst(contour, of_best_quality(contour)), 0.5);
}

TEST(Figure10, FillingOptimisingAndDeformingEachDoTheirPart) {
  const Model sphere = holed_sphere();
  const auto off = [](const Merged& m) {
    double most = 0;
    for (const NewNode& n : m.graft.new_nodes) most = std::max(most, std::abs(norm(n.position) - 1));
    return most;
  };
  FillOptions options;
  options.zone.method = Method::kPaper;
  options.zone.blend = Blend::kPosition;
  const auto flat = fill(sphere, options);
  options.zone.blend = Blend::kTangency;
  const auto round = fill(sphere, options);
  options.zone.method = Method::kAdaptive;
  const auto improved = fill(sphere, options);
  ASSERT_TRUE(flat && round && improved);
  EXPECT_GT(flat->graft.new_nodes.size(), 20u);  // the density of the surroundings
  EXPECT_LT(off(*round), 0.1 * off(*flat));
  EXPECT_GE(improved->report.quality.min, 0.5);
  EXPECT_GT(improved->report.quality.mean, round->report.quality.mean);
}

}  // namespace
}  // namespace meshgraft::figures
