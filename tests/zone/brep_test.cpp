#include "zone/brep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "complexes.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

using test::Joined;
using test::joined;
using test::vertex_at;

/// What every Brep must fulfil.
void expect_consistent(const Complex& complex, const Brep& brep) {
  ASSERT_EQ(brep.dimension.size(), complex.n_vertices());
  ASSERT_EQ(brep.sheet_of_face.size(), complex.n_faces());
  std::vector<int> curves_inside(complex.n_vertices(), 0);
  std::set<std::array<VertexId, 2>> seen;
  for (const Curve& curve : brep.curves) {
    ASSERT_GE(curve.chain.size(), 2u);
    EXPECT_EQ(curve.lines.size(), curve.lines_per_edge * (curve.chain.size() - 1));
    for (std::size_t i = 0; i < curve.chain.size(); ++i) {
      const bool end = !curve.closed && (i == 0 || i + 1 == curve.chain.size());
      EXPECT_EQ(brep.dimension[curve.chain[i].value], end ? Dimension::kCorner : Dimension::kCurve);
      if (!end && i > 0) {
        EXPECT_EQ(++curves_inside[curve.chain[i].value], 1);
      }
      if (i == 0) continue;
      const auto edge = std::minmax(curve.chain[i - 1], curve.chain[i]);
      EXPECT_TRUE(seen.insert({edge.first, edge.second}).second) << "an edge on two curves";
    }
    if (curve.closed) {
      EXPECT_EQ(curve.chain.front(), curve.chain.back());
      EXPECT_EQ(curve.chain.front(), *std::ranges::min_element(curve.chain));
    }
  }
  std::size_t faces = 0;
  for (std::size_t s = 0; s < brep.sheets.size(); ++s) {
    const Sheet& sheet = brep.sheets[s];
    EXPECT_TRUE(std::ranges::is_sorted(sheet.faces));
    faces += sheet.faces.size();
    for (const FaceId f : sheet.faces) {
      EXPECT_EQ(brep.sheet_of_face[f.value], SheetId(s));
      EXPECT_EQ(complex.face_groups[f.value], complex.face_groups[sheet.faces[0].value]);
    }
  }
  EXPECT_EQ(faces, complex.n_faces());
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(complex.face[f][k], complex.face[f][(k + 1) % 3]);
      EXPECT_EQ(brep.curve_of_edge[f][k].valid(), seen.contains({a, b}));
    }
}

Brep read(Joined& j, std::span<const VertexId> points = {}, const BrepOptions& options = {}) {
  Brep brep = read_brep(j.complex, j.junction_edges, points, j.groups, options);
  expect_consistent(j.complex, brep);
  return brep;
}

std::size_t n_corners(const Brep& brep) {
  return static_cast<std::size_t>(std::ranges::count(brep.dimension, Dimension::kCorner));
}

Model plate(double size = 1) { return scenes::plate({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, size); }
Model wall() { return scenes::plate({0, 2, 0}, {4, 0, 0}, {0, 0, 2}, 1, "WALL"); }

TEST(Brep, PlateIsOnePlanarSheetInFourCurves) {
  Joined j = joined(std::array{plate()});
  const Brep brep = read(j);
  ASSERT_EQ(brep.sheets.size(), 1u);
  EXPECT_TRUE(brep.sheets[0].planar);
  EXPECT_NEAR(norm(brep.sheets[0].normal - Vec3{0, 0, 1}), 0, 1e-12);
  EXPECT_EQ(brep.curves.size(), 4u);
  EXPECT_EQ(n_corners(brep), 4u);
  for (const Curve& curve : brep.curves) {
    EXPECT_TRUE(curve.free);
    EXPECT_FALSE(curve.junction || curve.fixed || curve.closed);
  }
}

TEST(Brep, OpenCylinderHasTwoClosedCurves) {
  Joined j = joined(std::array{scenes::cylinder({0, 0, 0}, {0, 0, 3}, 2, 0.5)});
  const Brep brep = read(j);
  ASSERT_EQ(brep.curves.size(), 2u);
  EXPECT_TRUE(brep.curves[0].closed && brep.curves[1].closed);
  EXPECT_EQ(n_corners(brep), 0u);
  ASSERT_EQ(brep.sheets.size(), 1u);
  EXPECT_FALSE(brep.sheets[0].planar);
}

TEST(Brep, JunctionLineIsOneCurveThatParts) {
  Joined j = joined(std::array{plate(), wall()});
  const Brep brep = read(j);
  const auto n = std::ranges::count_if(brep.curves, &Curve::junction);
  EXPECT_EQ(n, 1);
  const auto junction = std::ranges::find_if(brep.curves, &Curve::junction);
  EXPECT_EQ(junction->chain.size(), 5u);
  EXPECT_EQ(brep.sheets.size(), 3u);  // two halves of the plate, one wall
}

/// A plate with the element group LOW on its lower row of squares.
ModelBuilder two_rows(std::array<std::array<NodeId, 5>, 3>& n) {
  ModelBuilder b;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 5; ++c) n[r][c] = b.add_node({double(c), double(r), 0});
  for (std::size_t r = 0; r < 2; ++r)
    for (std::size_t c = 0; c < 4; ++c)
      for (const ElementId f :
           {b.add_face(n[r][c], n[r][c + 1], n[r + 1][c + 1]), b.add_face(n[r][c], n[r + 1][c + 1], n[r + 1][c])})
        if (r == 0) b.add_to_group("LOW", f);
  return b;
}

