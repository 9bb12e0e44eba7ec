#include "zone/neighbourhoods.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "complexes.hpp"
#include "geometry/quality.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

using test::joined;

struct Scene {
  Complex original;
  Corefined corefined;
  GroupSets groups;
  Brep brep;
  SizeField size;
};

/// Two models that meet conformingly, as if corefined.
Scene scene(std::span<const Model> models, std::optional<double> junction_size = {}) {
  test::Joined j = joined(models);
  Corefined c;
  c.complex = j.complex;
  c.junction_edges = j.junction_edges;
  c.touched = j.touched;
  for (std::uint32_t m = 1; m < models.size(); ++m) c.met.push_back({0, m});
  Brep brep = read_brep(c.complex, c.junction_edges, {}, j.groups);
  SizeOptions options;
  options.junction_size = junction_size;
  SizeField size(j.complex, c.complex, brep, options);
  return {std::move(j.complex), std::move(c), std::move(j.groups), std::move(brep), std::move(size)};
}

Scene two_plates(std::optional<double> junction_size = {}) {
  return scene(std::array{scenes::plate({0, 0, 0}, {20, 0, 0}, {0, 20, 0}, 1),
                          scenes::plate({0, 10, 0}, {20, 0, 0}, {0, 0, 10}, 1, "WALL")},
               junction_size);
}

/// The definition: faces of one mesh with a vertex of the previous neighbourhood.
std::vector<std::uint8_t> brute_force(const Corefined& c, int n) {
  std::vector<std::uint8_t> in = c.touched;
  for (int k = 1; k < n; ++k) {
    std::set<std::pair<std::uint32_t, VertexId>> nodes;
    for (std::size_t f = 0; f < in.size(); ++f)
      if (in[f])
        for (const VertexId v : c.complex.face[f]) nodes.insert({c.complex.component[f], v});
    for (std::size_t f = 0; f < in.size(); ++f)
      for (const VertexId v : c.complex.face[f])
        if (nodes.contains({c.complex.component[f], v})) in[f] = 1;
  }
  return in;
}

TEST(Neighbourhoods, APartOfWhichNoFaceIsLeftChangesNothing) {
  Scene s = two_plates();
  const Zone without = neighbourhoods(s.corefined, InputFaces(s.corefined), s.size, {});
  s.corefined.met.push_back({0, 2}), s.corefined.met.push_back({1, 2});
  const Zone with = neighbourhoods(s.corefined, InputFaces(s.corefined), s.size, {});
  EXPECT_EQ(with.in_zone, without.in_zone);
  EXPECT_EQ(with.bandwidth, (std::vector{without.bandwidth[0], without.bandwidth[1], 0}));
}

TEST(Neighbourhoods, AGivenBandwidthIsTakenOnAllMeshes) {
  const Scene s = two_plates();
  for (const int n : {1, 2, 4}) {
    const Zone zone = neighbourhoods(s.corefined, InputFaces(s.corefined), s.size, n);
    EXPECT_EQ(zone.in_zone, brute_force(s.corefined, n));
    EXPECT_EQ(zone.bandwidth, (std::vector{n, n}));
  }
}

TEST(Neighbourhoods, MeshesThatShareTheirNodesAreLeftAlone) {
  const Scene s = two_plates();
  const Zone zone = neighbourhoods(s.corefined, InputFaces(s.corefined), s.size, std::nullopt);
  EXPECT_EQ(zone.bandwidth, (std::vector{0, 0}));
  EXPECT_EQ(std::ranges::count(zone.in_zone, 1), 0);
}

TEST(Neighbourhoods, FacesThatMovedNodesHaveSpoiledAreNotLeftAlone) {
  constexpr double kWanted = 0.5;
  Scene s = two_plates();
  const VertexId v = test::vertex_at(s.corefined.complex, {5, 10, 1});
  const auto zone = [&] {
    InputFaces inputs(s.corefined);
    inputs.find_spoiled(s.original, kWanted);
    return neighbourhoods(s.corefined, inputs, s.size, std::nullopt).in_zone;
  };
  s.corefined.complex.position[v.value].x += 0.2;
  EXPECT_EQ(std::ranges::count(zone(), 1), 0);
  s.corefined.complex.position[v.value].x += 0.5;
  const auto in_zone = zone();
  for (std::size_t f = 0; f < in_zone.size(); ++f)
    if (aspect_ratio(s.corefined.complex.corners(FaceId(f))) < kWanted) {
      EXPECT_TRUE(in_zone[f]);
    }
  EXPECT_GT(std::ranges::count(in_zone, 1), 0);
  s.original = s.corefined.complex;  // as poor in the input
  EXPECT_EQ(std::ranges::count(zone(), 1), 0);
}

