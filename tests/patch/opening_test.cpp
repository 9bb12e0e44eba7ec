// Filling of openings: laws over generated contours, and the arrangements that contours can be in.
#include "patch/opening.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "geometry/quality.hpp"
#include "remesh/star.hpp"

namespace meshgraft {
namespace {

constexpr Vec3 kUp{0, 0, 1};

/// Contours in the plane z = 0.
class Plate {
 public:
  VertexId add(Vec3 p) {
    points_.push_back(p);
    return VertexId(points_.size() - 1);
  }
  void contour(std::vector<VertexId> ring) { contours_.push_back(std::move(ring)); }
  /// A circle of n vertices; a hole if it turns clockwise.
  void circle(Vec3 centre, double radius, std::size_t n, bool hole = false) {
    std::vector<VertexId> ring;
    for (std::size_t k = 0; k < n; ++k) {
      const double angle = (hole ? -1 : 1) * 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
      ring.push_back(add(centre + radius * Vec3{std::cos(angle), std::sin(angle), 0}));
    }
    contour(std::move(ring));
  }

  [[nodiscard]] Opening opening() const {
    Opening o;
    o.contours = contours_;
    o.planar = true;
    o.position = [this](VertexId v) { return points_[v.value]; };
    o.normal = [](VertexId) { return kUp; };
    o.has_edge = [](VertexId, VertexId) { return false; };
    return o;
  }
  [[nodiscard]] Triangle corners(const std::array<VertexId, 3>& f) const {
    return {points_[f[0].value], points_[f[1].value], points_[f[2].value]};
  }
  /// Signed area within the contours.
  [[nodiscard]] double area() const {
    double sum = 0;
    for (const auto& ring : contours_)
      for (std::size_t k = 0; k < ring.size(); ++k)
        sum += 0.5 * cross(points_[ring[k].value], points_[ring[(k + 1) % ring.size()].value]).z;
    return sum;
  }
  /// Sides of contours, with the number of times each is walked.
  [[nodiscard]] std::map<std::array<VertexId, 2>, int> sides() const {
    std::map<std::array<VertexId, 2>, int> all;
    for (const auto& ring : contours_)
      for (std::size_t k = 0; k < ring.size() && ring.size() > 1; ++k) ++all[{ring[k], ring[(k + 1) % ring.size()]}];
    return all;
  }

