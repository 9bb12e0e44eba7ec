#include "merge/compatibility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "meshgraft/merge.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

Model plate(double size = 0.1) { return scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, size); }

ErrorCode code_of(const Model& base, const Model& part, const MergeOptions& options = {}) {
  const std::array<const Model*, 2> inputs{&base, &part};
  const auto result = check_compatible(inputs, options);
  EXPECT_FALSE(result.has_value());
  return result ? ErrorCode::kPromiseBroken : result.error().code;
}

TEST(Compatibility, NonsenseInOptionsIsAUsageError) {
  const Model a = plate(), b = plate();
  const auto with = [](auto&& set) {
    MergeOptions o;
    set(o);
    return o;
  };
  const double nan = std::nan("");
  for (const MergeOptions& o :
       {with([](auto& m) { m.contact_angle = 0; }), with([](auto& m) { m.contact_angle = 2; }),
        with([&](auto& m) { m.contact_angle = nan; }), with([](auto& m) { m.tolerance.value = -1; }),
        with([&](auto& m) { m.tolerance.value = nan; }), with([](auto& m) { m.tolerance.value = 0.51; }),
        with([](auto& m) { m.size = 0; }), with([&](auto& m) { m.size = nan; }), with([](auto& m) { m.bandwidth = 0; }),
        with([](auto& m) { m.min_quality = 1; }), with([](auto& m) { m.min_quality = -0.1; })})
    EXPECT_EQ(code_of(a, b, o), ErrorCode::kUsage);
}

TEST(Compatibility, LengthsAboveTheSizeOfAPartAreRefusedWithBothFigures) {
  const Model wall = scenes::plate({0, 0, 0}, {9, 0, 0}, {0, 9, 0}, 1);
  Model rib = scenes::plate({1, 4, 0}, {3, 0, 0}, {0, 0, 4}, 1);
  rib.path = "rib.unv";
  MergeOptions options;
  const auto refused = [&](const std::string& figure) {
    const auto result = merge(wall, std::span(&rib, 1), options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kUsage);
    EXPECT_NE(result.error().what.find(figure), std::string::npos) << result.error().what;
    EXPECT_NE(result.error().what.find("rib.unv is only 5 across"), std::string::npos) << result.error().what;
  };
  options.tolerance = {6, false};
  refused("tolerance of 6");
  options.tolerance = {};
  options.trim = 5.5;
  refused("up to 5.5 to be trimmed");
}

TEST(Compatibility, AToleranceThatWouldWeldTheSidesOfAThinPartIsRefusedWithTheirDistance) {
  const Model wall = scenes::plate({0, 0, 0}, {9, 0, 0}, {0, 9, 0}, 1);
  // A hollow section of two webs and a flange.
  const Model section = scenes::welded(scenes::together(
      std::array{scenes::plate({1, 4, 0}, {6, 0, 0}, {0, 0, 4}, 1), scenes::plate({1, 4.3, 0}, {6, 0, 0}, {0, 0, 4}, 1),
                 scenes::plate({1, 4, 4}, {6, 0, 0}, {0, 0.3, 0}, 1)}));
  MergeOptions options;
  options.tolerance = {0.35, false};
  const auto result = merge(wall, std::span(&section, 1), options);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kUsage);
  EXPECT_NE(result.error().what.find("tolerance of 0.35"), std::string::npos) << result.error().what;
  EXPECT_NE(result.error().what.find("0.3 apart"), std::string::npos) << result.error().what;
  options.tolerance = {0.25, false};
  EXPECT_TRUE(merge(wall, std::span(&section, 1), options));
}