TEST(Neighbourhoods, LongFacesAreNoReasonToReachFar) {
  // Faces three times as long across the junction as along it.
  Model ground = scenes::plate({0, 0, 0}, {20, 0, 0}, {0, 20, 0}, 1);
  for (Vec3& p : ground.position) p.y = 10 + 3 * (p.y - 10);
  const Scene s = scene(std::array{ground, scenes::plate({0, 10, 0}, {20, 0, 0}, {0, 0, 10}, 1, "WALL")}, 0.8);
  constexpr int kMore = 3;
  const auto reach = [&](const Zone& zone) {
    double most = 0;
    for (std::size_t f = 0; f < zone.in_zone.size(); ++f)
      if (zone.in_zone[f]) most = std::max(most, std::abs(centroid(s.corefined.complex.corners(FaceId(f))).y - 10));
    return most;
  };
  const double length = (1 + 3 + std::sqrt(10.0)) / 3;
  EXPECT_LE(reach(neighbourhoods(s.corefined, InputFaces(s.corefined), s.size, std::nullopt, kMore)), 5.5 * length);
  EXPECT_GT(reach(neighbourhoods(s.corefined, InputFaces(s.corefined), s.size, 3 + kMore)), 5.5 * length);
}

TEST(Neighbourhoods, TheChangeOfSizeFitsIn) {
  const Scene s = two_plates(0.2);
  const Zone zone = neighbourhoods(s.corefined, InputFaces(s.corefined), s.size, std::nullopt);
  for (std::size_t f = 0; f < zone.in_zone.size(); ++f) {
    const auto c = s.corefined.complex.corners(FaceId(f));
    const Vec3 p = (c[0] + c[1] + c[2]) / 3.0;
    const double d = std::max(std::abs(p.y - 10), p.z);
    if (d < (1.1 - 0.2) / 0.4) {
      EXPECT_TRUE(zone.in_zone[f]) << d;
    }
    if (d > 6) {
      EXPECT_FALSE(zone.in_zone[f]) << d;
    }
  }
}

TEST(Neighbourhoods, FrozenFacesStayOut) {
  Scene s = two_plates();
  const VertexId v = test::vertex_at(s.corefined.complex, {5, 10, 0});
  s.corefined.complex.state[v.value] = VertexState::kFrozen;
  const Zone zone = neighbourhoods(s.corefined, InputFaces(s.corefined), s.size, 3);
  for (std::size_t f = 0; f < zone.in_zone.size(); ++f)
    if (std::ranges::count(s.corefined.complex.face[f], v) > 0) {
      EXPECT_FALSE(zone.in_zone[f]);
    }
}

TEST(Neighbourhoods, FacesOnTheSameVerticesStayOut) {
  Scene s = two_plates();
  Complex& x = s.corefined.complex;
  FaceId f(std::size_t{0});
  while (s.corefined.touched[f.value] || !brute_force(s.corefined, 2)[f.value]) ++f.value;
  const auto v = x.face[f.value];
  const FaceId twin = x.add_face({v[2], v[1], v[0]}, x, f);
  x.parent[twin.value].element = ElementId(x.n_faces());
  s.corefined.touched.push_back(0);
  const Zone zone = neighbourhoods(s.corefined, InputFaces(s.corefined), s.size, 4);
  EXPECT_FALSE(zone.in_zone[f.value]);
  EXPECT_FALSE(zone.in_zone[twin.value]);
  EXPECT_GT(std::ranges::count(zone.in_zone, 1), 0);
}

/// Cuts face f of the complex at its centre, as corefinement would.
void cut(Corefined& c, FaceId f) {
  Complex& x = c.complex;
  const auto corners = x.corners(f);
  const VertexId v = x.add_vertex((corners[0] + corners[1] + corners[2]) / 3.0, {}, VertexState::kOpen, {});
  x.vertex_groups.back() = GroupSets::kEmpty;
  const auto old = x.face[f.value];
  x.face[f.value] = {old[0], old[1], v};
  x.add_face({old[1], old[2], v}, x, f), x.add_face({old[2], old[0], v}, x, f);
  c.touched.resize(x.n_faces(), c.touched[f.value]);
}

