// The local operations, one by one and in random order.
#include "remesh/editor.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "cut.hpp"
#include "geometry/quality.hpp"
#include "remesh/sheets.hpp"

namespace meshgraft {
namespace {

using cut::Scene;

constexpr double kSize = 0.2;

Sizing uniform() {
  return {[](SheetId, Vec3) { return kSize; }, [](CurveId, Vec3) { return kSize; }};
}

/// Two crossing plates with all faces in the zone, ready to be edited.
struct Bench {
  Scene scene;
  Brep brep;
  std::vector<std::uint8_t> in_zone;
  Editor editor;

  explicit Bench(double y0 = 0.97) : Bench(cut::crossing(kSize, kSize, 80, y0, 0.2, 0.1)) {}
  explicit Bench(Scene made)
      : scene(std::move(made)),
        brep(read_brep(scene.complex, scene.junction_edges, {}, scene.groups)),
        in_zone(scene.complex.n_faces(), 1),
        editor(scene.complex, brep, in_zone, uniform(), {}) {}
};

std::vector<std::array<VertexId, 3>> faces_of(const LocalMesh& mesh) {
  std::vector<std::array<VertexId, 3>> faces;
  for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
    if (!mesh.face(FaceId(f)).alive) continue;
    auto v = mesh.face(FaceId(f)).v;
    std::ranges::rotate(v, std::ranges::min_element(v));
    faces.push_back(v);
  }
  std::ranges::sort(faces);
  return faces;
}

/// Faces by sheet on each edge; for an edge of a curve, the curve too.
std::string broken_law(const Bench& b, const std::map<std::uint32_t, double>& area_of_sheet) {
  const LocalMesh& mesh = b.editor.mesh();
  std::map<std::array<VertexId, 2>, std::vector<FaceId>> edges;
  std::map<std::uint32_t, double> sum;
  std::set<std::array<VertexId, 3>> seen;
  for (std::size_t k = 0; k < mesh.n_faces(); ++k) {
    const LocalFace& face = mesh.face(FaceId(k));
    if (!face.alive) continue;
    auto v = face.v;
    std::ranges::sort(v);
    if (!seen.insert(v).second) return "two faces have the same corners";
    if (!(face.q > 0)) return "a face is turned over";
    if (std::abs(face.q - mesh.quality(face)) > 0) return "a remembered Q is wrong";
    sum[face.sheet.value] += area(mesh.corners(FaceId(k)));
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId a = face.v[i], c = face.v[(i + 1) % 3];
      edges[{std::min(a, c), std::max(a, c)}].emplace_back(k);
    }
  }
  std::map<std::pair<std::uint32_t, std::size_t>, double> length;  // of curves, by number of faces at the edge
  for (const auto& [edge, faces] : edges) {
    const CurveId curve = mesh.curve_at(edge[0], edge[1]);
    for (const FaceId f : faces) {
      const LocalFace& face = mesh.face(f);
      const std::size_t i =
          face.v[(face.corner_of(edge[0]) + 1) % 3] == edge[1] ? face.corner_of(edge[0]) : face.corner_of(edge[1]);
      if (face.curve[i] != curve) return "faces disagree on the curve of their edge";
    }
    if (!curve.valid()) {
      if (faces.size() != 2) return "an edge off the curves has not two faces";
      if (mesh.face(faces[0]).sheet != mesh.face(faces[1]).sheet) return "an edge off the curves joins two sheets";
    } else {
      length[{curve.value, faces.size()}] += distance(mesh.position(edge[0]), mesh.position(edge[1]));
    }
  }
  for (const auto& [key, total] : length)
    if (std::abs(total - b.editor.reference().length(CurveId(std::size_t{key.first}))) > 1e-9)
      return "a curve has not the same number of faces all along";
  for (const auto& [sheet, area] : area_of_sheet)
    if (std::abs(sum[sheet] - area) > 1e-9) return "a sheet changed its area";
  return {};
}