TEST(Compatibility, FacesOfOneSideThatOnlySliversKeepApartAreNoThinPart) {
  // A wall of two strips, each cut from its own corners to slivers along the line between them.
  ModelBuilder builder;
  const NodeId a = builder.add_node({0, 0, 0}), b = builder.add_node({8, 0, 0}), c = builder.add_node({4, 4, 0});
  const NodeId d = builder.add_node({0, -0.001, 0}), e = builder.add_node({8, -0.001, 0}),
               f = builder.add_node({4, -4, 0.4});
  builder.add_face(a, b, c);
  builder.add_face(b, a, d);
  builder.add_face(b, d, e);
  builder.add_face(e, d, f);
  const Model wall = builder.build();
  const Model rib = scenes::plate({4, -3, -2}, {0, 6, 0}, {0, 0, 4}, 1);
  MergeOptions options;
  EXPECT_TRUE(merge(wall, std::span(&rib, 1), options));
}

TEST(Compatibility, AModelWithoutTrianglesIsNamed) {
  ModelBuilder builder;
  const NodeId n0 = builder.add_node({0, 0, 0}), n1 = builder.add_node({1, 0, 0});
  builder.add_line(n0, n1);
  const Model beams = builder.build("beams.unv"), a = plate();
  const std::array<const Model*, 2> inputs{&a, &beams};
  const auto result = check_compatible(inputs, {});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kNoFaces);
  EXPECT_EQ(result.error().place.file, "beams.unv");
}

TEST(Compatibility, TheOnlyTriangleAmongManyElementsIsFound) {
  ModelBuilder builder;
  const NodeId n0 = builder.add_node({0, 0, 0}), n1 = builder.add_node({1, 0, 0}), n2 = builder.add_node({0, 1, 0});
  for (int k = 0; k < 10'001; ++k) builder.add_line(n0, n1);
  builder.add_face(n0, n1, n2);
  const Model mixed = builder.build(), a = plate();
  const std::array<const Model*, 2> inputs{&a, &mixed};
  EXPECT_TRUE(check_compatible(inputs, {}).has_value());
}

TEST(Compatibility, UnitFactorsMustAgreeAndBothAreNamed) {
  Model a = plate(), b = plate();
  a.units = Units{1, 1.0, 1.0, 1.0, 273.15};
  b.units = Units{5, 1000.0, 1.0, 1.0, 273.15};
  a.path = "a.unv", b.path = "b.unv";
  const std::array<const Model*, 2> inputs{&a, &b};
  const auto result = check_compatible(inputs, {});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kUnitsDiffer);
  for (const char* word : {"a.unv", "b.unv", "length 1,", "length 1000,"})
    EXPECT_NE(result.error().what.find(word), std::string::npos) << word;
  b.units.reset();
  EXPECT_TRUE(check_compatible(inputs, {}).has_value());  // a file that says nothing contradicts nothing
}

TEST(Compatibility, CoordinatesInASystemOfTheirOwnAreRefused) {
  CoordinateSystem rim{.label = 3, .type = 1, .first_node = NodeId(4u), .first_placed = NodeId(4u)};
  Model a = plate(), b = plate();
  const std::array<const Model*, 2> inputs{&a, &b};
  a.coordinate_systems = b.coordinate_systems = {rim};
  const auto refused = check_compatible(inputs, {});
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, ErrorCode::kCoordinateSystem);
  EXPECT_NE(refused.error().what.find("cylindrical"), std::string::npos) << refused.error().what;
  rim.type = 0;  // the global one under another label
  a.coordinate_systems = b.coordinate_systems = {rim};
  EXPECT_TRUE(check_compatible(inputs, {}).has_value());
}

