#include "zone/size_field.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>

#include "complexes.hpp"
#include "geometry/quality.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

using test::Joined;
using test::joined;

struct Scene {
  Joined j;
  Brep brep;
  SizeField size;
};

Scene scene(std::span<const Model> models, const SizeOptions& options = {}) {
  Joined j = joined(models);
  Brep brep = read_brep(j.complex, j.junction_edges, {}, j.groups);
  SizeField size(j.complex, j.complex, brep, options);
  return {std::move(j), std::move(brep), std::move(size)};
}

SheetId sheet_at(const Scene& s, Vec3 p) {
  SheetId best;
  double least = 1e300;
  for (std::size_t f = 0; f < s.j.complex.n_faces(); ++f) {
    const auto c = s.j.complex.corners(FaceId(f));
    const double d = distance(p, (c[0] + c[1] + c[2]) / 3.0);
    if (d < least) least = d, best = s.brep.sheet_of_face[f];
  }
  return best;
}

double at(const Scene& s, Vec3 p) { return s.size.at(sheet_at(s, p), p); }

double wish(const Scene& s, Vec3 p) {
  for (std::size_t c = 0; c < s.brep.curves.size(); ++c)
    for (const VertexId v : s.brep.curves[c].chain)
      if (distance(s.j.complex.position[v.value], p) < 1e-9) return s.size.on_curve(CurveId(c), p);
  ADD_FAILURE() << "no curve there";
  return 0;
}

// The mean edge of the grid triangles of size 1 is (2 + sqrt 2) / 3.
const double kMean = (2 + std::sqrt(2.0)) / 3;
// An equilateral triangle with this edge is as large as they are: 1/2.
const double kOwn = std::sqrt(2 / std::sqrt(3.0));

Model floor_plate(double size) { return scenes::plate({0, 0, 0}, {12, 0, 0}, {0, 12, 0}, size); }
Model wall(double size) { return scenes::plate({0, 6, 0}, {12, 0, 0}, {0, 0, 6}, size, "WALL"); }

TEST(SizeField, WithoutAJunctionItIsTheOwnSize) {
  const Scene s = scene(std::array{floor_plate(1)});
  EXPECT_NEAR(at(s, {5, 5, 0}), kOwn, 1e-9);
  EXPECT_TRUE(std::isinf(s.size.junction({5, 5, 0}).size));
}

Model stretched_floor(double by) {
  return scenes::moved(floor_plate(1), [by](Vec3 p) { return Vec3{p.x, by * p.y, p.z}; });
}

TEST(SizeField, StretchedFacesDoNotMakeASheetMuchFiner) {
  const Scene s = scene(std::array{stretched_floor(5)});
  EXPECT_NEAR(at(s, {5, 30, 0}), SizeOptions().stretched * (1 + 5 + std::sqrt(26.0)) / 3, 1e-9);
}

TEST(SizeField, ACoarsePictureOfASphereAsksForSmallerFacesThanItsOwn) {
  const auto mean_size = [](const Scene& s) {
    double sum = 0;
    for (std::size_t f = 0; f < s.j.complex.n_faces(); ++f) sum += mean_edge_length(s.j.complex.corners(FaceId(f)));
    return sum / static_cast<double>(s.j.complex.n_faces());
  };
  const Scene coarse = scene(std::array{scenes::sphere({0, 0, 0}, 1, 3)});
  const Scene fine = scene(std::array{scenes::sphere({0, 0, 0}, 1, 8)});
  const Vec3 p = normalized(Vec3{0.3, 0.5, 0.7});
  // A node of the coarse one stands at the slope of its faces, 0.19, times s / sqrt 3 above a face of size s.
  EXPECT_LE(0.19 * at(coarse, p) / std::sqrt(3.0), 1.1 * SizeOptions{}.max_height * mean_size(coarse));
  EXPECT_NEAR(at(fine, p), mean_size(fine), 0.1 * mean_size(fine));
}

TEST(SizeField, OnAFreeEdgeTheSpacingOfTheInputCounts) {
  const Scene s = scene(std::array{stretched_floor(1.5)});
  EXPECT_NEAR(wish(s, {5, 0, 0}), 1, 0.01);
}

