// What each figure of the paper shows.
#include "figures/figures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/components.hpp"
#include "geometry/closest.hpp"
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

double distance_to(Vec3 p, const std::vector<std::array<Vec3, 2>>& lines) {
  double least = 10;
  for (const auto& [a, b] : lines) least = std::min(least, distance(p, closest_on_segment(p, a, b).point));
  return least;
}

double length_of(const std::vector<std::array<Vec3, 2>>& lines) {
  double sum = 0;
  for (const auto& [a, b] : lines) sum += distance(a, b);
  return sum;
}

TEST(Figure6, EachIncidenceIsFoundForWhatItIs) {
  constexpr double kRounding = 1e-12;
  for (const Incidence& i : incidences()) {
    const auto c = corefined(model_of({first_triangle()}, "A"), model_of({i.second}, "B"));
    ASSERT_TRUE(c.has_value()) << i.name << c.error().what;
    const auto at = [&](VertexId v) { return c->complex.position[v.value]; };
    EXPECT_EQ(!c->covered.empty(), i.overlaps) << i.name;
    ASSERT_EQ(c->junction_points.size(), i.points.size()) << i.name;
    for (std::size_t k = 0; k < i.points.size(); ++k) EXPECT_EQ(at(c->junction_points[k]), i.points[k]) << i.name;
    // All of the lines, and nothing else. They may be in pieces: the face that is cut has inner edges.
    std::vector<std::array<Vec3, 2>> found;
    for (const auto& e : c->junction_edges) found.push_back({at(e[0]), at(e[1])});
    EXPECT_NEAR(length_of(found), length_of(i.lines), kRounding) << i.name;
    for (const auto& line : found)
      for (const Vec3 p : line) EXPECT_LE(distance_to(p, i.lines), kRounding) << i.name;
    for (const auto& line : i.lines)
      for (const Vec3 p : line) EXPECT_LE(distance_to(p, found), kRounding) << i.name;
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

/// Rows of cells of the plates, of `kCells` cells each, that the paper deletes.
std::array<std::size_t, 2> rows_deleted(const Corefined& c) {
  constexpr std::size_t kCells = 20;
  const Zone zone = paper_zone(c);
  std::array<std::set<ElementRef>, 2> faces;
  for (std::size_t f = 0; f < zone.in_zone.size(); ++f)
    if (zone.in_zone[f] != 0) faces[c.complex.component[f]].insert(c.complex.parent[f]);
  for (const auto& of_plate : faces) EXPECT_EQ(of_plate.size() % (2 * kCells), 0u);
  return {faces[0].size() / (2 * kCells), faces[1].size() / (2 * kCells)};
}

/// Edges are 0.1, 0.1 and 0.1414 long, so that l_a / 2 is 0.0569. A line 0.03 from a row of edges: 0.0569 / 0.03 is
/// nearer to 2 than to 1, so two neighbourhoods go, of the row that is met and one on either side. A line in the
/// middle: 0.0569 / 0.05, so only the row that is met.
TEST(Figure8, LikeDensitiesGiveOneOrTwoNeighbourhoodsByHowNearTheLineRunsToTheirBoundary) {
  struct Expected {
    double wall, rib, l_min;
    int n;
  };
  for (const Expected& e : {Expected{kNearRow, kNearRow, 0.03, 2}, Expected{kMidway, kMidway, 0.05, 1},
                            Expected{kMidway, kNearRow, 0.03, 2}, Expected{kNearRow, kMidway, 0.03, 2}}) {
    const auto [wall, rib] = like_density(e.wall, e.rib);
    const auto c = corefined(wall, rib);
    ASSERT_TRUE(c.has_value());
    const PaperBandwidth b = paper_bandwidth(*c, 0, 1);
    EXPECT_NEAR(b.l1a, 0.1 * (2 + std::sqrt(2.0)) / 3, 1e-9);
    EXPECT_NEAR(b.l2a, b.l1a, 1e-9);
    EXPECT_NEAR(b.l_min, e.l_min, 1e-9);
    EXPECT_EQ(b.n1, e.n);
    EXPECT_EQ(b.n2, e.n);
    const auto merged = merge(wall, std::span(&rib, 1), paper());
    ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
    EXPECT_EQ(merged->report.zone.bandwidth, (std::vector<int>{e.n, e.n}));
    const std::size_t rows = e.n == 2 ? 3 : 1;
    EXPECT_EQ(rows_deleted(*c), (std::array{rows, rows}));
  }
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
