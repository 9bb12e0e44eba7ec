// Filling of holes: laws that every filling keeps, and surfaces that are known.
#include "meshgraft/fill.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "fill/fill_laws.hpp"
#include "geometry/quality.hpp"
#include "meshgraft/check.hpp"
#include "support/known_surfaces.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

using scenes::without_faces;

std::function<bool(Vec3)> within(Vec3 centre, double radius) {
  return [=](Vec3 p) { return distance(p, centre) < radius; };
}

TEST(Contours, HolesAreToldFromTheOuterBorder) {
  const Model plate = scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 0.1);
  const Model holed = without_faces(plate, [](Vec3 p) {
    return distance(p, {0.5, 0.5, 0}) < 0.2 || distance(p, {1.4, 0.5, 0}) < 0.3;
  });
  const auto contours = contours_of(holed);
  ASSERT_EQ(contours.size(), 3u);
  EXPECT_NEAR(contours[0].length, 6, 1e-12);
  EXPECT_FALSE(contours[0].is_hole);
  EXPECT_TRUE(contours[1].is_hole && contours[2].is_hole);
  EXPECT_GT(contours[1].length, contours[2].length);
  EXPECT_NEAR(contours[1].centre.x, 1.4, 0.05);
}

TEST(Contours, TheEndsOfAPipeAreNoHolesAndTheMouthOfASphereIsOne) {
  for (const Contour& c : contours_of(scenes::cylinder({0, 0, 0}, {0, 0, 1}, 0.3, 0.1))) EXPECT_FALSE(c.is_hole);
  const auto mouth = contours_of(without_faces(scenes::sphere({0, 0, 0}, 1, 8), within({0, 0, 1}, 0.5)));
  ASSERT_EQ(mouth.size(), 1u);
  EXPECT_TRUE(mouth[0].is_hole);
}

TEST(Contours, AHoleIsWhereTheFacesAroundLookOneWay) {
  // A pipe that widens by a share of its radius for each unit of its length; at 3 it is a dish of 18 degrees.
  for (const auto& [widening, holes] : {std::pair{0.0, 0}, {0.03, 0}, {-0.03, 0}, {0.2, 0}, {3.0, 1}}) {
    const Model pipe = scenes::moved(scenes::cylinder({0, 0, 0}, {0, 0, 1}, 1, 0.1), [widening](Vec3 p) {
      const double by = 1 + widening * p.z;
      return Vec3{by * p.x, by * p.y, p.z};
    });
    EXPECT_EQ(std::ranges::count(contours_of(pipe), true, &Contour::is_hole), holes) << widening;
  }
}

TEST(Contours, HolesThatTouchInANodeAreTwo) {
  const Model plate = scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.1);
  // Two squares of cells, corner to corner at (0.5, 0.5).
  const Model holed = without_faces(plate, [](Vec3 p) {
    const bool low = p.x > 0.3 && p.x < 0.5 && p.y > 0.3 && p.y < 0.5;
    return low || (p.x > 0.5 && p.x < 0.7 && p.y > 0.5 && p.y < 0.7);
  });
  const auto contours = contours_of(holed);
  ASSERT_EQ(contours.size(), 3u);
  EXPECT_EQ(contours[1].nodes.size(), 8u);
  EXPECT_EQ(contours[2].nodes.size(), 8u);
  const Merged m = made(holed);
  EXPECT_EQ(broken(m.report), std::vector<std::string>{});
  EXPECT_EQ(broken_laws(holed, m), "");
  EXPECT_NEAR(check(apply(holed, {}, m)).area, 1, 1e-12);
}