TEST(Brep, GroupBorderIsACurveThatNodesOfTheSameAreaDoNotBreak) {
  std::array<std::array<NodeId, 5>, 3> n;
  ModelBuilder b = two_rows(n);
  for (const auto& row : {n[0], n[1]})
    for (const NodeId node : row) b.add_to_group("LOW_NODES", node);
  Joined j = joined(std::array{b.build()});
  const Brep brep = read(j);
  EXPECT_EQ(brep.sheets.size(), 2u);
  const auto inside = std::ranges::find_if(brep.curves, [](const Curve& c) { return !c.free; });
  ASSERT_NE(inside, brep.curves.end());
  EXPECT_EQ(inside->chain.size(), 5u);
}

TEST(Brep, NodesNamedAlongALineStayUnlessTheLineIsAnEdgeOfTheShape) {
  std::array<std::array<NodeId, 5>, 3> n;
  ModelBuilder b = two_rows(n);
  for (std::size_t c = 0; c < 5; ++c) b.add_to_group("LINE", n[1][c]), b.add_to_group("RIM", n[0][c]);
  Joined j = joined(std::array{b.build()});
  const Brep brep = read(j);
  for (std::size_t c = 1; c < 4; ++c) {
    EXPECT_EQ(brep.dimension[vertex_at(j.complex, {double(c), 1, 0}).value], Dimension::kCorner);
    EXPECT_EQ(brep.dimension[vertex_at(j.complex, {double(c), 0, 0}).value], Dimension::kCurve);
  }
}

TEST(Brep, ASheetStaysPlaneWhoseBorderWasPulledALittle) {
  Joined j = joined(std::array{plate()});
  const VertexId rim = vertex_at(j.complex, {2, 0, 0}), inner = vertex_at(j.complex, {2, 2, 0});
  j.complex.position[rim.value].z = 0.005;
  Brep brep = read(j);
  ASSERT_EQ(brep.sheets.size(), 1u);
  EXPECT_TRUE(brep.sheets[0].planar);
  EXPECT_NEAR(std::abs(brep.sheets[0].normal.z), 1, 1e-12);
  j.complex.position[rim.value].z = 0.05;
  EXPECT_FALSE(read(j).sheets[0].planar) << "too far off";
  j.complex.position[rim.value].z = 0, j.complex.position[inner.value].z = 0.005;
  EXPECT_FALSE(read(j).sheets[0].planar) << "its inside tells the plane";
}

TEST(Brep, BendsOfBeamsAreCorners) {
  // The lower rim is an arc that turns by 5 degrees at each node: too little for a corner by itself.
  Joined j = joined(std::array{plate()});
  for (std::size_t v = 0; v < j.complex.n_vertices(); ++v) {
    Vec3& p = j.complex.position[v];
    if (p.y == 0) p.y = 0.5 * std::pow(p.x - 2, 2) * std::tan(5 * std::numbers::pi / 180) - 1;
  }
  const auto corners_on_rim = [&] {
    const Brep brep = read(j);
    std::size_t n = 0;
    for (std::size_t v = 0; v < j.complex.n_vertices(); ++v)
      n += j.complex.position[v].y < 0 && brep.dimension[v] == Dimension::kCorner;
    return n;
  };
  const std::size_t before = corners_on_rim();
  std::vector<VertexId> rim;
  for (std::size_t v = 0; v < j.complex.n_vertices(); ++v)
    if (j.complex.position[v].y < 0) rim.emplace_back(v);
  std::ranges::sort(rim, {}, [&](VertexId v) { return j.complex.position[v.value].x; });
  for (std::size_t k = 1; k < rim.size(); ++k)
    j.complex.lines.push_back({{rim[k - 1], rim[k]}, {}, GroupSets::kEmpty, {}});
  EXPECT_EQ(before, 2u);
  EXPECT_EQ(corners_on_rim(), rim.size());
}

