#include "geometry/triangle_surface.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>

namespace meshgraft {
namespace {

/// The cube [0, 1]^3; every second face is turned inside out, which must not matter.
std::vector<Triangle> cube() {
  std::vector<Triangle> faces;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double level : {0.0, 1.0}) {
      const auto corner = [&](double u, double v) {
        Vec3 p;
        p[axis] = level, p[(axis + 1) % 3] = u, p[(axis + 2) % 3] = v;
        return p;
      };
      faces.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
      faces.push_back({corner(0, 0), corner(0, 1), corner(1, 1)});
    }
  return faces;
}

TEST(TriangleSurface, TellsInsideFromOutside) {
  const TriangleSurface surface(cube());
  EXPECT_TRUE(surface.contains({0.5, 0.5, 0.5}));
  EXPECT_TRUE(surface.contains({0.25, 0.25, 0.25}));  // the way along +x runs near a diagonal
  EXPECT_TRUE(surface.contains({0.999999, 0.000001, 0.5}));
  EXPECT_FALSE(surface.contains({1.000001, 0.5, 0.5}));
  EXPECT_FALSE(surface.contains({-1, 0, 0}));  // in line with an edge
  EXPECT_FALSE(surface.contains({-0.5, 0.5, 0.5}));
  EXPECT_FALSE(surface.contains({5, 5, 5}));
}

TEST(TriangleSurface, AnswersForPointsOnIt) {
  const TriangleSurface surface(cube());
  for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{1, 0.5, 0.5}, Vec3{0.5, 0.5, 1}}) (void)surface.contains(p);
}

TEST(TriangleSurface, HolesAreOutside) {
  std::vector<Triangle> faces = cube();
  for (Triangle t : cube()) {
    for (Vec3& p : t) p = Vec3{0.25, 0.25, 0.25} + 0.5 * p;
    faces.push_back(t);
  }
  const TriangleSurface surface(faces);
  EXPECT_TRUE(surface.contains({0.1, 0.5, 0.5}));
  EXPECT_FALSE(surface.contains({0.5, 0.5, 0.5}));
}

TEST(TriangleSurface, AgreesWithTheCube) {
  EXPECT_TRUE(rc::check("a point is inside if its coordinates are between 0 and 1", [] {
    const TriangleSurface surface(cube());
    // Eighths line up with edges, corners and diagonals.
    const auto number = [] { return 0.125 * *rc::gen::inRange(-4, 13); };
    const Vec3 p{number(), number(), number()};
    bool inside = true, on_border = false;
    for (std::size_t k = 0; k < 3; ++k) {
      inside = inside && p[k] > 0 && p[k] < 1;
      on_border = on_border || p[k] == 0 || p[k] == 1;
    }
    if (!on_border) RC_ASSERT(surface.contains(p) == inside);
  }));
}

}  // namespace
}  // namespace meshgraft