TEST(Fill, HolesOfAPlateAreFilledAndItsBorderIsLeftOpenWithAWarning) {
  const Model plate = scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 0.1, "PLATE", 0.15);
  const Model holed = without_faces(plate, [](Vec3 p) {
    return distance(p, {0.5, 0.5, 0}) < 0.2 || distance(p, {1.4, 0.5, 0}) < 0.3;
  });
  const Merged m = made(holed);
  EXPECT_EQ(broken(m.report), std::vector<std::string>{});
  EXPECT_EQ(broken_laws(holed, m), "");
  const Model result = apply(holed, {}, m);
  EXPECT_NEAR(check(result).area, 2, 1e-9);
  EXPECT_EQ(contours_of(result).size(), 1u);
  EXPECT_GE(m.report.quality.min, 0.5);
  EXPECT_EQ(m.report.junction.size(), 2u);
  EXPECT_EQ(std::ranges::count(m.report.warnings, "left-open", &Warning::name), 1);
  ASSERT_EQ(m.report.groups.size(), 1u);
  EXPECT_EQ(m.report.groups[0].rule, "extended over filled holes");
  EXPECT_NEAR(m.report.groups[0].area_after, 2, 1e-9);
}

TEST(Fill, OnlyTheContourThatIsNamedIsFilled) {
  const Model plate = scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 0.1);
  const Model holed = without_faces(plate, [](Vec3 p) {
    return distance(p, {0.5, 0.5, 0}) < 0.2 || distance(p, {1.4, 0.5, 0}) < 0.3;
  });
  FillOptions options;
  options.openings = {{2}};
  const Merged m = made(holed, options);
  EXPECT_EQ(broken_laws(holed, m), "");
  const auto left = contours_of(apply(holed, {}, m));
  ASSERT_EQ(left.size(), 2u);
  EXPECT_NEAR(left[1].centre.x, 1.4, 0.05);
  options.openings = {{3}};
  EXPECT_EQ(fill(holed, options).error().code, ErrorCode::kUsage);
}

TEST(Fill, AClosedMeshHasNothingToFill) {
  EXPECT_EQ(fill(scenes::sphere({0, 0, 0}, 1, 4)).error().code, ErrorCode::kUsage);
}

TEST(Fill, AHoleAlongWhichFacesTurnIsNamed) {
  const Model holed = without_faces(scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.1), within({0.5, 0.5, 0}, 0.2));
  ModelBuilder turned;
  for (const Vec3 p : holed.position) turned.add_node(p);
  for (std::size_t e = 0; e < holed.n_elements(); ++e) {
    const auto v = holed.nodes_of(ElementId(e));
    const bool left = centroid(holed.corners(ElementId(e))).x < 0.5;
    turned.add_face(v[0], left ? v[2] : v[1], left ? v[1] : v[2]);
  }
  const Model base = turned.build();
  EXPECT_FALSE(free_edges_of(base).others.empty());
  EXPECT_TRUE(free_edges_of(holed).others.empty());
  const auto result = fill(base);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kUsage);
  EXPECT_NE(result.error().what.find("close no contour"), std::string::npos) << result.error().what;
  EXPECT_NE(result.error().hint.find("turn the faces alike"), std::string::npos) << result.error().hint;
}

TEST(Fill, AnEndOfAPipeThatIsNamedGetsACap) {
  for (const Vec3 axis : {Vec3{0, 0, 1}, {0.6, 0, 0.8}})
    for (const double radius : {0.15, 0.2, 0.275, 0.3, 0.4, 0.5, 0.7, 0.95}) {
      const Model pipe = scenes::cylinder({1, 2, 3}, Vec3{1, 2, 3} + axis, radius, 0.1);
      FillOptions options;
      options.openings = {{0}};
      const Merged m = made(pipe, options);
      EXPECT_EQ(broken(m.report), std::vector<std::string>{}) << radius;
      EXPECT_GE(m.report.quality.min, 0.5) << radius;
      EXPECT_EQ(broken_laws(pipe, m), "");
      EXPECT_EQ(contours_of(apply(pipe, {}, m)).size(), 1u);
    }
}

/// The plate without a ring of faces: a square island in a square hole.
Model ring(const std::function<Vec3(double, double)>& at) {
  return scenes::moved(without_faces(scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.05),
                                     [](Vec3 p) {
                                       const double far = std::max(std::abs(p.x - 0.5), std::abs(p.y - 0.5));
                                       return far > 0.15 && far < 0.35;
                                     }),
                       [&](Vec3 p) { return at(p.x, p.y); });
}

