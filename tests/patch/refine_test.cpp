// Density of filled areas (paper 5.6): where nodes are put, how many, and which edges are swapped.
#include "patch/refine.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/quality.hpp"
#include "remesh/cut.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

using SizeAt = std::function<double(Vec3)>;

/// A mesh all of whose faces count as just filled, with the size wanted at each place given by a formula.
struct Filled {
  cut::Scene scene;
  Brep brep;
  std::vector<std::uint8_t> in_zone;
  Editor editor;
  std::size_t n_before;

  Filled(const Model& model, const SizeAt& size) : Filled(scene_of(model), size) {}
  Filled(cut::Scene made, const SizeAt& size)
      : scene(std::move(made)),
        brep(read_brep(scene.complex, {}, {}, scene.groups, one_sheet())),
        in_zone(scene.complex.n_faces(), 1),
        editor(scene.complex, brep, in_zone,
               {[size](SheetId, Vec3 p) { return size(p); }, [size](CurveId, Vec3 p) { return size(p); }}, {}),
        n_before(scene.complex.n_vertices()) {
    std::vector<FaceId> faces;
    std::vector<LocalFace> anew;
    for (std::size_t f = 0; f < in_zone.size(); ++f) faces.emplace_back(f), anew.push_back(mesh().face(FaceId(f)));
    editor.replace(faces, anew);
  }

  static BrepOptions one_sheet() {
    BrepOptions options;
    options.sharp_angle = std::numbers::pi;
    return options;
  }
  static cut::Scene scene_of(const Model& model) {
    cut::Scene scene;
    cut::add(scene, model, 0);
    return scene;
  }

  void refine(bool filled = true) {
    meshgraft::refine(editor, std::vector<std::uint8_t>(brep.sheets.size(), filled ? 1 : 0));
  }

  [[nodiscard]] const LocalMesh& mesh() const { return editor.mesh(); }
  [[nodiscard]] std::size_t n_inserted() const { return mesh().n_vertices() - n_before; }
  [[nodiscard]] std::vector<Triangle> triangles() const {
    std::vector<Triangle> all;
    for (std::size_t f = 0; f < mesh().n_faces(); ++f)
      if (mesh().face(FaceId(f)).alive) all.push_back(mesh().corners(FaceId(f)));
    return all;
  }
  [[nodiscard]] double worst_q() const {
    double worst = 1;
    for (const Triangle& t : triangles()) worst = std::min(worst, aspect_ratio(t));
    return worst;
  }
};

Model faces(const std::vector<Vec3>& points, const std::vector<std::array<std::size_t, 3>>& corners) {
  ModelBuilder builder;
  for (const Vec3 p : points) builder.add_node(p);
  for (const auto& f : corners) builder.add_face(NodeId(f[0]), NodeId(f[1]), NodeId(f[2]));
  return builder.build();
}

/// Edges of length 1.
Model one_face() { return faces({{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}}, {{0, 1, 2}}); }

/// The centroid of an equilateral face is 1 / sqrt(3) edges from each corner.
constexpr double kLimit = std::numbers::sqrt2 / std::numbers::sqrt3;
constexpr double kRounding = 1 + 1e-12;

TEST(Refine, AFaceGetsANodeIfItsCentroidIsFartherThanTheSizeOverTheRootOfTwo) {
  for (const auto& [size, inserted] : {std::pair{0.99 * kLimit, 1u}, std::pair{1.01 * kLimit, 0u}}) {
    Filled f(one_face(), [size](Vec3) { return size; });
    f.refine();
    ASSERT_EQ(f.n_inserted(), inserted) << "size " << size;
  }
  Filled f(one_face(), [](Vec3) { return 0.99 * kLimit; });
  f.refine();
  const Vec3 middle = centroid(Triangle{Vec3{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}});
  EXPECT_LT(distance(f.mesh().position(VertexId(3)), middle), 1e-15);
}

TEST(Refine, ItMustBeFartherThanTheSizeAtEachCornerAndAtTheCentroid) {
  const Model face = one_face();
  const Vec3 middle = centroid(Triangle{face.position[0], face.position[1], face.position[2]});
  std::vector<Vec3> places = face.position;
  places.push_back(middle);
  for (const Vec3 place : places) {
    Filled f(face, [place](Vec3 p) { return distance(p, place) < 0.01 ? 1.01 * kLimit : 0.99 * kLimit; });
    f.refine();
    EXPECT_EQ(f.n_inserted(), 0u) << "larger at " << place.x << " " << place.y;
  }
}

TEST(Refine, ASheetThatWasNotFilledIsLeftAlone) {
  Filled f(one_face(), [](Vec3) { return 0.1; });
  f.refine(false);
  EXPECT_EQ(f.n_inserted(), 0u);
  f.refine();
  EXPECT_GT(f.n_inserted(), 20u);
}

