#include "intersect/meeting.hpp"

#include <gtest/gtest.h>

#include <array>
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

/// What is above a corner that it cannot become, as the edge between them would collapse, has its foot in the corner:
/// whether rounding puts that inside the face is chance, and a vertex there would be in one place with the corner.
TEST(Meeting, NothingLandsInAFaceAtItsCorner) {
  const Model below = face({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  const Model above = face({0, 0, 0}, {kOff, kOff, 0.5}, {-3, -3, 1});
  GroupSets sets;
  Complex complex = checks::complex_of({below, above}, sets);
  CorefineOptions options;
  options.tolerance = {0.6, false};
  const std::vector<double> size(complex.n_faces(), 4);
  const SnapRule rule(4, options, true);
  const std::vector<std::array<FaceId, 2>> pairs{{FaceId(0), FaceId(1)}};
  const std::vector<std::uint8_t> first{1, 0}, second{0, 1};
  Meeting m = make_meeting(complex, sets, size, {}, rule, pairs, first, second, {radians(30), true});
  const VertexId over = complex.face[1][1];
  declare_vertices(m);
  EXPECT_FALSE(m.any_symbol(1, over, [](const Symbol& s) { return s.on[0].kind == Carrier::kFace; }));
  EXPECT_EQ(complex.position[over.value].z, 0.5);
}

}  // namespace
}  // namespace meshgraft