TEST(Fill, AnIslandInAHoleIsJoinedToWhatIsAround) {
  for (const double bend : {0.0, 0.3}) {  // flat; part of a saddle
    const Model holed = ring([&](double x, double y) { return Vec3{x, y, 1 + bend * (x * x - y * y)}; });
    const auto contours = contours_of(holed);
    ASSERT_EQ(contours.size(), 3u);
    EXPECT_EQ(openings_of(holed, contours), (std::vector<OpeningContours>{{1, 2}}));
    const Merged m = made(holed);
    EXPECT_EQ(broken(m.report), std::vector<std::string>{});
    EXPECT_EQ(broken_laws(holed, m), "");
    EXPECT_GE(m.report.quality.min, 0.5);
    EXPECT_EQ(contours_of(apply(holed, {}, m)).size(), 1u);
    EXPECT_EQ(std::ranges::count(m.report.warnings, "island", &Warning::name), 1);
    for (const NewNode& n : m.graft.new_nodes) {
      const Vec3 p = n.position;
      EXPECT_NEAR(p.z, 1 + bend * (p.x * p.x - p.y * p.y), 0.02 * bend);
    }

    FillOptions alone;  // over the island: that must not be silent
    alone.openings = {{1}};
    const std::vector<std::string> faults = broken(made(holed, alone).report);
    EXPECT_TRUE(std::ranges::any_of(faults, [](const auto& f) { return f.find("lies on") != std::string::npos; }));
  }
}

TEST(Fill, APlateOverAHoleIsNoIsland) {
  const Model holed = without_faces(scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.1), within({0.5, 0.5, 0}, 0.3));
  const std::vector<Model> both{holed, scenes::plate({0.4, 0.4, 0.1}, {0.2, 0, 0}, {0, 0.2, 0}, 0.1)};
  const Model base = scenes::together(both);
  for (const OpeningContours& opening : openings_of(base, contours_of(base))) EXPECT_EQ(opening.size(), 1u);
  EXPECT_EQ(broken(made(base).report), std::vector<std::string>{});
}

TEST(Fill, AFillingThatCrossesOtherElementsIsNoSecret) {
  const Model holed = without_faces(scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.1), within({0.5, 0.5, 0}, 0.35));
  const auto faults_with = [&](const Model& other) {
    const std::vector<Model> both{holed, other};
    return broken(made(scenes::together(both)).report);
  };
  const auto tells = [](const std::vector<std::string>& faults, const char* word) {
    return std::ranges::any_of(faults, [&](const auto& f) { return f.find(word) != std::string::npos; });
  };
  const Model wall = scenes::plate({0.4, 0.5, -0.1}, {0.2, 0, 0}, {0, 0, 0.23}, 0.1);
  EXPECT_TRUE(tells(faults_with(wall), "intersect"));
  ModelBuilder quad;
  std::vector<NodeId> v;
  for (const Vec3 p : {Vec3{0.4, 0.5, -0.1}, {0.6, 0.5, -0.1}, {0.6, 0.5, 0.1}, {0.4, 0.5, 0.1}})
    v.push_back(quad.add_node(p));
  quad.add_element({.shape = Shape::kQuad, .type = 94}, v);
  EXPECT_TRUE(tells(faults_with(quad.build()), "crosses element"));
}

TEST(Fill, AnIslandThatTouchesTheRimInANodeIsOneContourWithIt) {
  const Model plate = scenes::plate({0, 0, 2}, {1, 0, 0}, {0, 1, 0}, 0.1);
  const auto in_square = [](Vec3 p, double low, double high) {
    return p.x > low && p.x < high && p.y > low && p.y < high;
  };
  // The island has its corner (0.2, 0.2) in common with the hole.
  const Model holed = without_faces(plate, [&](Vec3 p) { return in_square(p, 0.2, 0.8) && !in_square(p, 0.2, 0.5); });
  const auto contours = contours_of(holed);
  const Merged m = made(holed);
  EXPECT_EQ(broken(m.report), std::vector<std::string>{});
  EXPECT_EQ(broken_laws(holed, m), "");
  EXPECT_NEAR(check(apply(holed, {}, m)).area, 1, 1e-9);
  EXPECT_EQ(contours_of(apply(holed, {}, m)).size(), 1u);
}

