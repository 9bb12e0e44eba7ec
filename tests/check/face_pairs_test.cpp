#include "check/face_pairs.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <optional>

#include "geometry/predicates.hpp"

namespace meshgraft {
namespace {

using Corners = std::array<std::uint32_t, 3>;

bool meet(const Corners& va, const Triangle& a, const Corners& vb, const Triangle& b) {
  const bool result = meet_beyond_shared(va, a, vb, b);
  // The order of the faces and of their corners does not matter.
  EXPECT_EQ(result, meet_beyond_shared(vb, b, va, a));
  EXPECT_EQ(result,
            meet_beyond_shared({va[1], va[2], va[0]}, {a[1], a[2], a[0]}, {vb[2], vb[1], vb[0]}, {b[2], b[1], b[0]}));
  return result;
}

const Triangle kBase{Vec3{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
constexpr Corners kOwn{0, 1, 2}, kOther{3, 4, 5};

TEST(FacePairs, CrossingFacesMeet) { EXPECT_TRUE(meet(kOwn, kBase, kOther, {Vec3{1, 1, -1}, {1, 1, 1}, {2, 5, 0.5}})); }

TEST(FacePairs, FacesThatTouchWithoutSharingMeet) {
  EXPECT_TRUE(meet(kOwn, kBase, kOther, {Vec3{1, 1, 0}, {1, 1, 1}, {2, 1, 1}}));    // a corner in the face
  EXPECT_TRUE(meet(kOwn, kBase, kOther, {Vec3{2, 0, 0}, {2, -1, 1}, {3, -1, 1}}));  // a corner on an edge
  EXPECT_TRUE(meet(kOwn, kBase, kOther, {Vec3{4, 0, 0}, {5, 0, 1}, {5, 1, 1}}));    // corner on corner
}

TEST(FacePairs, OneUlpDecides) {
  const double up = std::nextafter(0.0, 1.0) * 0x1p600;  // the least that products of three still see
  EXPECT_FALSE(meet(kOwn, kBase, kOther, {Vec3{1, 1, up}, {1, 1, 1}, {2, 1, 1}}));
  const double on = 1 + 0.25, above = std::nextafter(on, 2);
  const Triangle base{Vec3{0, 0, on}, {4, 0, on}, {0, 4, on}};
  EXPECT_TRUE(meet(kOwn, base, kOther, {Vec3{1, 1, on}, {1, 1, 3}, {2, 1, 3}}));
  EXPECT_FALSE(meet(kOwn, base, kOther, {Vec3{1, 1, above}, {1, 1, 3}, {2, 1, 3}}));
}

TEST(FacePairs, NeighboursAtAnEdgeDoNotMeet) {
  EXPECT_FALSE(meet(kOwn, kBase, {1, 0, 3}, {kBase[1], kBase[0], Vec3{2, -3, 0}}));  // flat
  EXPECT_FALSE(meet(kOwn, kBase, {1, 0, 3}, {kBase[1], kBase[0], Vec3{2, 3, 1}}));   // folded
  EXPECT_FALSE(meet(kOwn, kBase, {1, 0, 3}, {kBase[1], kBase[0], Vec3{2, 3, 1e-300}}));
}

TEST(FacePairs, NeighboursFoldedFlatMeet) {
  EXPECT_TRUE(meet(kOwn, kBase, {1, 0, 3}, {kBase[1], kBase[0], Vec3{2, 3, 0}}));
  EXPECT_TRUE(meet(kOwn, kBase, {1, 0, 3}, {kBase[1], kBase[0], Vec3{-50, 1e-6, 0}}));
}

TEST(FacePairs, FacesOnTheSameNodesMeet) { EXPECT_TRUE(meet(kOwn, kBase, {2, 1, 0}, {kBase[2], kBase[1], kBase[0]})); }

TEST(FacePairs, NeighboursAtANodeMeetOnlyBeyondIt) {
  const Vec3 o = kBase[0];
  EXPECT_FALSE(meet(kOwn, kBase, {0, 3, 4}, {o, Vec3{-1, 0, 0}, {0, -1, 0}}));
  EXPECT_FALSE(meet(kOwn, kBase, {0, 3, 4}, {o, Vec3{1, 1, 1}, {2, 1, 1}}));
  EXPECT_TRUE(meet(kOwn, kBase, {0, 3, 4}, {o, Vec3{1, 1, 1}, {1, 1, -1}}));  // crosses
  EXPECT_TRUE(meet(kOwn, kBase, {0, 3, 4}, {o, Vec3{9, 9, 9}, {9, 9, -9}}));  // so, and is larger
  EXPECT_TRUE(meet(kOwn, kBase, {0, 3, 4}, {o, Vec3{1, 1, 0}, {0, 0, 5}}));   // an edge in the face
  EXPECT_TRUE(meet(kOwn, kBase, {0, 3, 4}, {o, Vec3{2, 0, 0}, {0, -1, 0}}));  // edges on one another
  EXPECT_TRUE(meet(kOwn, kBase, {0, 3, 4}, {o, Vec3{9, 0, 0}, {0, -1, 7}}));
  EXPECT_TRUE(meet(kOwn, kBase, {0, 3, 4}, {o, Vec3{1, 2, 0}, {2, 1, 0}}));  // inside
}

/// Points of a small grid: nearly all degenerate positions occur.
Vec3 grid_point() {
  const auto c = [] { return *rc::gen::element(0.0, 1.0, 2.0, 3.0); };
  const double x = c(), y = c(), z = c();
  return {x, y, z};
}

/// Whether two closed triangles meet, by clipping in exact integer arithmetic: a common point exists if and
/// only if the linear programme in barycentric coordinates is feasible. Points of the grid are small integers,
/// so that scaled coordinates stay exact in doubles.
bool share_a_point_brute(const Triangle& a, const Triangle& b) {
  // The common points form a convex polygon; if there are any, there is one among: corners of one in the
  // other, crossings of an edge of one with the other face, crossings of two edges.
  const auto in = [](Vec3 p, const Triangle& t) {  // exact for integers
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    if (dot(n, p - t[0]) != 0) return false;
    for (std::size_t k = 0; k < 3; ++k)
      if (dot(cross(t[(k + 1) % 3] - t[k], p - t[k]), n) < 0) return false;
    return true;
  };
  for (const Vec3 p : a)
    if (in(p, b)) return true;
  for (const Vec3 p : b)
    if (in(p, a)) return true;
  const auto edge_through = [](Vec3 x, Vec3 y, const Triangle& t) {
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    const double hx = dot(n, x - t[0]), hy = dot(n, y - t[0]);
    if (!((hx < 0 && hy > 0) || (hx > 0 && hy < 0))) return false;
    // p = x + hx / (hx - hy) (y - x), scaled by |hx - hy|.
    const double w = std::abs(hx - hy), s = std::abs(hx);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 from = w * (x - t[k]) + s * (y - x);
      if (dot(cross(t[(k + 1) % 3] - t[k], from), n) < 0) return false;
    }
    return true;
  };
  const auto edges_cross = [](Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1) {
    const Vec3 u = a1 - a0, v = b1 - b0, n = cross(u, v);
    if (squared_norm(n) == 0 || dot(n, b0 - a0) != 0) return false;
    const double s = dot(cross(b0 - a0, v), n), t = dot(cross(b0 - a0, u), n), whole = squared_norm(n);
    return s >= 0 && s <= whole && t >= 0 && t <= whole;
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (edge_through(a[k], a[(k + 1) % 3], b) || edge_through(b[k], b[(k + 1) % 3], a)) return true;
    for (std::size_t l = 0; l < 3; ++l)
      if (edges_cross(a[k], a[(k + 1) % 3], b[l], b[(l + 1) % 3])) return true;
  }
  return false;
}

bool has_area(const Triangle& t) { return squared_norm(cross(t[1] - t[0], t[2] - t[0])) > 0; }

RC_GTEST_PROP(FacePairs, AgreesWithBruteForceOnAGrid, ()) {
  const Triangle a{grid_point(), grid_point(), grid_point()}, b{grid_point(), grid_point(), grid_point()};
  RC_PRE(has_area(a) && has_area(b));
  RC_ASSERT(meet(kOwn, a, kOther, b) == share_a_point_brute(a, b));
}

RC_GTEST_PROP(FacePairs, AtASharedNodeAgreesWithFacesCutOffNearIt, ()) {
  // Without a small piece at the shared node, faces on the grid that meet beyond it still do, and others do not.
  const Vec3 p = grid_point();
  const Triangle a{p, grid_point(), grid_point()}, b{p, grid_point(), grid_point()};
  RC_PRE(has_area(a) && has_area(b));
  bool cut_meet = false;
  // The opposite edges, as triangles with a corner near p, on a grid 64 times finer.
  const auto near = [&](Vec3 q) { return 64.0 * p + (q - p); };
  for (int half_a = 0; half_a < 2; ++half_a)
    for (int half_b = 0; half_b < 2; ++half_b) {
      const auto half = [&](const Triangle& t, int h) {
        const Vec3 q = 64.0 * t[1], r = 64.0 * t[2];
        return h == 0 ? Triangle{near(t[1]), q, r} : Triangle{near(t[1]), r, near(t[2])};
      };
      cut_meet = cut_meet || share_a_point_brute(half(a, half_a), half(b, half_b));
    }
  // Faces of one node whose common part is a ray within them reach beyond the cut.
  RC_ASSERT(meet({0, 1, 2}, a, {0, 3, 4}, b) == cut_meet);
}

RC_GTEST_PROP(FacePairs, AllPairsAreThoseOfBruteForceOnes, ()) {
  std::vector<Vec3> position;
  const int n = *rc::gen::element(5, 8, 12);
  for (int i = 0; i < n; ++i) {
    const Vec3 p = grid_point();
    if (std::ranges::find(position, p) == position.end()) position.push_back(p);
  }
  RC_PRE(position.size() >= 4u);
  std::vector<Corners> faces;
  std::vector<std::uint8_t> fresh;
  const auto any = [&] { return *rc::gen::arbitrary<std::uint32_t>() % static_cast<std::uint32_t>(position.size()); };
  for (int i = 0; i < 8; ++i) {
    const std::uint32_t a = any(), b = any(), c = any();
    faces.push_back({a, b, c});
    fresh.push_back(*rc::gen::element<std::uint8_t>(0, 1));
  }
  const auto triangle = [&](std::size_t f) {
    return Triangle{position[faces[f][0]], position[faces[f][1]], position[faces[f][2]]};
  };
  std::vector<std::array<std::uint32_t, 2>> expected;
  for (std::uint32_t i = 0; i < faces.size(); ++i)
    for (std::uint32_t j = i + 1; j < faces.size(); ++j)
      if ((fresh[i] || fresh[j]) && has_area(triangle(i)) && has_area(triangle(j)) &&
          meet_beyond_shared(faces[i], triangle(i), faces[j], triangle(j)))
        expected.push_back({i, j});
  RC_ASSERT(intersecting_pairs(position, faces, fresh) == expected);
}

}  // namespace
}  // namespace meshgraft
