#include "remesh/fill_polygon.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

using Faces = std::set<std::array<std::uint32_t, 3>>;
using Diagonal = std::pair<std::uint32_t, std::uint32_t>;

struct Polygon {
  std::vector<Vec3> points;
  std::vector<VertexId> ids;
  std::set<Diagonal> banned;  // by id value, smaller first
};

Diagonal diagonal(VertexId a, VertexId b) { return {std::min(a.value, b.value), std::max(a.value, b.value)}; }

FillRules rules_of(const Polygon& p) {
  FillRules rules;
  rules.score = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return signed_aspect_ratio({p.points[i], p.points[j], p.points[k]}, {0, 0, 1});
  };
  rules.may_join = [&](std::uint32_t i, std::uint32_t j) { return !p.banned.contains(diagonal(p.ids[i], p.ids[j])); };
  return rules;
}

/// A star-shaped polygon of 3 to 8 corners, some of its diagonals banned.
Polygon random_polygon() {
  Polygon p;
  const auto n = static_cast<std::uint32_t>(*rc::gen::inRange(3, 9));
  for (std::uint32_t k = 0; k < n; ++k) {
    const double radius = *rc::gen::inRange(20, 100) / 100.0;
    const double angle = (k + *rc::gen::inRange(0, 80) / 100.0) * 2 * std::numbers::pi / n;
    p.points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    p.ids.emplace_back(std::size_t{(k * 5 + 3) % 97});
  }
  const int n_banned = *rc::gen::inRange(0, 3);
  for (int b = 0; b < n_banned; ++b) {
    const auto i = *rc::gen::inRange<std::uint32_t>(0, n), j = *rc::gen::inRange<std::uint32_t>(0, n);
    if (i != j) p.banned.insert(diagonal(p.ids[i], p.ids[j]));
  }
  return p;
}

/// Scores, ascending, of the best triangulation among all of corners i..j; empty optional: none.
std::optional<std::vector<double>> best_of_all(const Polygon& p, const FillRules& rules, std::uint32_t i,
                                               std::uint32_t j) {
  const auto n = static_cast<std::uint32_t>(p.points.size());
  if (j == i + 1) return std::vector<double>{};
  if (!(i == 0 && j == n - 1) && !rules.may_join(i, j)) return std::nullopt;
  std::vector<std::vector<double>> all;
  for (std::uint32_t k = i + 1; k < j; ++k) {
    const auto left = best_of_all(p, rules, i, k), right = best_of_all(p, rules, k, j);
    const double q = rules.score(i, k, j);
    if (!left || !right || !(q > 0)) continue;
    std::vector<double> scores = *left;
    scores.insert(scores.end(), right->begin(), right->end());
    scores.push_back(q);
    std::ranges::sort(scores);
    all.push_back(scores);
  }
  if (all.empty()) return std::nullopt;
  return *std::ranges::max_element(all);
}

Faces named(const Polygon& p, const PolygonFill& fill) {
  Faces faces;
  for (const auto& f : fill.faces) {
    std::array<std::uint32_t, 3> ids{p.ids[f[0]].value, p.ids[f[1]].value, p.ids[f[2]].value};
    std::ranges::rotate(ids, std::ranges::min_element(ids));
    faces.insert(ids);
  }
  return faces;
}

TEST(FillPolygon, FindsTheBestOfAllTriangulations) {
  EXPECT_TRUE(rc::check([] {
    const Polygon p = random_polygon();
    const FillRules rules = rules_of(p);
    const auto fill = fill_polygon(p.ids, rules);
    const auto best = best_of_all(p, rules, 0, static_cast<std::uint32_t>(p.points.size() - 1));
    RC_ASSERT(fill.has_value() == best.has_value());
    if (fill)
      RC_ASSERT(std::ranges::equal(fill->scores, *best, [](double a, double b) { return std::abs(a - b) < 1e-12; }));
  }));
}