TEST(Fill, APipeGetsTheMissingPieceBetweenTwoEnds) {
  const Model pipe =
      without_faces(scenes::cylinder({0, 0, 0}, {0, 0, 2}, 0.4, 0.1), [](Vec3 p) { return p.z > 0.8 && p.z < 1.3; });
  const auto contours = contours_of(pipe);
  ASSERT_EQ(contours.size(), 4u);
  FillOptions options;
  for (std::size_t k = 0; k < contours.size(); ++k)
    if (contours[k].centre.z > 0.5 && contours[k].centre.z < 1.5) {
      if (options.openings.empty()) options.openings.emplace_back();
      options.openings.front().push_back(k);
    }
  ASSERT_EQ(options.openings.front().size(), 2u);
  const Merged m = made(pipe, options);
  EXPECT_EQ(broken(m.report), std::vector<std::string>{});
  EXPECT_EQ(broken_laws(pipe, m), "");
  EXPECT_EQ(contours_of(apply(pipe, {}, m)).size(), 2u);
  for (const NewNode& n : m.graft.new_nodes) EXPECT_NEAR(std::hypot(n.position.x, n.position.y), 0.4, 0.01);
}

TEST(Fill, ContoursThatCannotBeFilledTogetherAreRefusedWithTheirPlace) {
  const std::vector<Model> two{scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.2),
                               scenes::plate({0, 0, 5}, {1, 0, 0}, {0, 1, 0}, 0.2)};
  FillOptions options;
  options.openings = {{0, 1}};
  const auto result = fill(scenes::together(two), options);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kContourNotFilled);
  EXPECT_NE(result.error().what.find("contours 1 and 2"), std::string::npos) << result.error().what;
  options.openings = {{0}, {0}};
  EXPECT_EQ(fill(scenes::together(two), options).error().code, ErrorCode::kUsage);
  options.openings = {{}};
  EXPECT_EQ(fill(scenes::together(two), options).error().code, ErrorCode::kUsage);
}

/// A slit so narrow that faces across it are flat.
TEST(Fill, NoHintNamesAnOptionThatItLacks) {
  for (const double skew : {0.0, 0.02}) {
    const Model plate = scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.1);
    const Model open = without_faces(plate, [](Vec3 p) { return p.x > 0.2 && p.x < 0.8 && p.y > 0.4 && p.y < 0.5; });
    const Model slit = scenes::moved(open, [=](Vec3 p) {
      const bool is_above = p.x > 0.25 && p.x < 0.75 && p.y > 0.45 && p.y < 0.55;
      return is_above ? Vec3{p.x + skew, 0.4 + 1e-4, 0} : p;
    });
    const Merged m = made(slit);
    ASSERT_FALSE(m.report.broken_promises.empty());
    for (const Error& e : m.report.broken_promises)
      for (const char* option : {"--tolerance", "--trim", "--bandwidth"})
        EXPECT_EQ(e.hint.find(option), std::string::npos) << to_string(e);
  }
}