TEST(SizeField, AlikeMeshesMeetAtTheirSize) {
  const Scene s = scene(std::array{floor_plate(1), wall(1)});
  EXPECT_NEAR(s.size.junction({6, 6, 0}).size, kMean, 1e-9);
  EXPECT_NEAR(wish(s, {6, 6, 0}), kMean, 1e-9);
}

// A conforming strip in two sizes is not needed: the junction is where the wall's own nodes are shared, and
// the plate's size is told by its faces alone.
Model coarse_beside(double ratio) {
  // Triangles about `ratio` long that still use nodes at spacing 1 on the line y = 6.
  ModelBuilder b;
  std::vector<NodeId> on;
  for (int i = 0; i <= 12; ++i) on.push_back(b.add_node({static_cast<double>(i), 6, 0}));
  for (const double side : {-1.0, 1.0})
    for (std::size_t i = 0; i < 12; ++i)
      b.add_face(on[i], on[i + 1], b.add_node({static_cast<double>(i) + 0.5, 6 + side * ratio, 0}));
  return b.build();
}

TEST(SizeField, JunctionStaysNearTheFinerMesh) {
  for (const double ratio : {3.0, 10.0, 30.0}) {
    const Scene s = scene(std::array{coarse_beside(ratio), wall(1)});
    const double l = s.size.junction({5, 6, 0}).size;
    EXPECT_GT(l, 0.95 * kMean);
    EXPECT_LE(l, SizeOptions().finer_share * kMean + 1e-9);
  }
}

TEST(SizeField, BesideKeptFacesTheJunctionHasTheirSize) {
  const std::array models{coarse_beside(10), wall(1)};
  const Joined j = joined(models);
  const auto size_if_kept = [&](std::uint32_t component) {
    std::vector<std::uint8_t> kept;
    for (const std::uint32_t c : j.complex.component) kept.push_back(c == component ? 1 : 0);
    SizeOptions options;
    options.kept = kept;
    return scene(models, options).size.junction({5, 6, 0}).size;
  };
  EXPECT_NEAR(size_if_kept(1), kMean, 0.05 * kMean);
  EXPECT_GT(size_if_kept(0), 2 * SizeOptions().finer_share * kMean);
}

TEST(SizeField, GivenJunctionSizeIsTaken) {
  for (const double given : {0.3, 2.0}) {
    SizeOptions options;
    options.junction_size = given;
    const Scene s = scene(std::array{floor_plate(1), wall(1)}, options);
    EXPECT_NEAR(wish(s, {5, 6, 0}), given, 1e-9);
    // Linear from there to the own size, in both directions.
    for (const double d : {0.5, 1.0, 2.0}) {
      const double expected = given < kOwn ? std::min(kOwn, given + 0.4 * d) : std::max(kOwn, given - 0.4 * d);
      EXPECT_NEAR(at(s, {5, 6 + d, 0}), expected, 1e-9);
      EXPECT_NEAR(at(s, {5, 6, d}), expected, 1e-9);
    }
  }
}

TEST(SizeField, StripAsksForItsWidth) {
  const Scene s = scene(std::array{floor_plate(1), scenes::plate({0, 6, 0}, {12, 0, 0}, {0, 0, 0.2}, 1, "RIB")});
  EXPECT_NEAR(at(s, {6, 6, 0.1}), 0.2, 0.06);
  EXPECT_NEAR(wish(s, {5, 6, 0}), 0.2, 0.06);
  // The floor grades away from it.
  EXPECT_NEAR(at(s, {6, 7, 0}), 0.2 + 0.4, 0.06);
}

// One sheet on both sides of a line that ends inside it.
RC_GTEST_PROP(SizeField, ALineIsNotNearToItself, ()) {
  const double turn = 1e-3 * *rc::gen::inRange(0, 6283);
  const Vec3 shift{1e-3 * *rc::gen::inRange(-1000, 1000), 1e-3 * *rc::gen::inRange(-1000, 1000), 0};
  std::array models{scenes::plate({0, 0, 0}, {6, 0, 0}, {0, 1, 0}, 0.1),
                    scenes::plate({1, 0.5, 0}, {4, 0, 0}, {0, 0, 0.5}, 0.1, "WALL")};
  for (Model& model : models)
    for (Vec3& p : model.position)  // a grid first, so that nodes on the line are the same to the bit
      p = {std::round(p.x * 10), std::round(p.y * 10), std::round(p.z * 10)},
      p = shift + Vec3{std::cos(turn) * p.x - std::sin(turn) * p.y, std::sin(turn) * p.x + std::cos(turn) * p.y, p.z};
  const Scene s = scene(models);
  for (std::size_t c = 0; c < s.brep.curves.size(); ++c) {
    const Curve& curve = s.brep.curves[c];
    for (std::size_t i = 1; curve.junction && i < curve.chain.size(); ++i) {
      const Vec3 a = s.j.complex.position[curve.chain[i - 1].value], b = s.j.complex.position[curve.chain[i].value];
      RC_ASSERT(s.size.on_curve(CurveId(c), midpoint(a, b)) > 0.9 * kMean);
    }
  }
}

