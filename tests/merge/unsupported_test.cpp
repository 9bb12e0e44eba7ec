#include "merge/unsupported.hpp"

#include <gtest/gtest.h>

#include <array>

#include "meshgraft/merge.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

/// The unit square in the plane z = 0 as one quadrilateral, with a triangle at its side x = 1.
Model square(Shape shape = Shape::kQuad) {
  ModelBuilder b;
  std::vector<NodeId> ring;
  const std::array<Vec3, 4> corner{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  for (std::size_t k = 0; k < 4; ++k) {
    ring.push_back(b.add_node(corner[k]));
    if (shape == Shape::kQuad8) ring.push_back(b.add_node(midpoint(corner[k], corner[(k + 1) % 4])));
  }
  ElementAttributes a;
  a.shape = shape;
  b.add_element(a, ring, 77);
  const std::size_t step = shape == Shape::kQuad8 ? 2 : 1;
  b.add_face(ring[step], b.add_node({2, 0.5, 0}), ring[2 * step]);
  return b.build("base.unv");
}

Result<void> meeting(const Model& base, const Model& part) {
  const std::array<const Model*, 2> inputs{&base, &part};
  return check_meeting_elements(inputs, one_for_each_input(2), Tolerance{});
}

Model standing(double x0, double x1, double below) {
  return scenes::plate({x0, 0.4, -below}, {x1 - x0, 0, 0}, {0, 0, 1}, 0.1, "PART");
}

TEST(MeetingElements, AQuadrilateralThatIsCrossedIsNamed) {
  for (const Shape shape : {Shape::kQuad, Shape::kQuad8}) {
    const auto result = meeting(square(shape), standing(0.2, 0.8, 0.33));
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().code, ErrorCode::kUnsupportedElement);
    EXPECT_NE(result.error().what.find("element 77 of base.unv"), std::string::npos);
  }
}

TEST(MeetingElements, APartThatEndsOnAQuadrilateralIsNoticed) {
  EXPECT_FALSE(meeting(square(), standing(0.2, 0.8, 0)).has_value());
  EXPECT_FALSE(meeting(square(), standing(0.2, 0.8, -1e-4)).has_value());
}

TEST(MeetingElements, APartOnTheTrianglesBesideOrAboveIsFine) {
  EXPECT_TRUE(meeting(square(), standing(1.1, 1.5, 0.33)).has_value());
  EXPECT_TRUE(meeting(square(), standing(1, 1.5, 0)).has_value());  // up to the common edge
  EXPECT_TRUE(meeting(square(), standing(0.2, 0.8, -0.1)).has_value());
}

/// The square and a plate that stands at x, in one file.
Model assembly(double x, double below) {
  const std::array models{square(), scenes::plate({x, 0.4, -below}, {0.3, 0, 0}, {0, 0, 1}, 0.3, "PART")};
  return scenes::together(models);
}

TEST(MeetingElements, AFileJoinedWithItselfNamesQuadrilateralsThatAnotherMeshOfItMeets) {
  const auto code = [](const Model& model) {
    const auto result = merge(model, {});
    return result ? ErrorCode::kCannotHold : result.error().code;
  };
  for (const double below : {0.33, 0.0}) {
    EXPECT_EQ(code(assembly(0.3, below)), ErrorCode::kUnsupportedElement);
    EXPECT_NE(code(assembly(1.2, below)), ErrorCode::kUnsupportedElement);  // on the triangle beside it
  }
}

TEST(MeetingElements, QuadrilateralsOfThePartCountToo) {
  EXPECT_FALSE(meeting(standing(0.2, 0.8, 0.33), square()).has_value());
}

}  // namespace
}  // namespace meshgraft