/// A roof whose ridge is a side of the hole: the surface cannot be continued across it, but its edge can be met.
TEST(Fill, ThePoorFacesOfAFillingThatIsAskedForTooMuchNameTheWayOut) {
  const Model roof = scenes::moved(scenes::plate({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 0.1), [](Vec3 p) {
    return Vec3{p.x, p.y, 0.13 * p.x - 0.95 * std::abs(p.y)};
  });
  const Model base = without_faces(
      roof, [](Vec3 p) { return p.y < (std::abs(p.x) < 0.1 ? 0.1 : 0) && std::hypot(p.x, p.y + 0.25) < 0.45; });
  FillOptions options;
  const Merged poor = made(base, options);
  ASSERT_FALSE(poor.report.broken_promises.empty());
  EXPECT_NE(poor.report.broken_promises.front().hint.find("--blend"), std::string::npos);
  options.zone.blend = Blend::kPosition;
  const Merged met = made(base, options);
  EXPECT_EQ(broken(met.report), std::vector<std::string>{});
}

TEST(Fill, NewFacesAreInTheGroupsThatAllFacesAroundShare) {
  ModelBuilder builder;
  const Model plate = scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.1, "WALL");
  for (std::size_t n = 0; n < plate.n_nodes(); ++n) {
    const NodeId node = builder.add_node(plate.position[n]);
    builder.add_to_group("ALL_NODES", node);
    if (plate.position[n].x < 0.55) builder.add_to_group("LEFT_NODES", node);
  }
  for (std::size_t e = 0; e < plate.n_elements(); ++e) {
    const Vec3 c = centroid(plate.corners(ElementId(e)));
    const auto v = plate.nodes_of(ElementId(e));
    const ElementId face = builder.add_face(v[0], v[1], v[2], c.x < 0.6 ? 1 : 2);
    builder.add_to_group("WALL", face);
    if (c.x < 0.5) builder.add_to_group("LEFT", face);
  }
  const Model base = without_faces(builder.build(), within({0.5, 0.5, 0}, 0.2));

  const Merged m = made(base);
  EXPECT_EQ(broken(m.report), std::vector<std::string>{});
  const Model result = apply(base, {}, m);
  const auto names = [&](GroupSetId set) {
    std::set<std::string> all;
    for (const GroupId g : result.group_sets.members(set)) all.insert(result.groups[g.value].name);
    return all;
  };
  ASSERT_GT(result.n_elements(), base.n_elements());
  for (std::size_t e = base.n_elements(); e < result.n_elements(); ++e) {
    EXPECT_EQ(names(result.element_groups[e]), (std::set<std::string>{"WALL"}));
    EXPECT_EQ(result.attributes_of(ElementId(e)).physical, 1);  // of the greater part of the contour
  }
  for (std::size_t n = base.n_nodes(); n < result.n_nodes(); ++n)
    EXPECT_EQ(names(result.node_groups[n]), (std::set<std::string>{"ALL_NODES"}));
}

TEST(FillLaws, RandomHolesInAPlate) {
  EXPECT_TRUE(rc::check([] {
    const auto angle = [] { return *rc::gen::inRange(0, 360) * std::numbers::pi / 180; };
    const double a = angle(), b = angle(), height = *rc::gen::inRange(-3, 4);
    const Vec3 x{std::cos(a), std::sin(a), 0}, y{-std::sin(a) * std::cos(b), std::cos(a) * std::cos(b), std::sin(b)};
    const auto at = [&](double u, double v) { return height * cross(x, y) + u * x + v * y; };
    scenes::Surface s;
    s.at = at;
    s.nu = s.nv = 16, s.jitter = 0.25;
    s.seed = static_cast<std::uint32_t>(*rc::gen::inRange(1, 1000000));
    const Model plate = scenes::surface(s);
    std::vector<std::pair<Vec3, double>> holes;
    for (int k = *rc::gen::inRange(1, 4); k > 0; --k)
      holes.push_back(
          {at(*rc::gen::inRange(20, 80) / 100.0, *rc::gen::inRange(20, 80) / 100.0), *rc::gen::inRange(5, 15) / 100.0});
    const Model holed = without_faces(plate, [&](Vec3 p) {
      return std::ranges::any_of(holes, [&](const auto& h) { return distance(p, h.first) < h.second; });
    });
    const auto contours = contours_of(holed);
    RC_PRE(std::ranges::any_of(contours, &Contour::is_hole));
    const Merged m = made(holed);
    const std::string fault = broken_laws(holed, m);
    if (!fault.empty()) RC_FAIL(fault);
    const Model result = apply(holed, {}, m);
    RC_ASSERT(contours_of(result).size() == std::size_t(std::ranges::count(contours, false, &Contour::is_hole)));
    RC_ASSERT(std::abs(check(result).area - check(holed).area - (1 - check(holed).area)) < 1e-9);
    const Merged again = made(holed);
    RC_ASSERT(apply(holed, {}, again).position == result.position);
  }));
}