TEST(Brep, LoneGroupNodeStays) {
  Model m = plate();
  Joined j = joined(std::array{m});
  const VertexId inner = vertex_at(j.complex, {2, 2, 0}), rim = vertex_at(j.complex, {2, 0, 0});
  const GroupSetId set = j.groups.intern({GroupId(std::size_t{7})});
  j.complex.vertex_groups[inner.value] = j.complex.vertex_groups[rim.value] = set;
  const Brep brep = read(j);
  EXPECT_EQ(brep.dimension[inner.value], Dimension::kCorner);
  EXPECT_EQ(brep.dimension[rim.value], Dimension::kCorner);
  EXPECT_EQ(n_corners(brep), 6u);
}

TEST(Brep, NodeGroupOverAnAreaProtectsOnlyNodesOffItsFaces) {
  Joined j = joined(std::array{plate()});
  const GroupSetId set = j.groups.intern({GroupId(std::size_t{7})});
  for (auto& groups : j.complex.vertex_groups) groups = set;
  EXPECT_EQ(n_corners(read(j)), 4u);
  // A group that ends inside the plate holds its last row there.
  for (std::size_t v = 0; v < j.complex.n_vertices(); ++v)
    if (j.complex.position[v].x > 2.5) j.complex.vertex_groups[v] = GroupSets::kEmpty;
  const Brep brep = read(j);
  for (std::size_t v = 0; v < j.complex.n_vertices(); ++v) {
    const Vec3 p = j.complex.position[v];
    if (p.x == 2 && p.y > 0 && p.y < 4) {
      EXPECT_EQ(brep.dimension[v], Dimension::kCorner);
    } else if (p.x == 1 && p.y > 0 && p.y < 4) {
      EXPECT_EQ(brep.dimension[v], Dimension::kSheet);
    }
  }
}

TEST(Brep, PinnedAndFrozenVerticesStay) {
  Joined j = joined(std::array{plate()});
  const VertexId pinned = vertex_at(j.complex, {2, 2, 0}), frozen = vertex_at(j.complex, {0, 2, 0});
  j.complex.state[pinned.value] = VertexState::kPinned;
  j.complex.state[frozen.value] = VertexState::kFrozen;
  const Brep brep = read(j);
  EXPECT_EQ(brep.dimension[pinned.value], Dimension::kCorner);
  EXPECT_EQ(brep.dimension[frozen.value], Dimension::kCorner);
  EXPECT_EQ(std::ranges::count_if(brep.curves, &Curve::fixed), 2);
}

TEST(Brep, BeamsMakeACurveWithTheirOrderKept) {
  ModelBuilder b;
  std::array<std::array<NodeId, 4>, 3> n;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 4; ++c) n[r][c] = b.add_node({double(c), double(r), 0});
  for (std::size_t r = 0; r < 2; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      b.add_face(n[r][c], n[r][c + 1], n[r + 1][c + 1]), b.add_face(n[r][c], n[r + 1][c + 1], n[r + 1][c]);
  // Two beams on each edge, given in opposite orders; the second kind is told apart by its property.
  for (std::size_t c = 0; c < 3; ++c)
    for (std::int64_t k = 0; k < 2; ++k) b.add_line(n[1][c], n[1][c + 1], c == 1 ? 2 - k : 1 + k);
  Joined j = joined(std::array{b.build()});
  const Brep brep = read(j);
  const auto it = std::ranges::find_if(brep.curves, [](const Curve& c) { return c.lines_per_edge > 0; });
  ASSERT_NE(it, brep.curves.end());
  ASSERT_EQ(it->lines_per_edge, 2u);
  ASSERT_EQ(it->chain.size(), 4u);
  for (std::size_t i = 0; i < it->lines.size(); ++i) {
    const auto& line = j.complex.lines[it->lines[i]];
    EXPECT_EQ(line.attributes, j.complex.lines[it->lines[i % 2]].attributes);
    EXPECT_EQ(std::minmax(line.ends[0], line.ends[1]), std::minmax(it->chain[i / 2], it->chain[i / 2 + 1]));
  }
}

TEST(Brep, BeamAcrossFacesHoldsItsEnds) {
  Joined j = joined(std::array{plate()});
  const VertexId a = vertex_at(j.complex, {1, 1, 0}), b = vertex_at(j.complex, {3, 3, 0});
  j.complex.lines.push_back({{a, b}, {}, GroupSets::kEmpty, {}});
  const Brep brep = read(j);
  EXPECT_EQ(brep.dimension[a.value], Dimension::kCorner);
  EXPECT_EQ(brep.dimension[b.value], Dimension::kCorner);
}

TEST(Brep, FlippedFaceIsBoundedByACurve) {
  Joined j = joined(std::array{plate()});
  std::swap(j.complex.face[12][0], j.complex.face[12][1]);
  EXPECT_EQ(read(j).sheets.size(), 2u);
}