TEST(Compatibility, ASystemThatNodesOfAPartNameMeansTheSameInTheBase) {
  const CoordinateSystem rim{.label = 3, .type = 1, .first_node = NodeId(4u)};
  CoordinateSystem unused = rim, moved = rim, global{.label = 3, .first_node = NodeId(4u)};
  unused.first_node = {}, moved.axes[9] = 0.5;
  const auto accepts = [](const std::vector<CoordinateSystem>& in_base, const std::vector<CoordinateSystem>& in_part) {
    Model a = plate(), b = plate();
    a.coordinate_systems = in_base, b.coordinate_systems = in_part;
    const std::array<const Model*, 2> inputs{&a, &b};
    const auto result = check_compatible(inputs, {});
    if (result) return true;
    EXPECT_EQ(result.error().code, ErrorCode::kCoordinateSystem);
    EXPECT_NE(result.error().what.find("node 5 "), std::string::npos) << result.error().what;
    return false;
  };
  EXPECT_TRUE(accepts({rim}, {rim}));
  EXPECT_TRUE(accepts({unused}, {rim}));
  EXPECT_TRUE(accepts({}, {global}));
  EXPECT_TRUE(accepts({rim}, {}));
  EXPECT_TRUE(accepts({moved}, {unused}));
  EXPECT_FALSE(accepts({}, {rim}));
  EXPECT_FALSE(accepts({moved}, {rim}));
  EXPECT_FALSE(accepts({global}, {rim}));
  EXPECT_FALSE(accepts({unused}, {global}));  // would get the meaning that the base gives the label
}

TEST(Compatibility, ModelsAThousandTimesApartInScaleAreRefusedEitherWay) {
  const Model a = plate();
  for (const double scale : {1000.0, 0.001})
    EXPECT_EQ(code_of(a, scenes::moved(plate(), [=](Vec3 p) { return scale * p; })), ErrorCode::kScaleMismatch);
}

TEST(Compatibility, ASmallPartWithLikeEdgesOrAFineMeshOfLikeSizeIsNoMismatch) {
  const Model ship = scenes::plate({0, 0, 0}, {300, 0, 0}, {0, 0.2, 0}, 0.1);
  const Model clip = scenes::plate({0, 0, 0}, {0.3, 0, 0}, {0, 0.3, 0}, 0.1);
  const std::array<const Model*, 2> inputs{&ship, &clip};
  EXPECT_TRUE(check_compatible(inputs, {}).has_value());
}

TEST(Compatibility, EdgesTwoHundredTimesApartWhereTheyMeetAreRefused) {
  const Model coarse = scenes::plate({0, 0, 0}, {100, 0, 0}, {0, 100, 0}, 50), fine = plate(0.1);
  const std::array<const Model*, 2> inputs{&coarse, &fine};
  std::vector<std::vector<ElementId>> all(2);
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t e = 0; e < inputs[k]->n_elements(); ++e) all[k].emplace_back(e);
  const auto result = check_local_scale(inputs, all, {});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kScaleMismatch);
}

TEST(Compatibility, AnEdgeLengthTwoHundredTimesApartFromThoseOfBothMeshesIsRefused) {
  const Model coarse = scenes::plate({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, 2), fine = plate(0.1);
  const std::array<const Model*, 2> inputs{&coarse, &fine};
  std::vector<std::vector<ElementId>> all(2);
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t e = 0; e < inputs[k]->n_elements(); ++e) all[k].emplace_back(e);
  const auto accepts = [&](double size) {
    MergeOptions options;
    options.size = size;
    const auto result = check_local_scale(inputs, all, options);
    if (!result) {
      EXPECT_EQ(result.error().code, ErrorCode::kUsage);
    }
    return result.has_value();
  };
  EXPECT_TRUE(accepts(0.001) && accepts(1) && accepts(300));
  EXPECT_FALSE(accepts(1e-9) || accepts(1e-4) || accepts(1000));
}

TEST(Compatibility, ACoordinateThatIsNoNumberIsFoundWithItsNode) {
  const Model a = plate();
  Model b = plate();
  b.position[7].y = std::numeric_limits<double>::infinity();
  const std::array<const Model*, 2> inputs{&a, &b};
  const auto result = check_compatible(inputs, {});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kBadNumber);
  EXPECT_NE(result.error().what.find("node 8"), std::string::npos);
}

}  // namespace
}  // namespace meshgraft