 private:
  std::vector<Vec3> points_;
  std::vector<std::vector<VertexId>> contours_;
};

/// What every filling of a planar opening keeps, in words; empty if all holds.
std::string broken_laws(const Plate& plate, const OpeningFill& fill) {
  std::map<std::array<VertexId, 2>, int> ways;  // of faces, by direction
  double area = 0;
  for (const auto& f : fill.faces) {
    const Triangle t = plate.corners(f);
    if (area_vector(t).z <= 0) return "a face is turned over";
    area += area_vector(t).z;
    for (std::size_t k = 0; k < 3; ++k) ++ways[{f[k], f[(k + 1) % 3]}];
  }
  for (const auto& [way, n] : ways)
    if (n != 1) return "two faces on one side of an edge";
  for (const auto& [side, n] : plate.sides())
    if (ways[side] != 1) return "a side of a contour without a face";
  const auto sides = plate.sides();
  for (const auto& [way, n] : ways)
    if (n == 1 && !sides.contains(way) && ways[{way[1], way[0]}] != 1) return "an edge that is open on one side";
  // All turned alike, each edge closed, and the area right: no face lies on another one.
  if (std::abs(area - plate.area()) > 1e-9 * plate.area()) return "the area is not that of the opening";
  return {};
}

double worst(const Plate& plate, const OpeningFill& fill) {
  double q = 1;
  for (const auto& f : fill.faces) q = std::min(q, aspect_ratio(plate.corners(f)));
  return q;
}

/// A star-shaped contour, with holes and single nodes inside.
Plate random_plate() {
  Plate p;
  const auto n = *rc::gen::inRange<std::size_t>(5, 40);
  std::vector<VertexId> ring;
  for (std::size_t k = 0; k < n; ++k) {
    const double radius = 8 + *rc::gen::inRange(0, 400) / 100.0;
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
    ring.push_back(p.add({radius * std::cos(angle), radius * std::sin(angle), 0}));
  }
  p.contour(ring);
  // Insides are put on a grid of cells, at most one each, so that they do not meet.
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) {
      const Vec3 at{3.0 * i + *rc::gen::inRange(-50, 50) / 100.0, 3.0 * j + *rc::gen::inRange(-50, 50) / 100.0, 0};
      switch (*rc::gen::inRange(0, 4)) {
        case 1:
          p.contour({p.add(at)});
          break;
        case 2:
          p.circle(at, 0.7, *rc::gen::inRange<std::size_t>(3, 9), true);
          break;
        case 3: {  // a polyline, there and back
          const VertexId a = p.add(at), b = p.add(at + Vec3{0.5, 0.3, 0}), c = p.add(at + Vec3{0.9, -0.2, 0});
          p.contour({a, b, c, b});
          break;
        }
        default:
          break;
      }
    }
  return p;
}

TEST(Opening, FillingsOfPlanarOpeningsAreSound) {
  EXPECT_TRUE(rc::check([] {
    const Plate p = random_plate();
    const auto fill = fill_opening(p.opening());
    if (!fill) RC_FAIL(fill.error());
    RC_ASSERT(broken_laws(p, *fill).empty());
  }));
}

TEST(Opening, AContourInPiecesIsSoundToo) {
  EXPECT_TRUE(rc::check([] {
    const Plate p = random_plate();
    OpeningOptions options;
    options.most_corners = 12;
    const auto fill = fill_opening(p.opening(), options);
    if (!fill) RC_FAIL(fill.error());
    RC_ASSERT(broken_laws(p, *fill).empty());
  }));
}

/// The shortest way across that leaves enough sides on either side passes a corner by one unit in the last place; the
/// piece that it cuts off has no filling but one with a flat face.
TEST(Opening, NoContourIsCutByAWayThatGrazesACorner) {
  Plate p;
  std::vector<VertexId> ring;
  for (const Vec3 at : {Vec3{-3.7800000000000002, -0.5, 0},
                        {-3.08, 0.2, 0},
                        {-3.7799999999999998, 1.89, 0},
                        {-3.7800000000000002, 3.1, 0},
                        {-4.5, 7, 0},
                        {-6, 8, 0},
                        {-8, 8, 0},
                        {-9, 6, 0},
                        {-9.5, 3, 0},
                        {-9, 0, 0},
                        {-8, -3, 0},
                        {-6, -4, 0}})
    ring.push_back(p.add(at));
  p.contour(ring);
  OpeningOptions options;
  options.most_corners = 11;
  const auto fill = fill_opening(p.opening(), options);
  ASSERT_TRUE(fill.has_value()) << fill.error();
  EXPECT_EQ(broken_laws(p, *fill), "");
}

TEST(Opening, TheShapeOfAnOpeningDoesNotDependOnWhereItIsAndOnItsPlane) {
  EXPECT_TRUE(rc::check([] {
    const Plate p = random_plate();
    Opening turned = p.opening();
    const Opening plain = p.opening();
    turned.position = [&](VertexId v) {  // a cyclic change of the axes is exact
      const Vec3 q = plain.position(v);
      return Vec3{q.z, q.x, q.y};
    };
    turned.normal = [](VertexId) { return Vec3{1, 0, 0}; };
    const auto fill = fill_opening(plain), again = fill_opening(turned);
    RC_ASSERT(fill.has_value() && again.has_value());
    RC_ASSERT(fill->faces == again->faces);
  }));
}

TEST(Opening, HolesThatTouchAtANodeAndAnInnerLineFromTheRimAreOneContour) {
  Plate p;
  std::vector<VertexId> v;
  for (const Vec3 q : {Vec3{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 3, 0}, {2, 3, 0}, {0, 3, 0}}) v.push_back(p.add(q));
  const VertexId inner = p.add({2, 1, 0}), left = p.add({1.5, 2, 0}), right = p.add({2.5, 2, 0});
  // From the rim along a line to `inner`, around a hole that touches it there, and back.
  p.contour({v[0], v[1], inner, left, right, inner, v[1], v[2], v[3], v[4], v[5]});
  const auto fill = fill_opening(p.opening());
  ASSERT_TRUE(fill.has_value()) << fill.error();
  EXPECT_EQ(broken_laws(p, *fill), "");
  EXPECT_TRUE(fill->chords.empty());
}

/// All triangulations of one contour, one by one.
class AllFillings {
 public:
  AllFillings(const Opening& opening, double least_cosine)
      : opening_(opening), least_cosine_(least_cosine), ring_(opening.contours.front()) {
    for (std::size_t k = 0; k < ring_.size(); ++k) edges_.insert(edge(k, (k + 1) % ring_.size()));
  }

