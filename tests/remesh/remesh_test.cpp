#include "remesh/remesh.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "geometry/quality.hpp"
#include "laws.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

using cut::broken_laws, cut::crossing, cut::mean, cut::new_qualities, cut::Scene, cut::trial, cut::Trial;

void expect_fit(const Trial& t, double min_q, double mean_q, double area_share = 1e-9) {
  EXPECT_EQ(broken_laws(t, area_share), std::vector<std::string>{});
  const auto q = new_qualities(t);
  ASSERT_FALSE(q.empty());
  EXPECT_GE(q.front(), min_q);
  EXPECT_GE(mean(q), mean_q);
  EXPECT_EQ(t.result.bad.empty(), q.front() >= 0.5);
}

/// Faces that have a piece in the zone.
double n_uncut_faces_of_zone(const Trial& t) {
  std::set<ElementRef> parents;
  for (std::size_t f = 0; f < t.in_zone.size(); ++f)
    if (t.in_zone[f]) parents.insert(t.scene.complex.parent[f]);
  return static_cast<double>(parents.size());
}

class Crossing : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(Crossing, IsFitForAnalysisAtAnyOffsetAndTurn) {
  const auto [y0, turn] = GetParam();
  expect_fit(trial(crossing(0.1, 0.1, 70, y0, turn, 0.15), 4), 0.5, 0.88);
}
INSTANTIATE_TEST_SUITE_P(Plates, Crossing,
                         testing::Combine(testing::Values(0.8, 0.97, 1.0, 1.0001, 1.049),
                                          testing::Values(0.0, 0.4, 0.7)));

TEST(Remesh, TwoNeighbourhoodsAreRoomEnoughForTheWorstFace) {
  for (const double y0 : {0.93, 0.97, 1.0, 1.02}) expect_fit(trial(crossing(0.1, 0.1, 90, y0, 0.2, 0.15), 2), 0.5, 0.8);
}

TEST(Remesh, AZoneHasAsManyFacesAsBefore) {
  double removed = 0, made = 0;
  for (const double y0 : {0.8, 0.93, 1.0, 1.049})
    for (const double turn : {0.1, 0.4, 0.7}) {
      const Trial t = trial(crossing(0.1, 0.1, 70, y0, turn, 0.15), 5);
      const double r = n_uncut_faces_of_zone(t), m = static_cast<double>(std::ranges::count(t.result.in_zone, 1));
      EXPECT_NEAR(m / r, 1, 0.08) << y0 << ' ' << turn;
      removed += r, made += m;
    }
  EXPECT_NEAR(made / removed, 1, 0.04);
}

TEST(Remesh, AWishThatNoMeshMeetsIsGivenUpSoon) {
  Scene scene = crossing(0.1, 0.1, 70, 0.97, 0.4, 0.15);
  const Brep brep = read_brep(scene.complex, scene.junction_edges, {}, scene.groups);
  const auto n_questions = [&](double min_quality) {  // for sizes: they tell how much was tried
    std::atomic<int> n = 0;
    const auto answer = [&] { return ++n, 0.1; };
    const Sizing sizing{[&](SheetId, Vec3) { return answer(); }, [&](CurveId, Vec3) { return answer(); }};
    RemeshOptions options;
    options.min_quality = min_quality;
    (void)remesh(scene.complex, brep, sizing, cut::zone(scene, 5), scene.groups, options);
    return n.load();
  };
  EXPECT_LT(n_questions(0.9), 20 * n_questions(0.5));
}

TEST(Remesh, GradesBetweenMeshesOneToThreeAndOneToTen) {
  expect_fit(trial(crossing(0.1, 0.1 / 3, 90, 0.97, 0.3, 0.15), 5), 0.5, 0.85);
  expect_fit(trial(crossing(0.1, 0.01, 90, 0.97, 0, 0.15), 10), 0.5, 0.85);
}

TEST(Remesh, IsTheSameForAnyNumberOfThreads) {
  const auto with_threads = [](int n) {
    return tbb::task_arena(n).execute([] { return trial(crossing(0.1, 0.07, 60, 0.97, 0.3, 0.15), 3); });
  };
  const Trial a = with_threads(1), b = with_threads(4);
  EXPECT_EQ(a.result.complex.position, b.result.complex.position);
  EXPECT_EQ(a.result.complex.face, b.result.complex.face);
  EXPECT_EQ(a.result.complex.parent, b.result.complex.parent);
}

