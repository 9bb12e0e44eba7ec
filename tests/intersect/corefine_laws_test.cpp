// Laws over random scenes, with degenerate positions made on purpose.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "checks.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

double radians(double degrees) { return degrees * 3.14159265358979323846 / 180; }

/// A motion and a scale, the same for a whole scene.
struct Frame {
  std::array<double, 4> q{1, 0, 0, 0};  // quaternion
  double scale = 1;
  Vec3 shift;  // in edge lengths
  [[nodiscard]] Vec3 operator()(Vec3 p) const {
    const Vec3 u{q[1], q[2], q[3]};
    const double n = std::sqrt(q[0] * q[0] + squared_norm(u));
    const double w = q[0] / n;
    const Vec3 v = u / n;
    const Vec3 turned = p + 2 * cross(v, cross(v, p) + w * p);
    return scale * (turned + shift);
  }
};

Frame any_frame() {
  Frame f;
  const auto component = [] { return *rc::gen::inRange(-100, 101) / 100.0; };
  if (*rc::gen::arbitrary<bool>()) f.q = {component(), component(), component(), component()};
  if (f.q[0] == 0 && f.q[1] == 0 && f.q[2] == 0 && f.q[3] == 0) f.q[0] = 1;
  f.scale = *rc::gen::element(1.0, 1e-3, 1e3, 0.37);
  if (*rc::gen::arbitrary<bool>()) f.shift = {1e4 * component(), 1e4 * component(), 1e4 * component()};
  return f;
}

/// Each coordinate one step up, one step down or as it is.
Model one_ulp_off(Model m) {
  for (Vec3& p : m.position)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int way = *rc::gen::inRange(-1, 2);
      if (way != 0) p[axis] = std::nextafter(p[axis], way * 1e30);
    }
  return m;
}

/// A base of 8 x 8 cells of size 1, with a T-line or without.
Model any_base() {
  const double jitter = *rc::gen::element(0.0, 0.0, 0.3);
  Model wall = scenes::plate({0, 0, 0}, {8, 0, 0}, {0, 8, 0}, 1, "WALL", jitter);
  if (*rc::gen::inRange(0, 3) > 0) return wall;
  const std::array<Model, 3> pieces{scenes::plate({0, 0, 0}, {8, 0, 0}, {0, 4, 0}, 1, "WALL"),
                                    scenes::plate({0, 4, 0}, {8, 0, 0}, {0, 4, 0}, 1, "WALL"),
                                    scenes::plate({0, 4, 0}, {8, 0, 0}, {0, 0, 3}, 1, "RIB")};
  return scenes::welded(scenes::together(pieces));
}

/// A part that crosses the base, ends on it, lies in its grid lines, or stands on its free edge.
Model any_part() {
  const double x = *rc::gen::element(-1.0, 0.0, 0.5, 1.0, 2.0, 2.37);
  const double y = *rc::gen::element(0.0, 1.0, 2.5, 3.0, 3.61, 4.0, 7.0, 8.0);
  const double length = *rc::gen::element(2.0, 3.0, 4.5, 5.0, 6.0);
  const double below = *rc::gen::element(0.0, 0.0, 1.0, 1.3);
  const double along = radians(*rc::gen::element(0.0, 0.0, 45.0, 90.0, 31.0));
  const double lean = radians(*rc::gen::element(90.0, 90.0, 60.0, 45.0, 20.0));
  const double size = *rc::gen::element(1.0, 0.5, 0.77);
  const Vec3 u{std::cos(along), std::sin(along), 0}, across{-u.y, u.x, 0};
  const Vec3 up = std::cos(lean) * across + std::sin(lean) * Vec3{0, 0, 1};
  return scenes::plate(Vec3{x, y, 0} - below * up, length * u, (below + 1.5) * up, size, "PART",
                       *rc::gen::element(0.0, 0.25));
}

struct Scene {
  std::vector<Model> models;
  GroupSets sets;
  Complex complex;
};

Scene any_scene(int n_parts) {
  Scene s;
  s.models.push_back(any_base());
  for (int k = 0; k < n_parts; ++k) s.models.push_back(any_part());
  const Frame frame = any_frame();
  const bool off = *rc::gen::arbitrary<bool>();
  for (Model& m : s.models) {
    m = scenes::moved(std::move(m), frame);
    if (off) m = one_ulp_off(std::move(m));
  }
  s.complex = checks::complex_of(s.models, s.sets);
  return s;
}

/// Meshes that lie on each other have laws of their own: overlay_laws_test.cpp.
CorefineOptions crossing_only() {
  CorefineOptions options;
  options.mode = Mode::kFaceEdge;
  return options;
}

void expect_sound(const Complex& before, const Corefined& after, const CorefineOptions& options) {
  checks::Check check;
  check.slack = 0.01;
  for (const std::string& fault : checks::faults(before, after, options, check)) {
    RC_LOG() << fault << '\n';
    RC_FAIL(fault);
  }
}

void expect_conforming(Scene& s) {
  const CorefineOptions options = crossing_only();
  const auto r = corefine(s.complex, s.sets, options);
  if (!r) {
    RC_LOG() << r.error().what << '\n';
    RC_ASSERT(r.error().code == ErrorCode::kOverlap);
    RC_DISCARD("overlap");
  }
  expect_sound(s.complex, *r, options);
}

RC_GTEST_PROP(CorefineLaws, TwoComponentsBecomeConforming, ()) {
  Scene s = any_scene(1);
  expect_conforming(s);
}

RC_GTEST_PROP(CorefineLaws, ThreeComponentsBecomeConforming, ()) {
  Scene s = any_scene(2);
  expect_conforming(s);
}

RC_GTEST_PROP(CorefineLaws, SwappingTheComponentsKeepsTheCurves, ()) {
  Scene s = any_scene(1);
  const CorefineOptions options = crossing_only();
  const auto r = corefine(s.complex, s.sets, options);
  RC_PRE(r.has_value());
  const std::vector<Model> swapped{s.models[1], s.models[0]};
  GroupSets sets;
  const auto q = corefine(checks::complex_of(swapped, sets), sets, options);
  if (!q) RC_LOG() << q.error().what << "\n";
  RC_ASSERT(q.has_value());
  const double size = norm(s.models[0].position[1] - s.models[0].position[0]);
  RC_ASSERT(checks::junction_distance(*r, *q) <= 0.05 * size);
  RC_ASSERT(checks::junction_distance(*q, *r) <= 0.05 * size);
}

RC_GTEST_PROP(CorefineLaws, AConformingComplexStaysAsItIs, ()) {
  Scene s = any_scene(1);
  CorefineOptions options = crossing_only();
  const auto r = corefine(s.complex, s.sets, options);
  RC_PRE(r.has_value());
  options.tolerance = {options.weld_share, true};
  const auto again = corefine(r->complex, s.sets, options);
  RC_ASSERT(again.has_value());
  RC_ASSERT(again->complex.face == r->complex.face);
  RC_ASSERT(again->complex.position == r->complex.position);
  RC_ASSERT(again->junction_edges == r->junction_edges);
}

}  // namespace
}  // namespace meshgraft