  /// The scores, ascending, of the best one that makes no edge twice; empty: there is none.
  std::vector<double> best() {
    fill({{0, ring_.size() - 1}});
    return best_;
  }

 private:
  using Side = std::array<std::size_t, 2>;

  [[nodiscard]] std::set<VertexId> edge(std::size_t i, std::size_t j) const { return {ring_[i], ring_[j]}; }

  /// Puts a face on the last open side, in each way there is, and goes on with the others.
  void fill(std::vector<Side> open) {
    while (!open.empty() && open.back()[1] - open.back()[0] == 1) open.pop_back();
    if (open.empty()) {
      std::vector<double> scores = scores_;
      std::ranges::sort(scores);
      best_ = std::max(best_, scores);
      return;
    }
    const auto [i, j] = open.back();
    open.pop_back();
    for (std::size_t k = i + 1; k < j; ++k) {
      const double q = score({ring_[i], ring_[k], ring_[j]});
      if (!(q > 0)) continue;
      std::vector<Side> made;
      bool is_new = true;
      for (const Side s : {Side{i, k}, Side{k, j}})
        if (s[1] - s[0] > 1 && is_new) {
          is_new = edges_.insert(edge(s[0], s[1])).second;
          if (is_new) made.push_back(s);
        }
      if (is_new) {
        std::vector<Side> next = open;
        next.push_back({i, k}), next.push_back({k, j});
        scores_.push_back(q);
        fill(std::move(next));
        scores_.pop_back();
      }
      for (const Side s : made) edges_.erase(edge(s[0], s[1]));
    }
  }

  /// Q, or 0 if the face is turned against the normal at its first corner, or too far from that at any.
  [[nodiscard]] double score(const std::array<VertexId, 3>& v) const {
    if (std::set(v.begin(), v.end()).size() < 3) return 0;
    const Triangle t{opening_.position(v[0]), opening_.position(v[1]), opening_.position(v[2])};
    if (!(signed_aspect_ratio(t, opening_.normal(v[0])) > kFlat)) return 0;
    for (const VertexId c : v)
      if (!opening_.planar && dot(unit_normal(t), opening_.normal(c)) < least_cosine_) return 0;
    return aspect_ratio(t);
  }