TEST(Brep, SurfacesThatTouchInOneVertexHaveACornerThere) {
  ModelBuilder b;
  const NodeId o = b.add_node({0, 0, 0});
  for (const double z : {-1.0, 1.0}) {
    std::vector<NodeId> ring;
    for (int i = 0; i < 12; ++i) {
      const double a = 2 * std::numbers::pi * i / 12;
      ring.push_back(b.add_node({2 * std::cos(a), 2 * std::sin(a), z * 0.3}));
    }
    for (std::size_t i = 0; i < 12; ++i) b.add_face(o, ring[i], ring[(i + 1) % 12]);
  }
  Joined j = joined(std::array{b.build()});
  const Brep brep = read(j);
  EXPECT_EQ(brep.dimension[0], Dimension::kCorner);
  EXPECT_EQ(brep.sheets.size(), 2u);
}

TEST(Brep, NoiseOfAVeryShortEdgeIsNoCorner) {
  // A free edge with a node 1e-3 beside another one, 5e-4 off the line: local turns of 27 and 45 degrees.
  ModelBuilder b;
  const std::array<Vec3, 5> low{Vec3{0, 0, 0}, {1, 0, 0}, {1.001, 0.0008, 0}, {2, 0, 0}, {3, 0, 0}};
  std::vector<NodeId> l, h;
  for (const Vec3 p : low) l.push_back(b.add_node(p)), h.push_back(b.add_node({p.x, 1, 0}));
  for (std::size_t i = 0; i < 4; ++i) b.add_face(l[i], l[i + 1], h[i + 1]), b.add_face(l[i], h[i + 1], h[i]);
  Joined j = joined(std::array{b.build()});
  // All faces descend from one input face, as after corefinement.
  for (auto& parent : j.complex.parent) parent = j.complex.parent[0];
  const Brep brep = read(j);
  EXPECT_EQ(n_corners(brep), 4u);
}

TEST(Brep, ChamferIsOneCorner) {
  ModelBuilder b;
  const std::array<Vec3, 4> rim{Vec3{-1, 0, 0}, {-0.002, 0, 0}, {0, 0.002, 0}, {0, 1, 0}};
  std::vector<NodeId> n;
  for (const Vec3 p : rim) n.push_back(b.add_node(p));
  const NodeId far = b.add_node({-1, 1, 0});
  for (std::size_t i = 0; i + 1 < n.size(); ++i) b.add_face(n[i], n[i + 1], far);
  Joined j = joined(std::array{b.build()});
  for (auto& parent : j.complex.parent) parent = j.complex.parent[0];
  const Brep brep = read(j);
  EXPECT_EQ(n_corners(brep), 4u);
}

TEST(Brep, ATurnNearACornerIsNoCornerAndMakesNoneOfItsNeighbour) {
  // A strip 0.05 wide, cut out of one large face, hangs on the edge of a wall that stands on it. Its end turns by 90
  // degrees, nearer to the corner at the wall than a turn is measured; the vertex beside it is a little farther off.
  ModelBuilder b;
  const std::array<double, 3> x{-4, -0.02, 0};
  std::vector<NodeId> low, edge, high;
  for (const double at : x) {
    low.push_back(b.add_node({at, 0, 0}));
    edge.push_back(b.add_node({at, 0.05, 0}));
    high.push_back(b.add_node({at, 0.05, 1}));
  }
  for (std::size_t i = 0; i < 2; ++i) {
    b.add_face(low[i], low[i + 1], edge[i + 1]), b.add_face(low[i], edge[i + 1], edge[i]);
    b.add_face(edge[i], edge[i + 1], high[i + 1]), b.add_face(edge[i], high[i + 1], high[i]);
  }
  Joined j = joined(std::array{b.build()});
  for (const std::size_t f : {1, 4, 5}) j.complex.parent[f] = j.complex.parent[0];
  const Brep brep = read(j);
  EXPECT_EQ(brep.dimension[edge[2].value], Dimension::kCorner);
  EXPECT_EQ(brep.dimension[low[1].value], Dimension::kCurve);
  EXPECT_EQ(brep.dimension[low[2].value], Dimension::kCurve);
}

TEST(Brep, RenumberingFacesChangesNothingButOrder) {
  Joined j = joined(std::array{plate(), wall()});
  const Brep brep = read(j);
  Joined r = j;
  std::ranges::reverse(r.complex.face);
  std::ranges::reverse(r.complex.parent);
  std::ranges::reverse(r.complex.component);
  std::ranges::reverse(r.complex.face_groups);
  std::ranges::reverse(r.complex.face_attributes);
  const Brep other = read(r);
  EXPECT_EQ(brep.dimension, other.dimension);
  ASSERT_EQ(brep.curves.size(), other.curves.size());
  for (std::size_t c = 0; c < brep.curves.size(); ++c) EXPECT_EQ(brep.curves[c].chain, other.curves[c].chain);
}

}  // namespace
}  // namespace meshgraft
