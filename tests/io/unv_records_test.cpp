// Numbers, nodes, elements (unv.md 6, rules 5 to 9 and 14; 9, traps 10 to 22 and 27).
#include <algorithm>

#include "io/unv_samples.hpp"

namespace meshgraft {
namespace {

using namespace samples;
using Labels = std::vector<std::int64_t>;

Model with_reals(const std::string& reals) { return read(dataset("2411", node(7, reals))); }

TEST(UnvNodes, ExponentsOfAllKinds) {
  const std::string d = "   1.2500000000000000D+01  -1.0000000000000000D-03   3.3333333333333331D-01";
  for (const char letter : {'D', 'd', 'E', 'e', 'Q'}) {
    const Model m = with_reals(replaced(d, "D", std::string(1, letter)));
    EXPECT_EQ(m.position[0], (Vec3{12.5, -0.001, 1.0 / 3.0})) << letter;
  }
  EXPECT_EQ(with_reals("    1.250000000000000+001   -1.000000000000000-003    0.125000000000000+000").position[0],
            (Vec3{12.5, -0.001, 0.125}));
}

TEST(UnvNodes, ThreeDigitExponentsThatFillTheirColumns) {
  const Model m = with_reals("-1.0000000000000000E-0001-2.00000000000000000E+001-1.2500000000000000D+0010");
  EXPECT_EQ(m.position[0], (Vec3{-0.1, -20, -1.25e10}));
}

TEST(UnvNodes, RealsWithoutDigitsOnOneSideOfThePoint) {
  const Model m = with_reals("   .5000000069999999D-01                 -.5D+00                      3.");
  EXPECT_EQ(m.position[0], (Vec3{.5000000069999999e-01, -.5, 3}));
}

TEST(UnvNodes, FreeFormatAndTabs) {
  const Model m = read(dataset("2411", "7 1 1 11\n1.5 -2 3e-1\n\t8\t1\t1\t11\n\t1\t2\t3\n"));
  EXPECT_EQ(m.node_label, (Labels{7, 8}));
  EXPECT_EQ(m.position[0], (Vec3{1.5, -2, 0.3}));
  EXPECT_TRUE(warns(m, "free-format"));
}

TEST(UnvNodes, WiderColumnsThanUsual) {
  const Model m = read(dataset("2411",
                               "           7           1           1          11\n"
                               "     1.000000000000000000000E+00     2.000000000000000000000E+00     3.0E+00\n"));
  EXPECT_EQ(m.node_label, (Labels{7}));
  EXPECT_EQ(m.position[0], (Vec3{1, 2, 3}));
}

TEST(UnvNodes, LabelsOfTenDigitsThatTouch) {
  const Model m = read(dataset("2411",
                               "9876543210         1         1        11\n"
                               "   1.0000000000000000D+00   2.0000000000000000D+00   3.0000000000000000D+00\n") +
                       dataset("2412", line({1, 91, 1, 1, 7, 3}) + "987654321098765432109876543210\n"));
  EXPECT_EQ(m.node_label, (Labels{9876543210}));
  EXPECT_EQ(m.nodes_of(ElementId(0u)).size(), 3u);
  EXPECT_TRUE(warns(m, "large-label"));
}

TEST(UnvNodes, LabelZeroGapsAndOrder) {
  const std::string reals = "   1.0000000000000000D+00   2.0000000000000000D+00   3.0000000000000000D+00";
  const Model m = read(dataset("2411", node(500000000, reals) + node(0, reals) + node(7, reals)) +
                       dataset("2412", line({3, 91, 1, 1, 7, 3}) + line({0, 7, 500000000})));
  EXPECT_EQ(m.node_label, (Labels{500000000, 0, 7}));
  const auto nodes = m.nodes_of(ElementId(0u));
  EXPECT_EQ(nodes[0], NodeId(1u));
  EXPECT_EQ(nodes[1], NodeId(2u));
  EXPECT_EQ(nodes[2], NodeId(0u));
}

TEST(UnvNodes, TwoCoordinates) {
  const Model m = with_reals("   1.0000000000000000D+00   2.0000000000000000D+00");
  EXPECT_EQ(m.position[0], (Vec3{1, 2, 0}));
  EXPECT_TRUE(warns(m, "two-coordinates"));
}

TEST(UnvNodes, OldDatasets) {
  EXPECT_EQ(read(dataset("781", kNodes)).n_nodes(), 6u);
  const Model m = read(dataset(
      "15", line({4, 0, 0, 8}).substr(0, 40) + "  1.00000E+00 -2.50000E+00  3.00000E-01\n" + line({9, 0, 0, 8}) +
                "   1.0000000000000000D+00   2.0000000000000000D+00   3.0000000000000000D+00\n"));
  EXPECT_EQ(m.node_label, (Labels{4, 9}));
  EXPECT_EQ(m.position[0], (Vec3{1, -2.5, 0.3}));
  EXPECT_EQ(m.position[1], (Vec3{1, 2, 3}));
}

TEST(UnvNodes, BlankLinesBetweenRecords) {
  EXPECT_EQ(read(dataset("2411", kNodes.substr(0, 117) + "\n   \n" + kNodes.substr(117))).n_nodes(), 6u);
}

TEST(UnvNodes, TheSameRecordTwiceCountsOnce) {
  const Model m = read(dataset("2411", kNodes + kNodes.substr(0, 117)) + dataset("2412", kElements + kElements));
  EXPECT_EQ(m.n_nodes(), 6u);
  EXPECT_EQ(m.n_elements(), 5u);
  EXPECT_EQ(m.node_place.size(), 6u);
  EXPECT_EQ(std::ranges::count(m.warnings, "repeated-record", &Warning::name), 2) << "of nodes, and of elements";
}

Model with_elements(const std::string& records, const std::string& number = "2412") {
  return read(dataset("2411", kNodes) + dataset(number, records) + dataset("2467", kGroups));
}

std::vector<std::size_t> node_counts(const Model& m) {
  std::vector<std::size_t> counts;
  for (std::size_t e = 0; e < m.n_elements(); ++e) counts.push_back(m.nodes_of(ElementId(e)).size());
  return counts;
}

using Counts = std::vector<std::size_t>;
const std::string kTriangle = line({90, 91, 1, 1, 7, 3}) + line({1, 2, 5});

TEST(UnvElements, TaperedBeamOfTwoAndOfThreeNodes) {
  const Model m = with_elements(line({1, 22, 1, 1, 7, 2}) + line({0, 1, 1}) + line({1, 2}) + line({2, 22, 1, 1, 7, 3}) +
                                line({0, 1, 1}) + line({1, 2, 3}) + kTriangle);
  EXPECT_EQ(node_counts(m), (Counts{2, 3, 3}));
  EXPECT_EQ(m.shape(ElementId(1u)), Shape::kLine3);
  EXPECT_TRUE(m.warnings.empty() || !warns(m, "beam-record"));
}

TEST(UnvElements, PipesWithAndWithoutBeamRecord) {
  const std::string with = line({1, 31, 1, 1, 7, 2}) + line({0, 1, 1}) + line({1, 2}) + line({2, 32, 1, 1, 7, 3}) +
                           line({0, 1, 1}) + line({1, 2, 3});
  const std::string without = line({1, 31, 1, 1, 7, 2}) + line({1, 2}) + line({2, 32, 1, 1, 7, 3}) + line({1, 2, 3});
  for (const std::string& tail : {std::string(), kTriangle}) {
    for (const std::string& records : {with, without}) {
      const Model m = with_elements(records + tail);
      ASSERT_GE(m.n_elements(), 2u);
      EXPECT_EQ(m.nodes_of(ElementId(0u))[0], NodeId(0u));
      EXPECT_EQ(m.nodes_of(ElementId(1u))[0], NodeId(0u));
      EXPECT_EQ(m.nodes_of(ElementId(1u))[2], NodeId(2u));
    }
  }
}

TEST(UnvElements, BeamRecordForgottenOrInvented) {
  const Model forgotten = with_elements(line({1, 11, 1, 1, 7, 2}) + line({1, 2}) + kTriangle);
  EXPECT_EQ(node_counts(forgotten), (Counts{2, 3}));
  EXPECT_TRUE(warns(forgotten, "beam-record"));
  const Model invented = with_elements(line({1, 91, 1, 1, 7, 3}) + line({0, 1, 1}) + line({1, 2, 5}) + kTriangle);
  EXPECT_EQ(node_counts(invented), (Counts{3, 3}));
  EXPECT_EQ(invented.nodes_of(ElementId(0u))[0], NodeId(0u));
  EXPECT_TRUE(warns(invented, "beam-record"));
}

TEST(UnvElements, ANumberOfNodesThatTheTypeDoesNotHaveIsTold) {
  for (const auto& odd : {line({1, 91, 1, 1, 7, 4}) + line({1, 2, 5, 4}), line({1, 91, 1, 1, 7, 2}) + line({1, 2}),
                          line({1, 94, 1, 1, 7, 0}), line({1, 777, 1, 1, 7, 0})}) {
    const Model m = with_elements(odd + kTriangle);
    EXPECT_TRUE(warns(m, "node-count")) << odd;
    EXPECT_EQ(m.shape(ElementId(0u)), Shape::kOther);
    EXPECT_EQ(m.shape(ElementId(1u)), Shape::kTriangle);
  }
  for (const auto& usual : {line({2, 41, 1, 1, 7, 3}) + line({1, 2, 5}), line({1, 777, 1, 1, 7, 2}) + line({1, 2}),
                            line({1, 122, 1, 1, 7, 1}) + line({1})})
    EXPECT_FALSE(warns(with_elements(usual + kTriangle), "node-count")) << usual;
}

TEST(UnvElements, OrientationNodeStaysKnown) {
  const Model m = with_elements(line({1, 21, 1, 1, 7, 2}) + line({6, 1, 1}) + line({1, 2}) + kTriangle);
  ASSERT_EQ(m.orientation_nodes.size(), 1u);
  EXPECT_EQ(m.orientation_nodes[0].node, NodeId(5u));
}

TEST(UnvElements, Dataset780HasFiveIntegersInItsBeamRecord) {
  const Model m = with_elements(line({1, 21, 4, 5, 6, 7, 11, 2}) + line({0, 1, 1, 1, 1}) + line({1, 2}) +
                                    line({2, 94, 4, 5, 6, 7, 11, 4}) + line({1, 2, 5, 4}),
                                "780");
  EXPECT_EQ(node_counts(m), (Counts{2, 4}));
  const ElementAttributes& a = m.attributes_of(ElementId(1u));
  EXPECT_EQ(a.physical_bin, 4);
  EXPECT_EQ(a.physical, 5);
  EXPECT_EQ(a.material_bin, 6);
  EXPECT_EQ(a.material, 7);
  EXPECT_EQ(a.colour, 11);
  EXPECT_EQ(m.shape(ElementId(1u)), Shape::kQuad);
}

TEST(UnvElements, Dataset71HasGraphicalCodesAndNoBeamRecord) {
  const Model m =
      with_elements(line({1, 1, 0, 5, 6, 7, 2}) + line({1, 2}) + line({2, 2, 0, 5, 6, 7, 3}) + line({1, 2, 5}), "71");
  EXPECT_EQ(node_counts(m), (Counts{2, 3}));
  EXPECT_EQ(m.shape(ElementId(0u)), Shape::kLine);
  EXPECT_EQ(m.shape(ElementId(1u)), Shape::kTriangle);
}

TEST(UnvElements, RigidAndUnknownElementsKeepTheirNodes) {
  const Model m = with_elements(line({1, 122, 1, 1, 7, 5}) + line({1, 2, 3, 4, 5}) + line({2, 999, 1, 1, 7, 11}) +
                                line({1, 2, 3, 4, 5, 6, 1, 2}) + line({3, 4, 5}) + kTriangle);
  EXPECT_EQ(node_counts(m), (Counts{5, 11, 3}));
  EXPECT_EQ(m.shape(ElementId(0u)), Shape::kOther);
  EXPECT_EQ(m.shape(ElementId(1u)), Shape::kOther);
  EXPECT_EQ(m.attributes_of(ElementId(1u)).type, 999);
}

TEST(UnvElements, NodeListsOverSeveralLinesHoweverLong) {
  const Model usual = with_elements(line({1, 116, 1, 1, 7, 20}) + line({1, 2, 3, 4, 5, 6, 1, 2}) +
                                    line({3, 4, 5, 6, 1, 2, 3, 4}) + line({5, 6, 1, 2}) + kTriangle);
  EXPECT_EQ(node_counts(usual), (Counts{20, 3}));
  EXPECT_EQ(usual.shape(ElementId(0u)), Shape::kSolid);
  const Model six = with_elements(line({1, 116, 1, 1, 7, 20}) + line({1, 2, 3, 4, 5, 6}) + line({1, 2, 3, 4, 5, 6}) +
                                  line({1, 2, 3, 4, 5, 6}) + line({1, 2}) + kTriangle);
  EXPECT_EQ(node_counts(six), (Counts{20, 3}));
}

TEST(UnvElements, MissingMiddleNodeIsNoNode) {
  const Model m = with_elements(line({1, 92, 1, 1, 7, 6}) + line({1, 2, 3, 0, 5, 4}) + kTriangle);
  EXPECT_FALSE(m.nodes_of(ElementId(0u))[3].valid());
}

TEST(UnvElements, NodeCountDecidesTheShape) {
  const Model m = with_elements(line({1, 91, 1, 1, 7, 4}) + line({1, 2, 5, 4}) + line({2, 114, 1, 1, 7, 13}) +
                                line({1, 2, 3, 4, 5, 6, 1, 2}) + line({3, 4, 5, 6, 1}) + kTriangle);
  EXPECT_EQ(m.shape(ElementId(0u)), Shape::kOther);
  EXPECT_EQ(m.shape(ElementId(1u)), Shape::kSolid);
}

TEST(UnvElements, HeadersThatChangeBackAndForth) {
  const auto triangle = [](std::int64_t label, std::int64_t property) {
    return line({label, 91, property, 1, 7, 3}) + line({1, 2, 5});
  };
  const Model m = with_elements(triangle(1, 4) + triangle(2, 4) + line({3, 21, 4, 1, 7, 2}) + line({6, 1, 1}) +
                                line({1, 2}) + triangle(4, 4) + triangle(5, 9) + "6 91 8 1 7 3\n1 2 5\n" +
                                triangle(7, 9) + line({8, 94, 9, 1, 7, 4}) + line({1, 2, 5, 4}) + triangle(9, 9));
  EXPECT_EQ(node_counts(m), (Counts{3, 3, 2, 3, 3, 3, 3, 4, 3}));
  std::vector<std::int64_t> properties;
  for (std::size_t e = 0; e < m.n_elements(); ++e) properties.push_back(m.attributes_of(ElementId(e)).physical);
  EXPECT_EQ(properties, (std::vector<std::int64_t>{4, 4, 4, 4, 9, 8, 9, 9, 9}));
  EXPECT_EQ(m.orientation_nodes.size(), 1u);
}

TEST(UnvElements, NegativePropertyNumbersAreWarnedAbout) {
  EXPECT_TRUE(warns(with_elements(line({1, 91, -1, 1, 7, 3}) + line({1, 2, 5}) + kTriangle), "negative-number"));
}

}  // namespace
}  // namespace meshgraft