TEST(Refine, EdgesAreSwappedIfTheWorseOfTwoFacesGetsBetterAndNotElse) {
  const std::vector<Vec3> kite{{0, 0, 0}, {1, -0.4, 0}, {2, 0, 0}, {1, 0.4, 0}};
  const auto wide = [](Vec3) { return 10.0; };  // nothing is inserted
  Filled along(faces(kite, {{0, 1, 2}, {0, 2, 3}}), wide), across(faces(kite, {{0, 1, 3}, {1, 2, 3}}), wide);
  const double best = across.worst_q();
  ASSERT_GT(best, 1.5 * along.worst_q());
  along.refine(), across.refine();
  EXPECT_DOUBLE_EQ(along.worst_q(), best);
  EXPECT_DOUBLE_EQ(across.worst_q(), best);
  EXPECT_EQ(along.n_inserted() + across.n_inserted(), 0u);
}

TEST(Refine, NoSwapFoldsAFaceBackOnANeighbour) {
  // A ridge along the x axis; a swap would make a valley across it, whose faces are of better shape. With the third
  // face that one of them would be folded back on, there is none.
  const Vec3 left{-1.5, 0, 0}, right{1.5, 0, 0}, front{0, -1, -1}, back{0, 1, -1};
  const Vec3 beside = lerp(left, front, 0.5) + cross(normalized({-0.8, -1.2, 0}), left - front);
  const auto wide = [](Vec3) { return 10.0; };
  Filled ridge(faces({left, right, front, back}, {{0, 2, 1}, {1, 3, 0}}), wide);
  Filled bounded(faces({left, right, front, back, beside}, {{0, 2, 1}, {1, 3, 0}, {2, 0, 4}}), wide);
  const auto has_ridge = [](const Filled& f) { return f.mesh().has_edge(VertexId(0), VertexId(1)); };
  ridge.refine(), bounded.refine();
  EXPECT_FALSE(has_ridge(ridge));
  EXPECT_TRUE(has_ridge(bounded));
}

/// As many nodes as equilateral faces of the size have, in the plate of width 1 from x0 to x1.
double nodes_wanted(const SizeAt& size, double x0, double x1) {
  constexpr int kSteps = 1000;
  double sum = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double s = size({x0 + (x1 - x0) * (k + 0.5) / kSteps, 0, 0});
    sum += (x1 - x0) / kSteps / (s * s * std::sqrt(0.75));
  }
  return sum;
}

TEST(Refine, TheDensityFollowsTheSizeWantedFromPlaceToPlace) {
  // Nearly six times as fine at the left end as at the right one; the plate has a few large faces.
  const auto size = [](Vec3 p) { return 0.03 + 0.05 * p.x; };
  Filled f(scenes::staggered_plate({0, 0, 0}, {3, 0, 0}, {0, 1, 0}, 1), size);
  f.refine();
  for (int strip = 0; strip < 3; ++strip) {
    double n = 0;
    for (std::size_t v = f.n_before; v < f.mesh().n_vertices(); ++v)
      if (const double x = f.mesh().position(VertexId(v)).x; x >= strip && x < strip + 1) ++n;
    const double share = n / nodes_wanted(size, strip, strip + 1);
    EXPECT_GT(share, 0.7) << "strip " << strip;
    EXPECT_LT(share, 1) << "strip " << strip;
  }
}

TEST(Refine, NoFaceStaysTooLargeAndNoNodeIsTooNearToAnother) {
  EXPECT_TRUE(rc::check([] {
    const double least = *rc::gen::inRange(30, 100) / 1000.0, slope = *rc::gen::inRange(0, 300) / 1000.0;
    const double turn = *rc::gen::inRange(0, 628) / 100.0;
    const auto size = [=](Vec3 p) { return least + slope * (2 + p.x * std::cos(turn) + p.y * std::sin(turn)) / 4; };
    const double edge = *rc::gen::inRange(20, 100) / 100.0;
    Filled f(scenes::plate({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, edge, "PLATE", 0.2), size);
    f.refine();
    for (const Triangle& t : f.triangles()) {
      const Vec3 c = centroid(t);
      RC_ASSERT(std::ranges::any_of(
          t, [&](Vec3 p) { return std::numbers::sqrt2 * distance(p, c) <= std::max(size(p), size(c)) * kRounding; }));
    }
    // A new node is farther from the corners of its face than the size over the root of 2; from a node beyond one of
    // its edges it may be half as far.
    for (const Triangle& t : f.triangles())
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 p = t[k], q = t[(k + 1) % 3];
        RC_ASSERT(2 * std::numbers::sqrt2 * distance(p, q) > std::max(size(p), size(q)));
      }
  }));
}

}  // namespace
}  // namespace meshgraft