std::map<std::uint32_t, double> areas(const Bench& b) {
  std::map<std::uint32_t, double> sum;
  for (std::size_t f = 0; f < b.scene.complex.n_faces(); ++f)
    sum[b.brep.sheet_of_face[f].value] += area(b.scene.complex.corners(FaceId(f)));
  return sum;
}

/// Any operation at any place; returns whether it was possible.
bool random_step(Editor& editor) {
  const LocalMesh& mesh = editor.mesh();
  const auto at = *rc::gen::inRange<std::size_t>(0, mesh.n_faces());
  const LocalFace& face = mesh.face(FaceId(at));
  if (!face.alive) return false;
  const auto k = *rc::gen::inRange<std::size_t>(0, 3);
  const VertexId a = face.v[k], b = face.v[(k + 1) % 3];
  switch (*rc::gen::inRange(0, 6)) {
    case 0:
      return editor.flip(a, b);
    case 1:
      return editor.remove(a);
    case 2:
      return editor.split(a, b).has_value();
    case 3:
      return editor.relax(a);
    case 4:
      return editor.sharpen(a);
    default:
      return editor.insert(FaceId(at), {centroid(mesh.corners(FaceId(at))), FaceId{}, 0}).has_value();
  }
}

TEST(Editor, AnySequenceOfStepsLeavesAValidMesh) {
  EXPECT_TRUE(rc::check([] {
    Bench b;
    const auto before = areas(b);
    RC_ASSERT(broken_law(b, before).empty());
    int done = 0;
    for (int step = 0; step < 150; ++step) done += random_step(b.editor) ? 1 : 0;
    RC_LOG() << done << " steps done";
    RC_ASSERT(broken_law(b, before) == std::string());
  }));
}

/// Two sheets of n faces around a vertex each, on the same n corners and in one plane.
Scene pillow(std::size_t n) {
  ModelBuilder b;
  for (std::size_t k = 0; k < n; ++k) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
    b.add_node({std::cos(turn), std::sin(turn), 0});
  }
  const NodeId above = b.add_node({0.1, 0.05, 0}), below = b.add_node({-0.1, 0.02, 0});
  for (std::size_t k = 0; k < n; ++k) {
    b.add_face(NodeId(k), NodeId((k + 1) % n), above);
    b.add_face(NodeId((k + 1) % n), NodeId(k), below);
  }
  Scene scene;
  cut::add(scene, b.build(), 0);
  return scene;
}

TEST(Sheets, StepsInAllSheetsAtOnceLeaveAValidMesh) {
  EXPECT_TRUE(rc::check([] {
    Bench b;
    const auto before = areas(b);
    std::vector<std::vector<std::size_t>> places(b.brep.sheets.size());
    for (auto& of_sheet : places) of_sheet = *rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange(0, 300));
    const auto some_steps = [&](Editor& sheet) {
      for (const std::size_t place : places[sheet.mesh().face(FaceId(std::size_t{0})).sheet.value]) {
        const LocalFace face = sheet.mesh().face(FaceId(place % sheet.mesh().n_faces()));
        if (!face.alive) continue;
        if (place % 2 == 0) sheet.remove(face.v[place % 3]);
        if (place % 2 == 1 && !face.curve[place % 3].valid()) sheet.split(face.v[place % 3], face.v[(place + 1) % 3]);
      }
    };
    in_each_sheet(b.editor, some_steps);
    in_each_sheet(b.editor, some_steps);
    RC_ASSERT(broken_law(b, before) == std::string());
  }));
}