TEST(Remesh, CurvedSheetsStayNearTheirSurface) {
  Scene scene;
  cut::add(scene, scenes::cylinder({0, 0, -1}, {0, 0, 1}, 0.5, 0.1), 0);
  scene.original = scene.complex;
  cut::split(scene, 0, [](Vec3 p) { return p.z + 0.4 * p.x - 0.03; });
  const Trial t = trial(std::move(scene), 5);
  expect_fit(t, 0.5, 0.85, 0.005);
  EXPECT_LE(t.result.max_deviation_relative, 0.1);
  for (std::size_t v = 0; v < t.result.complex.n_vertices(); ++v) {
    const Vec3 p = t.result.complex.position[v];
    EXPECT_NEAR(std::hypot(p.x, p.y), 0.5, 0.5 * (1 - std::cos(std::numbers::pi / 31)) + 1e-9);
  }
}

TEST(Remesh, ABorderPulledOffThePlaneDrawsNoVertexAfterIt) {
  Scene scene = crossing(0.1, 0.1, 90, 0.97, 0.2, 0.15);
  std::size_t n_pulled = 0;
  for (Vec3& p : scene.complex.position)
    if (p.z == 0 && p.x == 0 && std::abs(p.y - 0.77) < 0.06) p.z = 5e-4, ++n_pulled;
  ASSERT_GE(n_pulled, 1u);
  const Trial t = trial(std::move(scene), 3);
  const Complex& c = t.result.complex;
  std::size_t n_inside = 0;
  for (std::size_t f = 0; f < c.n_faces(); ++f) {
    if (c.component[f] != 0) continue;
    for (const VertexId v : c.face[f]) {
      const Vec3 p = c.position[v.value];
      if (c.node[v.value].valid() || p.x <= 0 || p.x >= 2 || p.y <= 0 || p.y >= 2) continue;
      EXPECT_NEAR(p.z, 0, 1e-12);
      ++n_inside;
    }
  }
  EXPECT_GT(n_inside, 100u);
}

TEST(Remesh, PinnedVerticesStayAndSoDoFrozenOnes) {
  Scene scene = crossing(0.1, 0.1, 90, 0.97, 0, 0.15);
  std::vector<Vec3> pinned;
  for (std::size_t v = 0; v < scene.complex.n_vertices(); ++v) {
    const Vec3 p = scene.complex.position[v];
    if (!scene.complex.node[v].valid() || std::abs(p.y - 1.05) > 0.05 || p.z != 0 || v % 3 != 0) continue;
    scene.complex.state[v] = VertexState::kPinned;
    pinned.push_back(p);
  }
  ASSERT_GE(pinned.size(), 3u);
  const Trial t = trial(std::move(scene), 4);
  EXPECT_EQ(broken_laws(t), std::vector<std::string>{});
  for (const Vec3 p : pinned)
    EXPECT_NE(std::ranges::find(t.result.complex.position, p), t.result.complex.position.end());
}

TEST(Remesh, ParallelCurvesLeaveAStripOfRightSize) {
  // An old line of the base beside the new one: both bound the strip between them.
  Scene scene;
  cut::add(scene, scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.1, "BASE", 0.15), 0);
  scene.original = scene.complex;
  cut::split(scene, 0, [](Vec3 p) { return p.y - 0.97; });
  cut::split(scene, 0, [](Vec3 p) { return p.y - 1.01 - 0.01 * p.x; });
  const Trial t = trial(std::move(scene), 4);
  EXPECT_EQ(broken_laws(t), std::vector<std::string>{});
  EXPECT_GE(new_qualities(t).front(), 0.5);
}

TEST(Remesh, ClosedCurvesAreResampledEvenly) {
  Scene scene;
  cut::add(scene, scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.1, "BASE", 0.15), 0);
  scene.original = scene.complex;
  cut::split(scene, 0, [](Vec3 p) { return std::hypot(p.x - 0.97, p.y - 1.03) - 0.52; });
  const Trial t = trial(std::move(scene), 4);
  expect_fit(t, 0.5, 0.85);
  const auto on_circle = [](Vec3 p) { return std::abs(std::hypot(p.x - 0.97, p.y - 1.03) - 0.52) < 0.01; };
  double shortest = 1, longest = 0;
  for (std::size_t f = 0; f < t.result.complex.n_faces(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corners = t.result.complex.corners(FaceId(f));
      const Vec3 a = corners[k], b = corners[(k + 1) % 3];
      if (!on_circle(a) || !on_circle(b)) continue;
      const double d = distance(a, b);
      shortest = std::min(shortest, d), longest = std::max(longest, d);
    }
  // Mending may halve a piece; the rest is even.
  EXPECT_LE(longest, 2.2 * shortest);
}

