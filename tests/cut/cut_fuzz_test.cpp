// Cuts that nobody would ask for: tools of absurd numbers, groups that lie anyhow.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "geometry/quality.hpp"
#include "meshgraft/check.hpp"
#include "meshgraft/cut.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

constexpr double kSize = 0.1;

/// A rib that stands on a wall, off the grid of it; faces are in random groups by where they lie.
Model base_in_groups() {
  const std::vector<Model> models{scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "WALL"),
                                  scenes::plate({0, 0.5, 0}, {2, 0, 0}, {0, 0, 0.6}, kSize, "RIB")};
  Model base = scenes::welded(scenes::together(models));
  for (const char* name : {"A", "B", "C"}) {
    const GroupId group(base.groups.size());
    base.groups.push_back({name});
    const auto number = [] { return 0.01 * *rc::gen::inRange(-100, 101); };
    const Vec3 normal{number(), number(), number()}, through{1 + number(), 0.5, 0};
    for (std::size_t e = 0; e < base.n_elements(); ++e) {
      if (dot(normal, centroid(base.corners(ElementId(e))) - through) < 0.2) continue;
      base.element_groups[e] = base.group_sets.with(base.element_groups[e], group);
      ++base.groups.back().n_elements;
    }
  }
  return base;
}

/// Numbers that a script gone wrong might pass, among sensible ones.
double any_number() {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  switch (*rc::gen::inRange(0, 60)) {
    case 0:
      return 0;
    case 1:
      return *rc::gen::element(1e-300, -1e-300, 1e-12, 5e-324, -1e-17);
    case 2:
      return *rc::gen::element(1e300, -1e300, 1e9, -1e9, 1e160);
    case 3:
      return *rc::gen::element(kInfinite, -kInfinite, std::numeric_limits<double>::quiet_NaN());
    default:
      return 0.01 * *rc::gen::inRange(-120, 221);
  }
}

Vec3 any_vector() {
  const double x = any_number(), y = any_number(), z = any_number();
  return {x, y, z};
}

CutTool any_tool() {
  const Vec3 a = any_vector(), b = any_vector();
  switch (*rc::gen::inRange(0, 3)) {
    case 0:
      return *rc::gen::arbitrary<bool>() ? BoxTool{a, b}
                                         : BoxTool{a, a + Vec3{std::abs(b.x), std::abs(b.y), std::abs(b.z)}};
    case 1:
      return CylinderTool{a, b, any_number()};
    default:
      return PlaneTool{a, b};
  }
}

double area(const Model& m) { return check(m).area; }

double dropped_area(const Merged& m) {
  double sum = 0;
  for (const DroppedEntry& d : m.report.dropped) sum += d.area;
  return sum;
}

TEST(CutFuzz, AnyNumbersGiveASoundResultOrAnErrorThatTellsWhy) {
  EXPECT_TRUE(rc::check([] {
    const Model base = base_in_groups();
    CutOptions options;
    options.drop.what = *rc::gen::element(Drop::What::kInside, Drop::What::kOutside, Drop::What::kGroup);
    options.drop.group = *rc::gen::element("WALL", "RIB", "A", "B", "C", "NONE", "");
    if (*rc::gen::inRange(0, 6) == 0) options.zone.size = std::abs(any_number());
    const auto m = cut(base, any_tool(), options);
    if (!m) {
      RC_LOG() << to_string(m.error()) << '\n';
      const std::set told{ErrorCode::kUsage, ErrorCode::kPartsApart, ErrorCode::kOverlap,
                          ErrorCode::kJunctionNotResolved, ErrorCode::kNotSeparated};
      RC_ASSERT(told.contains(m.error().code));
      RC_ASSERT(!m.error().hint.empty());
      RC_TAG(std::string(name(m.error().code)));
      return;
    }
    RC_TAG(m->report.broken_promises.empty() ? "cut" : "cut, and a promise broken");
    const Model result = apply(base, {}, *m);
    if (m->report.broken_promises.empty()) RC_ASSERT(check(result).sound());
    RC_ASSERT(dropped_area(*m) > 0);
    RC_ASSERT(std::abs(area(result) + dropped_area(*m) - area(base)) < 0.02);
  }));
}

TEST(CutFuzz, WhatGoesByItsGroupIsNextToTheCutAndHasTheGroup) {
  EXPECT_TRUE(rc::check([] {
    const Model base = base_in_groups();
    CutOptions options;
    options.drop.what = Drop::What::kGroup;
    options.drop.group = *rc::gen::element("A", "B", "C", "RIB", "WALL");
    const auto number = [](int low, int high) { return 0.01 * *rc::gen::inRange(low, high); };
    const Vec3 point{number(30, 170), number(20, 80), 0};
    const auto tool =
        *rc::gen::arbitrary<bool>()
            ? CutTool(PlaneTool{point, {number(-100, 101), number(-100, 101), number(-50, 51)}})
            : CutTool(BoxTool{point - Vec3{number(10, 40), number(10, 40), 1}, point + Vec3{0.2, 0.2, 1}});
    const auto m = cut(base, tool, options);
    if (!m) {
      RC_LOG() << to_string(m.error()) << '\n';
      RC_ASSERT(m.error().code == ErrorCode::kUsage || m.error().code == ErrorCode::kOverlap);
      return;
    }
    const auto in_group = [&](const Model& model) {
      double sum = 0;
      for (std::size_t e = 0; e < model.n_elements(); ++e)
        for (const GroupId g : model.group_sets.members(model.element_groups[e]))
          if (model.groups[g.value].name == options.drop.group) sum += norm(area_vector(model.corners(ElementId(e))));
      return sum;
    };
    const Model result = apply(base, {}, *m);
    RC_ASSERT(check(result).sound());
    RC_ASSERT(in_group(result) < in_group(base));
    RC_ASSERT(std::ranges::all_of(m->report.dropped, [](const DroppedEntry& d) { return d.area > 0; }));
    RC_ASSERT(std::abs(check(result).area + dropped_area(*m) - check(base).area) < 0.02);
  }));
}

}  // namespace
}  // namespace meshgraft