/// Holes of any shape in surfaces that are curved as much as their edges are long, up to where filling is in vain:
/// what comes out is sound, or the report says what is not.
TEST(FillLaws, NothingIsWrongInSilenceOnCurvedSurfaces) {
  EXPECT_TRUE(rc::check([] {
    const double height = *rc::gen::inRange(0, 60) / 100.0, waves = *rc::gen::inRange(1, 6);
    scenes::Surface s;
    s.at = [=](double u, double v) {
      return Vec3{u, v, height / waves * std::sin(waves * (u + 0.3)) * std::cos(waves * (v - 0.2))};
    };
    s.nu = s.nv = 14, s.jitter = 0.3;
    s.seed = static_cast<std::uint32_t>(*rc::gen::inRange(1, 1000000));
    std::vector<std::pair<Vec3, double>> holes;
    for (int k = *rc::gen::inRange(1, 4); k > 0; --k)
      holes.push_back({s.at(*rc::gen::inRange(15, 85) / 100.0, *rc::gen::inRange(15, 85) / 100.0),
                       *rc::gen::inRange(7, 35) / 100.0});
    const Model holed = without_faces(scenes::surface(s), [&](Vec3 p) {
      return std::ranges::any_of(holes, [&](const auto& h) { return distance(p, h.first) < h.second; });
    });
    const auto contours = contours_of(holed);
    RC_PRE(std::ranges::any_of(contours, &Contour::is_hole));
    RC_PRE(check(holed).sound());  // the jitter may fold a cell
    FillOptions options;
    options.zone.blend = static_cast<Blend>(*rc::gen::inRange(0, 3));
    options.zone.method = *rc::gen::element(Method::kAdaptive, Method::kPaper);
    const auto result = fill(holed, options);
    if (!result) {
      RC_ASSERT(result.error().code == ErrorCode::kContourNotFilled);
      return;
    }
    const Model filled = apply(holed, {}, *result);
    const CheckResult checked = check(filled);
    RC_ASSERT(checked.flipped_edges == 0u);
    RC_ASSERT(checked.non_manifold_edges == 0u);
    const auto tells = [&](const char* word) {
      return std::ranges::any_of(broken(result->report),
                                 [&](const auto& p) { return p.find(word) != std::string::npos; });
    };
    RC_ASSERT((checked.intersections > 0) == tells("intersect"));
    RC_TAG(checked.intersections > 0 ? "intersects" : tells("folded") ? "folded" : "sound");
  }));
}

class KnownSurface : public testing::TestWithParam<std::size_t> {};

const std::vector<scenes::KnownSurface>& known_surfaces() {
  static const std::vector<scenes::KnownSurface> all = scenes::known_surfaces();
  return all;
}

/// Removed and filled again over three edges around the centre, at three sizes: a surface that meets the true one with
/// its derivatives up to order k is within h^(k + 2) of it, and its normals within h^(k + 1).
TEST_P(KnownSurface, ComesBackWithTheOrderOfTheContinuity) {
  const scenes::KnownSurface& known = known_surfaces()[GetParam()];
  constexpr double kSlack = 0.7;  // of the order, for three irregular meshes whose holes are not alike
  for (const Blend blend : {Blend::kPosition, Blend::kTangency, Blend::kCurvature}) {
    std::vector<scenes::Refill> refills;
    for (const double size : scenes::kRefillSizes) {
      refills.push_back(scenes::refilled(known, size, blend).value());
      EXPECT_EQ(broken(refills.back().merged.report), std::vector<std::string>{});
      EXPECT_EQ(broken_laws(refills.back().holed, refills.back().merged), "");
    }
    const int k = static_cast<int>(blend);
    const auto order = [&](double scenes::Refill::*error) { return scenes::order_of(refills, error); };
    EXPECT_GE(order(&scenes::Refill::distance), k + 2 - kSlack) << "continuity " << k;
    EXPECT_GE(order(&scenes::Refill::normal), k + 1 - kSlack) << "continuity " << k;
  }
}

/// The first faces across a wide hole lie far from the surface, and nodes inserted on them would fold it on the way
/// there.
TEST(Fill, WideAndSteepHolesAreFilledAsWellAsNarrowOnes) {
  struct Case {
    const char* surface;
    double radius, edges, far;  // far: between what is continued and what was there
  };
  for (const Case& c : {Case{"Saddle", 0.8, 45, 0.005}, {"SphereCap", 1.2, 14, 0.25}}) {
    const auto known = std::ranges::find(known_surfaces(), c.surface, &scenes::KnownSurface::name);
    const auto refill = scenes::refilled(*known, c.radius / c.edges, Blend::kTangency, c.edges).value();
    EXPECT_EQ(broken(refill.merged.report), std::vector<std::string>{}) << c.surface;
    EXPECT_EQ(broken_laws(refill.holed, refill.merged), "") << c.surface;
    EXPECT_GE(refill.merged.report.quality.min, 0.5) << c.surface;
    EXPECT_LE(refill.distance, c.far) << c.surface;
    EXPECT_EQ(std::ranges::count(refill.merged.report.warnings, "blend-not-reached", &Warning::name), 0) << c.surface;
  }
}