  const Opening& opening_;
  double least_cosine_;
  std::vector<VertexId> ring_;
  std::set<std::set<VertexId>> edges_;  // sides, and what has been made
  std::vector<double> scores_, best_;
};

/// Empty if the filling of an opening with one contour is the best of all.
std::string not_the_best(const Opening& opening, const OpeningOptions& options = {}) {
  const auto best = AllFillings(opening, options.least_cosine).best();
  const auto fill = fill_opening(opening, options);
  if (fill.has_value() == best.empty()) return fill ? "filled against the rules" : "not filled";
  if (!fill) return {};
  std::vector<double> scores;
  for (const auto& f : fill->faces)
    scores.push_back(aspect_ratio({opening.position(f[0]), opening.position(f[1]), opening.position(f[2])}));
  std::ranges::sort(scores);
  for (std::size_t k = 0; k < best.size(); ++k)
    if (std::abs(scores.at(k) - best[k]) > 1e-12) return "a score is not that of the best";
  return {};
}

/// A plane contour of few corners that passes through some of its nodes more than once: lines from the rim inwards
/// and back, some with a hole at their end.
Plate random_contour_that_meets_itself() {
  Plate p;
  std::vector<VertexId> ring;
  const auto n = *rc::gen::inRange<std::size_t>(3, 6);
  std::size_t room = 12 - n;
  for (std::size_t k = 0; k < n; ++k) {
    const double shift = *rc::gen::inRange(-20, 20) / 100.0;
    const auto polar = [&](double radius, double turn) {
      const double angle = 2 * std::numbers::pi * (static_cast<double>(k) + turn + shift) / static_cast<double>(n);
      return p.add({radius * std::cos(angle), radius * std::sin(angle), 0});
    };
    const VertexId rim = polar(1, 0);
    ring.push_back(rim);
    const int kind = *rc::gen::inRange(0, 3);
    if (kind == 1 && room >= 2) {
      room -= 2;
      ring.push_back(polar(*rc::gen::inRange(30, 80) / 100.0, 0)), ring.push_back(rim);
    } else if (kind == 2 && room >= 5) {
      room -= 5;
      const VertexId tip = polar(0.7, 0), left = polar(0.4, -0.1), right = polar(0.4, 0.1);
      for (const VertexId v : {tip, right, left, tip, rim}) ring.push_back(v);
    }
  }
  p.contour(ring);
  return p;
}

TEST(Opening, APlaneContourThatMeetsItselfIsFilledAsWellAsPossible) {
  EXPECT_TRUE(rc::check([] { RC_ASSERT(not_the_best(random_contour_that_meets_itself().opening()) == ""); }));
}

/// Two contours and a line between them, as one; nodes and normals anywhere.
Opening wild_band(std::vector<Vec3>& points, std::vector<Vec3>& normals) {
  const auto any = [] { return *rc::gen::inRange(-100, 100) / 100.0; };
  const auto n = *rc::gen::inRange<std::size_t>(3, 6), m = *rc::gen::inRange<std::size_t>(3, 6);
  for (std::size_t k = 0; k < n + m; ++k) {
    points.push_back({any(), any(), any()});
    normals.push_back(normalized({any(), any(), any()}));
  }
  Opening o;
  auto& ring = o.contours.emplace_back();
  for (std::size_t k = 0; k <= n; ++k) ring.emplace_back(k % n);
  for (std::size_t k = 0; k <= m; ++k) ring.emplace_back(n + (m - k) % m);
  o.position = [&](VertexId v) { return points[v.value]; };
  o.normal = [&](VertexId v) { return normals[v.value]; };
  o.has_edge = [](VertexId, VertexId) { return false; };
  return o;
}

/// In a plane no edge can be made twice, and on a surface that bends little hardly. Here faces may turn as they like
/// beside their first corner: in one band of sixty or so the best filling would make an edge on both sides of one end.
TEST(Opening, AContourThatCanMakeAnEdgeTwiceIsFilledAsWellAsPossibleToo) {
  constexpr int kBands = 20;  // in each case
  OpeningOptions options;
  options.least_cosine = -1;
  EXPECT_TRUE(rc::check([&] {
    for (int k = 0; k < kBands; ++k) {
      std::vector<Vec3> points, normals;
      const Opening band = wild_band(points, normals);
      RC_ASSERT(not_the_best(band, options) == "");
    }
  }));
}

TEST(Opening, AnEdgeThatIsThereAlreadyIsNotMade) {
  Plate p;
  std::vector<VertexId> v;
  for (const Vec3 q : {Vec3{0, 0, 0}, {1, -0.2, 0}, {1.1, 1, 0}, {0, 1, 0}}) v.push_back(p.add(q));
  p.contour(v);
  const auto free = fill_opening(p.opening());
  ASSERT_TRUE(free.has_value());
  for (const auto& diagonal : {std::set{v[0], v[2]}, std::set{v[1], v[3]}}) {
    Opening barred = p.opening();
    barred.has_edge = [&](VertexId a, VertexId b) { return std::set{a, b} == diagonal; };
    const auto fill = fill_opening(barred);
    ASSERT_TRUE(fill.has_value());
    for (const auto& f : fill->faces)
      EXPECT_LT(std::ranges::count_if(f, [&](VertexId x) { return diagonal.contains(x); }), 2);
  }
  Opening both = p.opening();
  both.has_edge = [&](VertexId, VertexId) { return true; };
  EXPECT_FALSE(fill_opening(both).has_value());
}

TEST(Opening, AContourThatCannotBeReachedIsToldInWords) {
  Plate p;
  p.circle({0, 0, 0}, 1, 8);
  p.circle({5, 0, 0}, 1, 8, true);  // a hole outside
  const auto fill = fill_opening(p.opening());
  ASSERT_FALSE(fill.has_value());
  EXPECT_NE(fill.error().find("reached"), std::string::npos);
}

TEST(Opening, NoContourIsToldInWordsToo) { EXPECT_FALSE(fill_opening(Plate().opening()).has_value()); }

/// Around a pipe no plane shows the opening: two circles, one above the other.
TEST(Opening, ABandAroundAPipeIsFilledAlongThePipe) {
  constexpr std::size_t n = 24;
  constexpr double radius = 1, height = 0.4;
  std::vector<Vec3> points;
  Opening o;
  o.contours.resize(2);
  for (std::size_t k = 0; k < 2 * n; ++k) {
    const bool top = k >= n;
    const double angle = 2 * std::numbers::pi * static_cast<double>(k % n) / n * (top ? -1 : 1);
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), top ? height : 0});
    o.contours[top ? 1 : 0].emplace_back(k);
  }
  o.position = [&](VertexId v) { return points[v.value]; };
  o.normal = [&](VertexId v) { return normalized({points[v.value].x, points[v.value].y, 0}); };
  o.has_edge = [](VertexId, VertexId) { return false; };
  const auto fill = fill_opening(o);
  ASSERT_TRUE(fill.has_value()) << fill.error();
  ASSERT_EQ(fill->faces.size(), 2 * n);
  double area_sum = 0;
  for (const auto& f : fill->faces) {
    const Triangle t{points[f[0].value], points[f[1].value], points[f[2].value]};
    const Vec3 c = centroid(t);
    EXPECT_GT(dot(area_vector(t), Vec3{c.x, c.y, 0}), 0);
    area_sum += area(t);
  }
  EXPECT_NEAR(area_sum, 2 * std::numbers::pi * radius * height, 0.01 * area_sum);
}