TEST(Remesh, LinesAreRebuiltAlongTheirCurve) {
  // Beams along the cut, all in one direction, alternately of two parents.
  Scene scene = crossing(0.1, 0.1, 90, 0.97, 0, 0.15);
  double before = 0;
  for (const auto& e : scene.junction_edges) {
    auto ends = e;
    if (scene.complex.position[ends[0].value].x > scene.complex.position[ends[1].value].x) std::swap(ends[0], ends[1]);
    const double x = scene.complex.position[ends[0].value].x;
    scene.complex.lines.push_back({ends,
                                   {0, ElementId(x < 1 ? std::size_t{9000} : std::size_t{9001})},
                                   GroupSets::kEmpty,
                                   AttributesId(std::size_t{1})});
    before += distance(scene.complex.position[ends[0].value], scene.complex.position[ends[1].value]);
  }
  const Trial t = trial(std::move(scene), 3);
  const Complex& c = t.result.complex;
  std::map<std::array<VertexId, 2>, int> edges;
  for (const auto& v : c.face)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{std::min(v[k], v[(k + 1) % 3]), std::max(v[k], v[(k + 1) % 3])}];
  double after = 0;
  for (const auto& line : c.lines) {
    const auto [a, b] = line.ends;
    EXPECT_EQ((edges[{std::min(a, b), std::max(a, b)}]), 4);
    EXPECT_LT(c.position[a.value].x, c.position[b.value].x);
    const double middle = 0.5 * (c.position[a.value].x + c.position[b.value].x);
    if (std::abs(middle - 1) > 0.1) {
      EXPECT_EQ(line.parent.element.value, middle < 1 ? 9000u : 9001u);
    }
    after += distance(c.position[a.value], c.position[b.value]);
  }
  EXPECT_NEAR(after, before, 1e-9);
  EXPECT_LT(c.lines.size(), t.scene.complex.lines.size());
}

TEST(Remesh, NodeGroupsOfAWholePlateCoverItAfterwards) {
  Scene scene = crossing(0.1, 0.1, 90, 0.97, 0.2, 0.15);
  const GroupSetId all = scene.groups.intern({GroupId(std::size_t{7})});
  for (GroupSetId& g : scene.complex.vertex_groups) g = all;
  const Trial t = trial(std::move(scene), 3);
  for (const GroupSetId g : t.result.complex.vertex_groups) EXPECT_EQ(g, all);
}

TEST(Remesh, SharpInputAngleIsReportedWithItsCause) {
  // Two cuts that meet at 8 degrees.
  Scene scene;
  cut::add(scene, scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.1, "BASE", 0.15), 0);
  scene.original = scene.complex;
  cut::split(scene, 0, [](Vec3 p) { return p.y - 0.97; });
  cut::split(scene, 0, [](Vec3 p) { return p.y - 0.97 - std::tan(8 * std::numbers::pi / 180) * (p.x - 1.03); });
  const Trial t = trial(std::move(scene), 3);
  EXPECT_EQ(broken_laws(t), std::vector<std::string>{});
  ASSERT_FALSE(t.result.bad.empty());
  EXPECT_EQ(t.result.bad.front().cause.kind, Cause::Kind::kInputAngle);
  // Those behind the tip suffer from it as well.
  for (const BadFace& bad : t.result.bad) EXPECT_EQ(bad.cause.text.substr(0, 14), "input angle of") << bad.cause.text;
}

TEST(Remesh, DetailsFinerThanTheSizesGoAreNamed) {
  // Three cuts that nearly meet in one point.
  Scene scene;
  cut::add(scene, scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.1, "BASE", 0.15), 0);
  scene.original = scene.complex;
  cut::split(scene, 0, [](Vec3 p) { return p.y - 0.97; });
  cut::split(scene, 0, [](Vec3 p) { return p.y - 0.97 - 1.7 * (p.x - 1.03); });
  cut::split(scene, 0, [](Vec3 p) { return p.y - 0.97 + 1.7 * (p.x - 1.0303); });
  const Trial t = trial(std::move(scene), 3);
  EXPECT_EQ(broken_laws(t), std::vector<std::string>{});
  using Kind = Cause::Kind;
  bool found = false;
  for (const BadFace& bad : t.result.bad) {
    found = found || bad.cause.kind == Kind::kInputDetail;
    EXPECT_TRUE(bad.cause.kind == Kind::kInputDetail || bad.cause.kind == Kind::kInputAngle) << bad.cause.text;
  }
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace meshgraft