/// Rings of nodes on a surface over the plane around a round hole of radius 1: all is regular, and the first
/// triangulation of the hole lies in strips across it.
Model regular_rings(std::size_t sides, const std::function<double(double, double)>& height, std::size_t rings = 6) {
  ModelBuilder b;
  const double step = 2 * std::numbers::pi / static_cast<double>(sides);
  for (std::size_t j = 0; j <= rings; ++j)
    for (std::size_t i = 0; i < sides; ++i) {
      const double a = step * (static_cast<double>(i) + 0.5 * static_cast<double>(j));
      const double r = 1 + 0.866 * step * static_cast<double>(j), x = r * std::cos(a), y = r * std::sin(a);
      b.add_node({x, y, height(x, y)});
    }
  for (std::size_t j = 0; j < rings; ++j)
    for (std::size_t i = 0; i < sides; ++i) {
      const std::size_t at = j * sides + i, next = j * sides + (i + 1) % sides;
      const std::size_t out = at + sides, before = (j + 1) * sides + (i + sides - 1) % sides;
      b.add_face(NodeId(at), NodeId(before), NodeId(out)), b.add_face(NodeId(at), NodeId(out), NodeId(next));
    }
  return b.build();
}

TEST(Fill, WideHolesInRegularSaddlesDoNotFold) {
  for (const std::size_t sides : {60, 200}) {
    const Model base = regular_rings(sides, [](double x, double y) { return 0.25 * (x * x - y * y); });
    const Merged m = made(base);
    EXPECT_EQ(broken(m.report), std::vector<std::string>{}) << sides;
    EXPECT_EQ(broken_laws(base, m), "") << sides;
    EXPECT_GE(m.report.quality.min, 0.7) << sides;
    for (const NewNode& n : m.graft.new_nodes) {
      const auto [x, y, z] = n.position;
      EXPECT_NEAR(z, 0.25 * (x * x - y * y), 0.002) << sides;
    }
  }
}

TEST(Fill, AFlatRimOnACurvedSurfaceIsFilledAsCurved) {
  const Model base = regular_rings(60, [](double x, double y) { return std::sqrt(6.25 - x * x - y * y); });
  for (const Blend blend : {Blend::kPosition, Blend::kTangency, Blend::kCurvature}) {
    FillOptions options;
    options.zone.blend = blend;
    const Merged m = made(base, options);
    EXPECT_EQ(broken(m.report), std::vector<std::string>{});
    EXPECT_GE(m.report.quality.min, 0.7);
    double low = 2.5, high = 2.5;  // radii
    for (const NewNode& n : m.graft.new_nodes)
      low = std::min(low, norm(n.position)), high = std::max(high, norm(n.position));
    EXPECT_NEAR(low, blend == Blend::kPosition ? std::sqrt(5.25) : 2.5, 0.02);
    EXPECT_NEAR(high, 2.5, 0.02);
  }
}

/// A lid that is missing: what is around stands on it at less than a right angle, but has folds that end there.
TEST(Fill, AFlatRimWithFoldsIsFilledFlat) {
  scenes::Surface s;
  s.at = [](double u, double v) {
    const double t = 4 * u, part = t - std::floor(t), half = 1 + 0.5 * v;
    const std::array<Vec3, 5> corner{{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}}};
    const auto side = static_cast<std::size_t>(t);
    const Vec3 p = lerp(corner[side], corner[std::min<std::size_t>(side + 1, 4)], part) * half;
    return Vec3{p.x, p.y, -0.5 * v};
  };
  s.nu = 40, s.nv = 3, s.closed_u = true;
  FillOptions options;
  options.openings = {{1}};  // the shorter one
  const Merged m = made(scenes::surface(s), options);
  EXPECT_EQ(broken(m.report), std::vector<std::string>{});
  for (const NewNode& n : m.graft.new_nodes) EXPECT_EQ(n.position.z, 0);
}