/// A strip along a wave, as a long stiffener leaves it, with 1,000 nodes on its contour.
Plate long_strip(std::size_t n) {
  Plate p;
  std::vector<VertexId> ring;
  const auto half = static_cast<int>(n / 2);
  const auto wave = [](double x) { return 3 * std::sin(x / 15); };
  for (int k = 0; k < half; ++k) ring.push_back(p.add({1.0 * k, wave(k), 0}));
  for (int k = half; k-- > 0;) ring.push_back(p.add({k + 0.3, wave(k + 0.3) + 2.5, 0}));
  p.contour(ring);
  return p;
}

TEST(Opening, AThousandNodesTakeSecondsAndPiecesCostLittle) {
  const Plate strip = long_strip(1000);
  const auto start = std::chrono::steady_clock::now();
  const auto whole = fill_opening(strip.opening());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ASSERT_TRUE(whole.has_value()) << whole.error();
  EXPECT_EQ(broken_laws(strip, *whole), "");
  EXPECT_TRUE(whole->chords.empty());
  EXPECT_LT(seconds, 60);  // some two on an idle core; this only tells seconds from minutes

  OpeningOptions options;
  options.most_corners = 100;
  const auto pieces = fill_opening(strip.opening(), options);
  ASSERT_TRUE(pieces.has_value()) << pieces.error();
  EXPECT_EQ(broken_laws(strip, *pieces), "");
  EXPECT_GE(pieces->chords.size(), 9u);
  EXPECT_LE(worst(strip, *pieces), worst(strip, *whole) + 1e-12);
  EXPECT_GE(worst(strip, *pieces), 0.8 * worst(strip, *whole));
}

}  // namespace
}  // namespace meshgraft