TEST(Sheets, TwoSheetsDoNotGetTheSameEdge) {
  for (const std::size_t n : {5, 6, 7, 8}) {
    Bench b(pillow(n));
    ASSERT_EQ(b.brep.sheets.size(), 2u);
    const auto before = areas(b);
    in_each_sheet(b.editor, [&](Editor& sheet) {
      for (std::size_t v = 0; v < sheet.mesh().n_vertices(); ++v) sheet.remove(VertexId(v));
    });
    EXPECT_EQ(broken_law(b, before), "");
    const auto left = faces_of(b.editor.mesh());
    EXPECT_LE(left.size(), 2 * n - 2) << "no sheet has been filled without its vertex";
  }
}

TEST(Editor, UndoGivesBackEveryFaceAndPlace) {
  EXPECT_TRUE(rc::check([] {
    Bench b;
    for (int step = 0; step < 20; ++step) random_step(b.editor);
    const auto faces = faces_of(b.editor.mesh());
    std::vector<Vec3> places;
    for (std::size_t v = 0; v < b.editor.mesh().n_vertices(); ++v)
      places.push_back(b.editor.mesh().position(VertexId(v)));
    const auto mark = b.editor.mark();
    for (int step = 0; step < 60; ++step) random_step(b.editor);
    b.editor.undo(mark);
    RC_ASSERT(faces_of(b.editor.mesh()) == faces);
    RC_ASSERT(b.editor.mesh().n_vertices() == places.size());
    for (std::size_t v = 0; v < places.size(); ++v) RC_ASSERT(b.editor.mesh().position(VertexId(v)) == places[v]);
  }));
}

TEST(Editor, CornersAndVerticesAtTheRimOfTheZoneStay) {
  Bench b;
  const LocalMesh& mesh = b.editor.mesh();
  for (std::size_t k = 0; k < b.scene.complex.n_vertices(); ++k) {
    if (b.brep.dimension[k] != Dimension::kCorner) continue;
    EXPECT_FALSE(b.editor.remove(VertexId(k)));
    EXPECT_FALSE(b.editor.relax(VertexId(k)));
  }
  b.in_zone[5] = 0;
  Editor narrow(b.scene.complex, b.brep, b.in_zone, uniform(), {});
  for (const VertexId v : mesh.face(FaceId(std::size_t{5})).v) {
    EXPECT_FALSE(narrow.remove(v));
    EXPECT_FALSE(narrow.sharpen(v));
  }
}

TEST(Editor, RemovingACurveVertexJoinsItsNeighboursOnAllSheets) {
  Bench b;
  std::size_t removed = 0;
  for (std::size_t k = 0; k < b.scene.complex.n_vertices(); ++k) {
    const VertexId v(k);
    if (!b.editor.mesh().vertex(v).curve.valid() || b.editor.mesh().vertex(v).fixed) continue;
    const auto span = b.editor.reach(v);
    ASSERT_TRUE(span.has_value());
    const std::size_t n = b.editor.mesh().faces_at(v, span->before).size();
    if (!b.editor.remove(v)) continue;
    ++removed;
    EXPECT_EQ(b.editor.mesh().faces_at(span->before, span->after).size(), n);
  }
  EXPECT_GT(removed, 20u);
}

TEST(Editor, RelaxingNeverRaisesTheCostAndSharpeningNeverLowersTheWorstQ) {
  EXPECT_TRUE(rc::check([] {
    Bench b;
    for (int step = 0; step < 30; ++step) random_step(b.editor);
    const auto v = VertexId(*rc::gen::inRange<std::size_t>(0, b.editor.mesh().n_vertices()));
    const auto star = b.editor.mesh().star(v);
    if (star.empty()) return;
    const double cost = b.editor.cost(star);
    if (b.editor.relax(v)) RC_ASSERT(b.editor.cost(b.editor.mesh().star(v)) < cost);
    const auto worst = [&] {
      double q = 1;
      for (const FaceId f : b.editor.mesh().star(v)) q = std::min(q, b.editor.mesh().face(f).q);
      return q;
    };
    const double before = worst();
    if (b.editor.sharpen(v)) RC_ASSERT(worst() > before);
  }));
}

}  // namespace
}  // namespace meshgraft