/// A round hole in a flat plate of rings: all sides of the rim are alike, and shorter or longer than the faces behind
/// it.
Model ringed(std::size_t sides, double behind) {
  scenes::Surface s;
  s.at = [=](double u, double v) {
    const double a = 2 * std::numbers::pi * u, r = 1 + behind * v;
    return Vec3{r * std::cos(a), r * std::sin(a), 0};
  };
  s.nu = sides, s.nv = 1, s.closed_u = true;
  return scenes::surface(s);
}

TEST(Fill, SizesAreGradedFromTheSidesOfTheRim) {
  for (const double behind : {0.05, 0.2, 0.8})
    for (const double size : {0.0, 0.05, 0.4, 2.0}) {
      FillOptions options;
      if (size > 0) options.zone.size = size;
      const Merged m = made(ringed(40, behind), options);
      EXPECT_EQ(broken(m.report), std::vector<std::string>{}) << behind << ' ' << size;
      EXPECT_GE(m.report.quality.min, 0.5) << behind << ' ' << size;
    }
}

TEST(Fill, ASizeThatTheHoleIsTooSmallForIsToldOf) {
  const Model plate = scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.1);
  const auto told = [](const Model& holed, double size) {
    FillOptions options;
    options.zone.size = size;
    const Merged m = made(holed, options);
    EXPECT_EQ(broken(m.report), std::vector<std::string>{});
    std::vector<std::string> texts;
    for (const Warning& w : m.report.warnings)
      if (w.name == "size-not-reached") texts.push_back(w.what);
    return texts;
  };
  const Model holed = without_faces(plate, within({0.5, 0.5, 0}, 0.2));
  for (const double size : {0.05, 0.1, 0.15}) EXPECT_TRUE(told(holed, size).empty()) << size;
  for (const double size : {0.01, 1.0}) EXPECT_EQ(told(holed, size).size(), 1u) << size;

  // A triangle has no edge inside; of two holes the small one is told of.
  const Model one =
      without_faces(plate, [&](Vec3 p) { return distance(p, centroid(plate.corners(ElementId(111u)))) < 1e-9; });
  EXPECT_TRUE(told(one, 0.01).empty());
  const Model two = without_faces(scenes::plate({0, 0, 0}, {4, 0, 0}, {0, 2, 0}, 0.1), [](Vec3 p) {
    return distance(p, {0.5, 1, 0}) < 0.2 || distance(p, {2.5, 1, 0}) < 0.9;
  });
  ASSERT_EQ(told(two, 0.3).size(), 1u);
  EXPECT_NE(told(two, 0.3)[0].find("filling at (0."), std::string::npos) << told(two, 0.3)[0];
}

/// A saddle as steep as its hole is wide: the inner side of a ring, open over more than a third of its section.
TEST(Fill, AHoleInTheThroatOfATorusComesBackUnfolded) {
  scenes::Surface s;
  s.at = [](double u, double v) {
    const double a = std::numbers::pi * (u - 0.5), b = std::numbers::pi * (v - 0.5), r = 1 - 0.5 * std::cos(b);
    return Vec3{r * std::sin(a), -0.5 * std::sin(b), r * std::cos(a)};
  };
  s.nu = s.nv = 157;
  s.jitter = 0.15;
  const Model holed = without_faces(scenes::surface(s), within({0, 0, 0.5}, 0.6));
  FillOptions options;
  options.zone.min_quality = 0.4;  // nodes of the contour are near to each other
  const Merged m = made(holed, options);
  EXPECT_EQ(broken(m.report), std::vector<std::string>{});
  EXPECT_EQ(broken_laws(holed, m), "");
  for (const NewNode& n : m.graft.new_nodes) {
    const double from_ring = std::hypot(std::hypot(n.position.x, n.position.z) - 1, n.position.y);
    EXPECT_NEAR(from_ring, 0.5, 0.02);
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, KnownSurface, testing::Range(std::size_t{0}, known_surfaces().size()),
                         [](const auto& surface) { return known_surfaces()[surface.param].name; });

}  // namespace
}  // namespace meshgraft