/// The same scene with some of its faces cut.
Scene with_cuts(const Scene& s, const std::function<bool(std::size_t)>& is_cut) {
  Scene result = s;
  const std::size_t m = s.corefined.complex.n_faces();
  for (std::size_t f = 0; f < m; ++f)
    if (is_cut(f)) cut(result.corefined, FaceId(f));
  const Complex& complex = result.corefined.complex;
  result.brep = read_brep(complex, result.corefined.junction_edges, {}, result.groups);
  result.size = SizeField(s.original, complex, result.brep, {});
  return result;
}

TEST(Neighbourhoods, AlikeMeshesGiveThreeEachAndMoreOnRequest) {
  const Scene whole = two_plates();
  const Scene s = with_cuts(whole, [&](std::size_t f) { return whole.corefined.touched[f] != 0; });
  for (const int more : {0, 1}) {
    const Zone zone = neighbourhoods(s.corefined, InputFaces(s.corefined), s.size, std::nullopt, more);
    EXPECT_EQ(zone.bandwidth, (std::vector{3 + more, 3 + more}));
    EXPECT_EQ(zone.in_zone, brute_force(s.corefined, 3 + more));
  }
}

TEST(Neighbourhoods, PiecesOfAFaceGoTogetherAndCountAsOne) {
  const Scene s = two_plates();
  const Scene pieces = with_cuts(s, [](std::size_t f) { return f % 3 == 0; });
  const Zone whole = neighbourhoods(s.corefined, InputFaces(s.corefined), s.size, 3);
  const Zone cut_up = neighbourhoods(pieces.corefined, InputFaces(pieces.corefined), pieces.size, 3);
  EXPECT_EQ(whole.bandwidth, cut_up.bandwidth);
  for (std::size_t f = 0; f < cut_up.in_zone.size(); ++f) {
    const ElementRef parent = pieces.corefined.complex.parent[f];
    const auto original = std::ranges::find(s.original.parent, parent) - s.original.parent.begin();
    EXPECT_EQ(cut_up.in_zone[f], whole.in_zone[static_cast<std::size_t>(original)]);
  }
}

TEST(Widen, AddsOneNeighbourhoodNearThePlaceOnly) {
  const Scene s = two_plates();
  Zone zone = neighbourhoods(s.corefined, InputFaces(s.corefined), s.size, 2);
  const Zone before = zone;
  const Vec3 place{5, 8.1, 0};
  ASSERT_TRUE(widen(zone, s.corefined, InputFaces(s.corefined), s.size, std::array{place}, 5));
  const auto reach = brute_force(s.corefined, 3);
  std::size_t added = 0;
  for (std::size_t f = 0; f < zone.in_zone.size(); ++f) {
    EXPECT_GE(zone.in_zone[f], before.in_zone[f]);
    if (zone.in_zone[f] == before.in_zone[f]) continue;
    ++added;
    EXPECT_TRUE(reach[f]);
    const auto c = s.corefined.complex.corners(FaceId(f));
    EXPECT_LT(distance(place, (c[0] + c[1] + c[2]) / 3.0), 3);
  }
  EXPECT_GT(added, 0u);
  EXPECT_EQ(zone.bandwidth[0], 3);
  EXPECT_EQ(zone.bandwidth[1], 2);
}

TEST(Widen, StopsAtTheLimit) {
  const Scene s = two_plates();
  Zone zone = neighbourhoods(s.corefined, InputFaces(s.corefined), s.size, 2);
  int rounds = 0;
  while (widen(zone, s.corefined, InputFaces(s.corefined), s.size, std::array{Vec3{10, 9, 0}}, 4))
    ASSERT_LT(++rounds, 100);
  const auto reach = brute_force(s.corefined, 4);
  for (std::size_t f = 0; f < zone.in_zone.size(); ++f) EXPECT_LE(zone.in_zone[f], reach[f]);
}

TEST(Widen, NeverTakesFrozenFaces) {
  Scene s = two_plates();
  for (auto& state : s.corefined.complex.state) state = VertexState::kFrozen;
  Zone zone = neighbourhoods(s.corefined, InputFaces(s.corefined), s.size, 2);
  EXPECT_FALSE(widen(zone, s.corefined, InputFaces(s.corefined), s.size, std::array{Vec3{10, 9, 0}}, 8));
}

}  // namespace
}  // namespace meshgraft
