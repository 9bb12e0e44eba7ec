// A double bottom of a ship as mid-surfaces leave it: plates that end short of what they are welded to, or reach beyond
// it, each end by as much as it likes.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "meshgraft/merge.hpp"
#include "scenes/expect.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

constexpr double kLength = 2.4, kBreadth = 1.6, kHeight = 0.7, kBar = 0.2;
constexpr double kFinest = 0.1;               // edge length
constexpr double kRagged = 0.4;               // of it: the most by which an end misses what it should end on
constexpr double kTolerance = 0.45;           // of it
constexpr double kRounding = 1e-6 * kFinest;  // nodes nearer than this to where they should be are there

double uniform(double low, double high) {
  constexpr int kSteps = 1 << 20;
  return low + (high - low) * *rc::gen::inRange(0, kSteps + 1) / kSteps;
}

/// By how much an end reaches too far: exactly there, short or beyond.
double ragged() {
  const double most = kRagged * kFinest;
  return *rc::gen::element(0.0, 1.0, -1.0) * uniform(0, most);
}

/// A plate between two corners of a box without thickness, in the plane across `axis`.
struct Plate {
  std::string group;
  std::size_t axis;
  Vec3 low, high;  // as it should be
  Model mesh;
};

class DoubleBottom {
 public:
  DoubleBottom() {
    add("BOTTOM", 2, {0, 0, 0}, {kLength, kBreadth, 0});
    add("INNER", 2, {0, 0, kHeight}, {kLength, kBreadth, kHeight});
    const double y = uniform(0.4, 0.6) * kBreadth;
    add("GIRDER", 1, {0, y, 0}, {kLength, y, kHeight}, {2, 5});
    const std::vector<double> x{uniform(0.3, 0.4) * kLength, uniform(0.6, 0.7) * kLength};
    for (const double at : x) {
      const std::string name = "FLOOR_" + std::to_string(plates.size());
      if (*rc::gen::arbitrary<bool>()) {
        add(name, 0, {at, 0, 0}, {at, kBreadth, kHeight}, {2, 5});
      } else {
        add(name + "P", 0, {at, 0, 0}, {at, y, kHeight}, {2, 4, 5});
        add(name + "S", 0, {at, y, 0}, {at, kBreadth, kHeight}, {1, 2, 5});
      }
    }
    const double bar = uniform(0.4, 0.6) * y;
    if (*rc::gen::arbitrary<bool>()) {
      add("BAR", 1, {0, bar, 0}, {kLength, bar, kBar}, {2});
    } else {
      add("BAR_A", 1, {0, bar, 0}, {x[0], bar, kBar}, {2, 3});
      add("BAR_B", 1, {x[0], bar, 0}, {x[1], bar, kBar}, {0, 2, 3});
      add("BAR_C", 1, {x[1], bar, 0}, {kLength, bar, kBar}, {0, 2});
    }
    for (std::size_t k = plates.size(); k-- > 2;)
      std::swap(plates[k], plates[*rc::gen::inRange<std::size_t>(1, k + 1)]);
  }

  std::vector<Plate> plates;  // the base first

 private:
  /// `ends`: sides that miss: 0 to 2 low x, y, z; 3 to 5 high.
  void add(const std::string& group, std::size_t axis, Vec3 low, Vec3 high, const std::vector<std::size_t>& ends = {}) {
    std::array<double, 6> side{low.x, low.y, low.z, high.x, high.y, high.z};
    for (const std::size_t k : ends) side[k] += (k < 3 ? -1 : 1) * ragged();
    const Vec3 from{side[0], side[1], side[2]}, span = Vec3{side[3], side[4], side[5]} - from;
    const Vec3 u = axis == 0 ? Vec3{0, span.y, 0} : Vec3{span.x, 0, 0};
    const Vec3 v = axis == 2 ? Vec3{0, span.y, 0} : Vec3{0, 0, span.z};
    const double size = uniform(1, 2) * kFinest;
    plates.push_back({group, axis, low, high, scenes::staggered_plate(from, u, v, size, group, 0.1)});
  }
};

double area_of(const Plate& p) {
  const Vec3 d = p.high - p.low;
  return p.axis == 0 ? d.y * d.z : p.axis == 1 ? d.x * d.z : d.x * d.y;
}

/// Each plate is the whole rectangle that it should be, and nothing else.
void expect_as_designed(const DoubleBottom& ship, const Model& result) {
  std::map<std::string, const Plate*> plate;
  for (const Plate& p : ship.plates) plate[p.group] = &p;
  for (std::size_t e = 0; e < result.n_elements(); ++e)
    for (const GroupId g : result.group_sets.members(result.element_groups[e])) {
      const Plate& p = *plate.at(result.groups[g.value].name);
      for (const Vec3 corner : result.corners(ElementId(e)))
        for (std::size_t k = 0; k < 3; ++k)
          if (corner[k] < p.low[k] - kRounding || corner[k] > p.high[k] + kRounding)
            RC_FAIL(fmt::format("{} has a corner at {} {} {}", p.group, corner.x, corner.y, corner.z));
    }
  for (const auto& [group, area] : scenes::area_by_group(result)) {
    RC_LOG() << group << " has area " << area << ", should have " << area_of(*plate.at(group)) << '\n';
    RC_ASSERT(std::abs(area - area_of(*plate.at(group))) <= kRounding);
  }
}

TEST(DoubleBottom, IsAsDesignedHoweverItsPlatesMissEachOther) {
  EXPECT_TRUE(rc::check([] {
    const DoubleBottom ship;
    std::vector<Model> parts;
    for (std::size_t k = 1; k < ship.plates.size(); ++k) parts.push_back(ship.plates[k].mesh);
    MergeOptions options;
    options.tolerance = {kTolerance * kFinest, false};
    const auto merged = merge(ship.plates[0].mesh, parts, options);
    if (!merged) RC_FAIL(to_string(merged.error()));
    for (const Error& e : merged->report.broken_promises) RC_LOG() << to_string(e) << '\n';
    RC_ASSERT(merged->report.broken_promises.empty());
    RC_LOG() << "worst Q " << merged->report.quality.min << '\n';
    RC_ASSERT(merged->report.quality.min >= 0.5);
    const Model result = apply(ship.plates[0].mesh, parts, *merged);
    RC_ASSERT(check(result).sound());
    expect_as_designed(ship, result);
  }));
}

}  // namespace
}  // namespace meshgraft
