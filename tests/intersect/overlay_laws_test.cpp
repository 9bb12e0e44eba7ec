// Laws of meshes that lie on each other, over random convex plates.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>

#include "checks.hpp"
#include "geometry/quality.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

using Quad = std::array<Vec3, 4>;

/// Area that two convex quadrilaterals of one plane have in common.
double common_area(const Quad& a, const Quad& b) {
  const Vec3 n = normalized(cross(a[1] - a[0], a[3] - a[0]));
  std::vector<Vec3> p(b.begin(), b.end());
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 inward = cross(n, a[(k + 1) % 4] - a[k]);
    std::vector<Vec3> left;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec3 q = p[i], r = p[(i + 1) % p.size()];
      const double dq = dot(inward, q - a[k]), dr = dot(inward, r - a[k]);
      if (dq >= 0) left.push_back(q);
      if ((dq < 0) != (dr < 0)) left.push_back(lerp(q, r, dq / (dq - dr)));
    }
    p = left;
  }
  Vec3 sum;
  for (std::size_t i = 2; i < p.size(); ++i) sum += 0.5 * cross(p[i - 1] - p[0], p[i] - p[0]);
  return norm(sum);
}

struct Scene {
  std::vector<Model> models;
  double common = 0;
};

Quad corners(Vec3 origin, Vec3 u, Vec3 v) { return {origin, origin + u, origin + u + v, origin + v}; }

/// A base of 6 by 6 and a plate somewhere on it, both turned and shifted alike, with noise far below
/// the tolerance.
Scene any_scene() {
  const auto number = [](double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1000) / 1000.0; };
  const double turn = number(0, 3.1415), size = *rc::gen::element(1.0, 0.43, 0.8, 1.7);
  const Vec3 u{std::cos(turn), std::sin(turn), 0}, v{-u.y, u.x, 0};
  const Vec3 origin{number(-1, 5), number(-1, 5), 0};
  const double length = number(1.5, 5), width = number(1.5, 5);
  const double tilt = number(0, 1.5), noise = *rc::gen::element(0.0, 0.0, 1e-13, 1e-9);
  const auto frame = [=](Vec3 p) {
    const Vec3 shaken = p + noise * Vec3{std::sin(70 * p.x), std::sin(90 * p.y), std::sin(110 * (p.x + p.y))};
    return Vec3{shaken.x, std::cos(tilt) * shaken.y - std::sin(tilt) * shaken.z,
                std::sin(tilt) * shaken.y + std::cos(tilt) * shaken.z};
  };
  Scene s;
  s.models.push_back(
      scenes::moved(scenes::plate({0, 0, 0}, {6, 0, 0}, {0, 6, 0}, 1, "BASE", *rc::gen::element(0.0, 0.3)), frame));
  s.models.push_back(
      scenes::moved(scenes::plate(origin, length * u, width * v, size, "PART", *rc::gen::element(0.0, 0.3)), frame));
  s.common = common_area(corners({0, 0, 0}, {6, 0, 0}, {0, 6, 0}), corners(origin, length * u, width * v));
  return s;
}

double area_of_group(const Complex& c, const GroupSets& sets, std::size_t group) {
  double sum = 0;
  for (std::size_t f = 0; f < c.n_faces(); ++f)
    if (sets.contains(c.face_groups[f], GroupId(group))) sum += area(c.corners(FaceId(f)));
  return sum;
}

double area_of(const Model& m) {
  double sum = 0;
  for (std::size_t e = 0; e < m.n_elements(); ++e) sum += area(m.corners(ElementId(e)));
  return sum;
}

RC_GTEST_PROP(OverlayLaws, NoAreaIsLostOrCountedTwice, ()) {
  const Scene s = any_scene();
  RC_PRE(s.common > 0.05);
  GroupSets sets;
  const Complex before = checks::complex_of(s.models, sets);
  const auto r = corefine(before, sets, {});
  if (!r) RC_LOG() << r.error().what << '\n';
  RC_ASSERT(r.has_value());
  const Complex& after = r->complex;
  double whole = 0, layered = 0;
  for (std::size_t f = 0; f < after.n_faces(); ++f) {
    const Triangle t = after.corners(FaceId(f));
    whole += area(t);
    if (after.layer_of(FaceId(f)).parent.valid()) layered += area(t);
    RC_ASSERT(dot(area_vector(t), area_vector(s.models[after.parent[f].input].corners(after.parent[f].element))) > 0);
  }
  const double base = area_of(s.models[0]), part = area_of(s.models[1]);
  // What is snapped within the tolerance (1 % of an edge length) moves borders by as much.
  constexpr double kSnapped = 0.12;
  RC_ASSERT(std::abs(layered - s.common) <= kSnapped);
  RC_ASSERT(std::abs(whole - (base + part - s.common)) <= kSnapped);
  RC_ASSERT(std::abs(area_of_group(after, sets, 0) - base) <= 1e-6 * base);
  RC_ASSERT(std::abs(area_of_group(after, sets, 100) - part) <= kSnapped);
}

RC_GTEST_PROP(OverlayLaws, EveryEdgeHasAtMostTwoFaces, ()) {
  const Scene s = any_scene();
  RC_PRE(s.common > 0.05);
  GroupSets sets;
  const auto r = corefine(checks::complex_of(s.models, sets), sets, {});
  RC_ASSERT(r.has_value());
  std::map<std::array<VertexId, 2>, int> uses;
  for (const auto& v : r->complex.face)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(v[k], v[(k + 1) % 3]);
      RC_ASSERT((++uses[{low, high}]) <= 2);
    }
}

}  // namespace
}  // namespace meshgraft