TEST(SizeField, CrossingCurvesAreNotNarrow) {
  const std::array models{floor_plate(1), scenes::plate({0, 6, 0}, {12, 0, 0}, {0, 0, 6}, 1, "WALL"),
                          scenes::plate({6, 0, 0}, {0, 12, 0}, {0, 0, 6}, 1, "ACROSS")};
  const Scene s = scene(models);
  EXPECT_NEAR(at(s, {6.1, 6.1, 0}), kMean, 0.15);
  EXPECT_NEAR(at(s, {9, 9, 0}), kOwn, 1e-9);
}

Model wedge(double degrees) {
  const double a = degrees / 180 * 3.14159265358979;
  ModelBuilder b;
  const NodeId o = b.add_node({0, 0, 0});
  NodeId low, high;
  for (int i = 1; i <= 20; ++i) {
    const double r = i;
    const NodeId l = b.add_node({r, 0, 0}), h = b.add_node({r * std::cos(a), r * std::sin(a), 0});
    if (i == 1)
      b.add_face(o, l, h);
    else
      b.add_face(low, l, h), b.add_face(low, h, high);
    low = l, high = h;
  }
  return b.build();
}

TEST(SizeField, OnlySharpCornersAreNarrow) {
  const Scene wide = scene(std::array{wedge(60)}), sharp = scene(std::array{wedge(10)});
  EXPECT_GT(at(wide, {1, 0.3, 0}), 0.8);
  EXPECT_LT(at(sharp, {3, 0.2, 0}), 0.75);
  EXPECT_GT(at(sharp, {0.1, 0, 0}), 0.1);  // never without end
}

TEST(SizeField, SlotIsNotNarrowAcrossTheGap) {
  // Two plates of one sheet size, 0.1 apart: no sheet between them.
  const Model both = scenes::together(std::array{scenes::plate({0, 0, 0}, {6, 0, 0}, {0, 6, 0}, 1),
                                                 scenes::plate({0, 6.1, 0}, {6, 0, 0}, {0, 6, 0}, 1)});
  const Scene s = scene(std::array{both});
  EXPECT_NEAR(wish(s, {3, 6, 0}), kOwn, 0.01);
}

TEST(SizeField, SizeChangesNoFasterThanTheGradation) {
  SizeOptions options;
  options.junction_size = 0.25;
  const Scene s = scene(std::array{floor_plate(1), wall(1)}, options);
  const SheetId sheet = sheet_at(s, {6, 8, 0});
  EXPECT_TRUE(rc::check([&] {
    const auto coordinate = [](double low, double high) {
      return low + (high - low) * *rc::gen::inRange(0, 10001) / 10000.0;
    };
    const Vec3 p{coordinate(0, 12), coordinate(6, 12), 0}, q{coordinate(0, 12), coordinate(6, 12), 0};
    RC_ASSERT(std::abs(s.size.at(sheet, p) - s.size.at(sheet, q)) <= 0.4 * distance(p, q) + 1e-9);
  }));
}

TEST(SizeField, ScalesWithTheModel) {
  const auto scaled = [](Model m) { return scenes::moved(std::move(m), [](Vec3 p) { return 1024.0 * p; }); };
  const Scene s = scene(std::array{floor_plate(1), wall(0.5)});
  const Scene t = scene(std::array{scaled(floor_plate(1)), scaled(wall(0.5))});
  for (const Vec3 p : {Vec3{5, 6.3, 0}, {2, 9, 0}, {6, 6, 1}}) EXPECT_DOUBLE_EQ(1024 * at(s, p), at(t, 1024.0 * p));
}

}  // namespace
}  // namespace meshgraft