TEST(FillPolygon, UsesEachSideOnceAndNoBannedDiagonal) {
  EXPECT_TRUE(rc::check([] {
    const Polygon p = random_polygon();
    const auto fill = fill_polygon(p.ids, rules_of(p));
    if (!fill) return;
    const auto n = static_cast<std::uint32_t>(p.points.size());
    RC_ASSERT(fill->faces.size() == n - 2);
    std::map<Diagonal, int> uses;
    for (const auto& f : fill->faces)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto i = f[k], j = f[(k + 1) % 3];
        const bool side = j == (i + 1) % n || i == (j + 1) % n;
        RC_ASSERT(side || !p.banned.contains(diagonal(p.ids[i], p.ids[j])));
        uses[{std::min(i, j), std::max(i, j)}] += side ? 2 : 1;
      }
    for (const auto& [edge, count] : uses) RC_ASSERT(count == 2);
  }));
}

TEST(FillPolygon, RotatingThePolygonGivesTheSameFaces) {
  EXPECT_TRUE(rc::check([] {
    Polygon p = random_polygon();
    const auto fill = fill_polygon(p.ids, rules_of(p));
    Polygon turned = p;
    const auto by = *rc::gen::inRange<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(p.ids.size()));
    std::ranges::rotate(turned.points, turned.points.begin() + by);
    std::ranges::rotate(turned.ids, turned.ids.begin() + by);
    const auto again = fill_polygon(turned.ids, rules_of(turned));
    RC_ASSERT(fill.has_value() == again.has_value());
    if (fill) RC_ASSERT(named(p, *fill) == named(turned, *again));
  }));
}

TEST(FillPolygon, EqualChoicesDoNotDependOnTheStart) {
  Polygon square;
  square.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const std::size_t id : {7u, 2u, 9u, 4u}) square.ids.emplace_back(id);
  const Faces first = named(square, *fill_polygon(square.ids, rules_of(square)));
  for (int turn = 0; turn < 3; ++turn) {
    std::ranges::rotate(square.points, square.points.begin() + 1);
    std::ranges::rotate(square.ids, square.ids.begin() + 1);
    EXPECT_EQ(named(square, *fill_polygon(square.ids, rules_of(square))), first);
  }
}

TEST(FillPolygon, SecondWorstFaceCountsToo) {
  // A flat corner spoils one face in any case; the rest of the polygon must not suffer for it.
  Polygon p;
  p.points = {{0, 0, 0}, {0.5, -0.01, 0}, {1, 0, 0}, {1.1, 1, 0}, {0.5, 1.5, 0}, {-0.1, 1, 0}};
  for (std::size_t k = 0; k < 6; ++k) p.ids.emplace_back(k);
  const FillRules rules = rules_of(p);
  EXPECT_EQ(fill_polygon(p.ids, rules)->scores, *best_of_all(p, rules, 0, 5));
}

TEST(FillPolygon, AFewScoresAreTheBestOfThoseFew) {
  EXPECT_TRUE(rc::check([] {
    const Polygon p = random_polygon();
    FillRules rules = rules_of(p);
    const auto all = fill_polygon(p.ids, rules);
    rules.depth = *rc::gen::inRange<std::size_t>(1, 5);
    const auto few = fill_polygon(p.ids, rules);
    RC_ASSERT(all.has_value() == few.has_value());
    if (!all) return;
    const std::size_t n = std::min(rules.depth, all->scores.size());
    RC_ASSERT(std::equal(all->scores.begin(), all->scores.begin() + static_cast<std::ptrdiff_t>(n), few->scores.begin(),
                         [](double a, double b) { return std::abs(a - b) < 1e-12; }));
  }));
}

TEST(FillPolygon, NothingWithoutAnAllowedTriangulation) {
  Polygon p;
  p.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (std::size_t k = 0; k < 4; ++k) p.ids.emplace_back(k);
  p.banned = {{0, 2}, {1, 3}};
  EXPECT_FALSE(fill_polygon(p.ids, rules_of(p)).has_value());
}

}  // namespace
}  // namespace meshgraft
