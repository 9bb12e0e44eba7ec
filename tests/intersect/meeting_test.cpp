#include "intersect/meeting.hpp"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/angles.hpp"
#include "intersect/checks.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

constexpr double kOff = 1e-12;  // as far as rounding puts what is above a corner

Model face(Vec3 a, Vec3 b, Vec3 c) {
  ModelBuilder builder;
  builder.add_to_group("F", builder.add_face(builder.add_node(a), builder.add_node(b), builder.add_node(c)));
  return builder.build("face");
}

/// Two units square, with a node `foot` around its middle, and a wall of unit height on the line through that; the
/// floor is a hollow along y, down to the foot.
Model floor_and_wall(Vec3 foot, bool wall_along_x) {
  ModelBuilder builder;
  const NodeId middle = builder.add_node(foot), left = builder.add_node({-1, 0, 0}),
               right = builder.add_node({1, 0, 0}), front = builder.add_node({0, -1, foot.z}),
               back = builder.add_node({0, 1, foot.z}), top = builder.add_node({0, 0, 1});
  const auto add = [&](NodeId a, NodeId b) { builder.add_to_group("F", builder.add_face(middle, a, b)); };
  add(right, back), add(back, left), add(left, front), add(front, right);
  const NodeId from = wall_along_x ? right : front, to = wall_along_x ? left : back;
  add(from, top), add(top, to);
  return builder.build("floor and wall");
}

/// All pairs of faces of two meshes with edges of about unit length.
struct Met {
  Met(const Model& below, const Model& above, double tolerance)
      : complex(checks::complex_of({below, above}, sets)), size(complex.n_faces(), 1) {
    options.tolerance = {tolerance, false};
    for (std::size_t f = 0; f < complex.n_faces(); ++f) {
      first.push_back(complex.component[f] == 0), second.push_back(complex.component[f] != 0);
      for (std::size_t g = 0; g < complex.n_faces(); ++g)
        if (complex.component[f] == 0 && complex.component[g] != 0) pairs.push_back({FaceId(f), FaceId(g)});
    }
    meeting.emplace(
        make_meeting(complex, sets, size, {}, SnapRule(4, options, true), pairs, first, second, {radians(30), true}));
  }
  [[nodiscard]] VertexId vertex(std::size_t component, Vec3 p) const {
    for (std::size_t f = 0; f < complex.n_faces(); ++f)
      for (const VertexId v : complex.face[f])
        if (complex.component[f] == component && complex.position[v.value] == p) return v;
    return {};
  }

  GroupSets sets;
  Complex complex;
  std::vector<double> size;
  CorefineOptions options;
  std::vector<std::array<FaceId, 2>> pairs;
  std::vector<std::uint8_t> first, second;
  std::optional<Meeting> meeting;
};

/// What is above a corner that it cannot become, as the edge between them would collapse, has its foot in the corner:
/// whether rounding puts that inside the face is chance, and a vertex there would be in one place with the corner.
TEST(Meeting, NothingLandsInAFaceAtItsCorner) {
  Met met(face({0, 0, 0}, {4, 0, 0}, {0, 4, 0}), face({0, 0, 0}, {kOff, kOff, 0.5}, {-3, -3, 1}), 0.6);
  met.size.assign(met.size.size(), 4);
  Meeting& m = *met.meeting;
  const VertexId over = met.vertex(1, {kOff, kOff, 0.5});
  declare_vertices(m);
  EXPECT_FALSE(m.any_symbol(1, over, [](const Symbol& s) { return s.on[0].kind == Carrier::kFace; }));
  EXPECT_EQ(m.at(over).z, 0.5);
}

/// The end of a stiffener is drawn along the floor to the foot of a wall, beside a node of that: as another place it
/// would be met by all edges of the node, a few weld lengths away.
TEST(Meeting, WhatLandsOnAnEdgeBesideItsEndLandsOnThat) {
  constexpr double kBeside = 5e-6, kGap = 0.05;
  Met met(floor_and_wall({0, 0, 0}, true), face({kBeside, kGap, 0}, {kBeside, 1, 0}, {kBeside, 0.5, 1}), 0.1);
  Meeting& m = *met.meeting;
  const VertexId end = met.vertex(1, {kBeside, kGap, 0}), node = met.vertex(0, {0, 0, 0});
  declare_vertices(m);
  EXPECT_TRUE(m.any_symbol(1, end, [&](const Symbol& s) { return s.vertex == node; }));
  EXPECT_EQ(m.at(end), m.at(node));
}

/// A stringer on a hollow skin, at a node of the line in which the skin and a frame have met: its free edge is a chord
/// of the hollow, beside that node as seen along the skin, and is welded to the frame, too. Between the node and what
/// the frame's faces meet of the edge below there would be one place twice.
TEST(Meeting, AChordPassesTheNodeBeneathItWhereAFrameEndsThere) {
  constexpr double kBeside = 1e-4, kGap = 0.02;
  Met met(floor_and_wall({0, kBeside, -kGap}, false), face({-1, 0, 0}, {1, 0, 0}, {0.2, 0, 1}), 0.1);
  Meeting& m = *met.meeting;
  declare_vertices(m);
  EXPECT_TRUE(m.any_symbol(0, met.vertex(0, {0, kBeside, -kGap}),
                           [](const Symbol& s) { return s.on[1].kind == Carrier::kEdge; }));
}

/// A chord in the plane z = 0 and a brace on it, in y z: they have met on the y axis.
Model chord_and_brace() {
  ModelBuilder builder;
  const NodeId foot = builder.add_node({0, 0, 0}), left = builder.add_node({-1, 0, 0}),
               right = builder.add_node({1, 0, 0}), front = builder.add_node({0, -1, 0}),
               back = builder.add_node({0, 1, 0}), top = builder.add_node({0, 0, 1});
  for (const auto& [a, b] :
       {std::pair{right, back}, {back, left}, {left, front}, {front, right}, {front, top}, {top, back}})
    builder.add_to_group("F", builder.add_face(foot, a, b));
  return builder.build("chord and brace");
}

// Beside the line in which brace and chord have met; an edge of the chord is nearer.
constexpr Vec3 kBesideLine{0.1, 0.02, 0.05};
const Model kGusset = face(kBesideLine, {1, 0.2, 0.05}, {0.1, 0.02, 1});

/// What lands on the nearer edge would leave a sliver between the gusset and the brace.
TEST(Meeting, ACornerLandsOnALineInReachAlthoughAMereEdgeIsNearer) {
  Met met(chord_and_brace(), kGusset, 0.2);
  Meeting& m = *met.meeting;
  const VertexId corner = met.vertex(1, kBesideLine);
  declare_vertices(m);
  EXPECT_EQ(m.at(corner).x, 0);
  EXPECT_EQ(m.at(corner).z, 0);
}

/// Vertices of the first side stay, and the second bends to them: the less the nearer the edge is.
TEST(Meeting, ACornerOfTheFirstSideTakesTheNearestEdge) {
  Met met(kGusset, chord_and_brace(), 0.2);
  Meeting& m = *met.meeting;
  const VertexId corner = met.vertex(0, kBesideLine);
  declare_vertices(m);
  EXPECT_TRUE(m.any_symbol(0, corner, [&](const Symbol& s) {
    return s.on[1].kind == Carrier::kEdge && !m.side[1].is_line_edge(s.on[1].id);
  }));
}

}  // namespace
}  // namespace meshgraft
