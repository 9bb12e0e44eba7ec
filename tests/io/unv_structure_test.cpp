// Delimiters, line ends and datasets (unv.md 6, rules 1 to 4; 9, traps 1 to 9 and 16).
#include <fmt/format.h>

#include "io/unv_samples.hpp"

namespace meshgraft {
namespace {

using namespace samples;
using Labels = std::vector<std::int64_t>;

void expect_mesh(const Model& m) {
  EXPECT_EQ(m.node_label, (Labels{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(m.element_label, (Labels{1, 2, 3, 4, 5}));
  ASSERT_EQ(m.groups.size(), 2u);
  EXPECT_EQ(m.groups[1].name, "ENDS");
  EXPECT_EQ(nodes_in(m, 1), (Labels{3, 6}));
  EXPECT_EQ(elements_in(m, 1), (Labels{5}));
}

TEST(UnvStructure, PlainFile) {
  const Model m = read(mesh());
  expect_mesh(m);
  EXPECT_TRUE(m.warnings.empty());
  EXPECT_EQ(m.position[0].z, 1.0 / 3.0);
  EXPECT_EQ(m.shape(ElementId(0u)), Shape::kTriangle);
  EXPECT_EQ(m.shape(ElementId(4u)), Shape::kLine);
  EXPECT_EQ(m.attributes_of(ElementId(4u)).physical, 3);
  EXPECT_EQ(place_of(m, NodeId(1u)).line, 5u);
}

TEST(UnvStructure, DelimiterPaddedTo80Columns) {
  expect_mesh(read(replaced(mesh(), "    -1\n", "    -1" + std::string(74, ' ') + "\n")));
}

TEST(UnvStructure, LoneMinusOneInOtherColumnsIsDataOfUnknownDatasets) {
  const Model m = read(dataset("3206", line({-1}) + "        -1\n  text\n        -1\n") + mesh());
  expect_mesh(m);
  EXPECT_TRUE(m.warnings.empty());
}

TEST(UnvStructure, NumberThatBeginsLikeADelimiterIsData) {
  expect_mesh(read(dataset("1101", "    -12345\n    -1 2411\n") + mesh()));
}

TEST(UnvStructure, TextBetweenDatasetsIsKeptAndWarnedAbout) {
  const Model m = read(dataset("2411", kNodes) + "written by hand\n\n" + dataset("2412", kElements) + "the end\n" +
                       dataset("2467", kGroups));
  expect_mesh(m);
  EXPECT_TRUE(warns(m, "text-outside"));
}

TEST(UnvStructure, TextAfterTheDatasetNumber) { expect_mesh(read(replaced(mesh(), "  2411\n", "  2411   %NODES\n"))); }

TEST(UnvStructure, MissingLastDelimiterMayBeACutAndIsTakenOnlyWhereAllowed) {
  const std::string closing = "    -1\n";
  for (const std::string& last : {mesh(), mesh() + dataset("757", line({1}) + "DOF\n")})
    for (const std::size_t cut : {closing.size(), closing.size() + 1}) {  // with a line end, and without
      const std::string text = last.substr(0, last.size() - cut);
      const Model m = read(text, {.unclosed = true});
      expect_mesh(m);
      EXPECT_TRUE(warns(m, "missing-delimiter"));
      const Error e = error_of(text);
      EXPECT_EQ(e.code, ErrorCode::kTruncated);
      EXPECT_EQ(e.place.line, static_cast<std::uint64_t>(std::ranges::count(last, '\n')) - 1);
    }
}

TEST(UnvStructure, OneDelimiterBetweenTwoDatasets) {
  const Model m = read(replaced(mesh(), "    -1\n    -1\n", "    -1\n"));
  expect_mesh(m);
  EXPECT_TRUE(warns(m, "missing-delimiter"));
}

TEST(UnvStructure, MissingFirstDelimiter) {
  const Model m = read(mesh().substr(7));
  expect_mesh(m);
  EXPECT_TRUE(warns(m, "missing-delimiter"));
}

TEST(UnvStructure, ClosingDelimiterInOtherColumns) {
  const Model m = read(opening("2411") + kNodes + "   -1\n" + dataset("2412", kElements) + dataset("2467", kGroups));
  expect_mesh(m);
  EXPECT_TRUE(warns(m, "misplaced-delimiter"));
}

TEST(UnvStructure, DelimiterSpelledDifferentlyThroughout) {
  for (const std::string spelling : {"-1\n", "  -1\n", "\t-1\n"}) {
    const Model m = read(replaced(mesh(), "    -1\n", spelling));
    expect_mesh(m);
    EXPECT_TRUE(warns(m, "learned-delimiter"));
  }
}

TEST(UnvStructure, LineEndsOfOtherSystems) {
  expect_mesh(read(replaced(mesh(), "\n", "\r\n")));
  expect_mesh(read(replaced(mesh(), "\n", "\r")));
}

TEST(UnvStructure, ByteOrderMarkControlZAndZeros) {
  expect_mesh(read("\xEF\xBB\xBF" + mesh() + "\x1A" + std::string(3, '\0')));
  expect_mesh(read("\n\n" + mesh() + "\n\n"));
}

TEST(UnvStructure, BinaryDatasetIsSkippedByItsNumberOfBytes) {
  std::string bytes = std::string("\0\x01\n    -1\n  2411\n", 17) + "\n    -1\n    -1\n  2412\n";
  const std::string count = std::to_string(bytes.size());
  std::string header = "    58b     1     2           2" + std::string(12 - count.size(), ' ') + count +
                       "     0     0           0           0\n";
  const std::string binary = "    -1\n" + header + "first\nsecond\n" + bytes + "    -1\n";
  expect_mesh(read(binary + mesh()));
  expect_mesh(read(mesh() + binary));
  expect_mesh(read(mesh() + binary + binary));
  EXPECT_EQ(error_of(mesh() + binary.substr(0, binary.size() - 30)).code, ErrorCode::kTruncated);
  const std::string touching = replaced(binary, "           2" + std::string(12 - count.size(), ' ') + count,
                                        "           2" + std::string("100000000000"));
  EXPECT_EQ(error_of(touching + mesh()).code, ErrorCode::kTruncated);
}

TEST(UnvStructure, DatasetsInAnyOrderAndSplit) {
  const Model m = read(dataset("2467", kGroups) + dataset("2412", kElements) + dataset("2411", kNodes));
  expect_mesh(m);
  const std::string first = kNodes.substr(0, 41 + 76), rest = kNodes.substr(41 + 76);
  expect_mesh(
      read(dataset("2411", first) + dataset("2412", kElements) + dataset("2411", rest) + dataset("2467", kGroups)));
}

TEST(UnvStructure, SeveralModelsWithLabelsOfTheirOwnAreReadAsOne) {
  const std::string header = "           1     0     0\nHULL\n";
  const std::string far = node(101, "   9.0000000000000000D+00   0.0000000000000000D+00   3.3333333333333331D-01");
  const Model m = read(dataset("2400", header) + mesh() + dataset("2400", header) + dataset("2411", far));
  EXPECT_EQ(m.node_label, (Labels{1, 2, 3, 4, 5, 6, 101}));
}

TEST(UnvStructure, SeveralModelsWithTheSameLabelsAreRefusedAndNamed) {
  const std::string moved = replaced(kNodes, "3.3333333333333331D-01", "5.0000000000000000D+00");
  const Error e = error_of(dataset("2400", "           1     0     0\nHULL\n") + mesh() +
                           dataset("2400", "           2     0     0\nDECK\n") + dataset("2411", moved));
  EXPECT_EQ(e.code, ErrorCode::kSeveralModels);
  EXPECT_NE(e.what.find("HULL"), std::string::npos);
  EXPECT_NE(e.what.find("DECK"), std::string::npos);
}

TEST(UnvStructure, UnitsAreReadByColumns) {
  const std::string units =
      "         5mm (milli newton)            2\n"
      "   1.0000000000000000D+03   1.0000000000000000D+03   1.0000000000000000D+00\n"
      "   2.7314999999999998D+02\n";
  const Model m = read(dataset("164", units) + mesh());
  ASSERT_TRUE(m.units);
  EXPECT_EQ(m.units->code, 5);
  EXPECT_EQ(m.units->length, 1000);
  EXPECT_EQ(m.units->temperature_offset, 273.15);
}

TEST(UnvStructure, SystemThatIsNotTheGlobalOneIsWarnedAbout) {
  const std::string system = line({1}) + "part\n" + line({1, 1, 8}) + "CYLINDER\n" +
                             "   1.0000000000000000D+00   0.0000000000000000D+00   0.0000000000000000D+00\n"
                             "   0.0000000000000000D+00   1.0000000000000000D+00   0.0000000000000000D+00\n"
                             "   0.0000000000000000D+00   0.0000000000000000D+00   1.0000000000000000D+00\n"
                             "   0.0000000000000000D+00   0.0000000000000000D+00   0.0000000000000000D+00\n";
  EXPECT_TRUE(warns(read(dataset("2420", system) + mesh()), "coordinate-system"));
  EXPECT_FALSE(
      warns(read(dataset("2420", replaced(system, line({1, 1, 8}), line({1, 0, 8}))) + mesh()), "coordinate-system"));
  EXPECT_TRUE(warns(read(dataset("2420", replaced(system, "D+00   1", "D+00   x")) + mesh()), "coordinate-system"));
}

TEST(UnvStructure, OnlyOldDatasetsGiveCoordinatesInASystem) {
  const std::string old = line({5, 1, 0, 8, 0}) + "RIM\n" +
                          "  1.00000E+00  2.00000E+00  3.00000E+00  1.00000E+00  4.00000E+00  3.00000E+00\n"
                          "  1.00000E+00  2.00000E+00  9.00000E+00\n";
  const auto with = [&](const char* dataset_number, std::initializer_list<std::int64_t> record) {
    const std::string nodes = replaced(kNodes, line({6, 1, 1, 11}), line(record));
    return read(dataset("18", old) + dataset(dataset_number, nodes) + dataset("2412", kElements));
  };
  const Model placed = with("781", {6, 5, 1, 11}), shown = with("2411", {6, 5, 1, 11});
  EXPECT_EQ(placed.coordinate_system(5).first_placed, NodeId(5u));
  EXPECT_FALSE(shown.coordinate_system(5).first_placed.valid());
  EXPECT_TRUE(warns(placed, "coordinate-system"));
  EXPECT_TRUE(warns(shown, "coordinate-system"));
  const Model displaced = with("2411", {6, 1, 5, 11});
  EXPECT_EQ(displaced.coordinate_system(5).first_node, NodeId(5u));
  EXPECT_FALSE(displaced.coordinate_system(5).first_placed.valid());
  EXPECT_FALSE(warns(displaced, "coordinate-system"));  // nothing geometric
}

TEST(UnvStructure, SystemsAreThoseDefinedAndThoseNamedByNodes) {
  const std::string old = line({5, 1, 0, 8, 0}) + "RIM\n" +
                          "  1.00000E+00  2.00000E+00  3.00000E+00  1.00000E+00  4.00000E+00  3.00000E+00\n"
                          "  1.00000E+00  2.00000E+00  9.00000E+00\n";
  // The last node asks for results in system 4; both readers of records must see it.
  for (const std::string spoilt : {"", "\n"}) {
    const std::string nodes = replaced(kNodes, line({6, 1, 1, 11}), spoilt + line({6, 1, 4, 11}));
    const Model m = read(dataset("18", old) + dataset("2411", nodes) + dataset("2412", kElements));
    ASSERT_EQ(m.coordinate_systems.size(), 3u);
    EXPECT_EQ(m.coordinate_systems[0].label, 1);
    EXPECT_EQ(m.coordinate_systems[0].first_node, NodeId(0u));
    EXPECT_EQ(m.coordinate_systems[1].label, 4);
    EXPECT_EQ(m.coordinate_systems[1].first_node, NodeId(5u));
    EXPECT_TRUE(m.coordinate_systems[1].is_global());
    const CoordinateSystem rim = m.coordinate_system(5);
    EXPECT_FALSE(rim.first_node.valid());
    EXPECT_EQ(rim.type, 1);
    EXPECT_EQ(rim.axes, (std::array<double, 12>{0, 1, 0, -1, 0, 0, 0, 0, 1, 1, 2, 3}));
  }
}

/// Many nodes in a line along x, labelled from `first`.
std::string nodes_in_line(std::int64_t first, std::int64_t n) {
  std::string text;
  for (std::int64_t k = 0; k < n; ++k)
    text += node(first + k, fmt::format("{:25.16E}{:25.16E}{:25.16E}", static_cast<double>(first + k), 0.0, 0.0));
  return text;
}

// Records that look alike are passed over when datasets are looked for; a dataset that begins among them, at whatever
// distance, is found all the same.
TEST(UnvStructure, DatasetAmongRecordsThatLookAlike) {
  const std::string record = nodes_in_line(1, 1);
  for (const std::size_t more : {0u, 1u, 40u})  // characters by which what is between is no multiple of a record
    for (const std::int64_t before : {1, 2, 3, 6, 9}) {
      std::string between = "    -1\n" + opening("3206");
      const std::string reopened = "    -1\n" + opening("2411");
      const std::size_t filling = record.size() + more - between.size() - reopened.size() - 1;
      between += std::string(filling, 'x') + "\n" + reopened;
      const Model m =
          read(opening("2411") + nodes_in_line(1, before) + between + nodes_in_line(before + 1, 3000) + "    -1\n");
      ASSERT_EQ(m.n_nodes(), static_cast<std::size_t>(before + 3000));
      EXPECT_EQ(m.node_label.back(), before + 3000);
      EXPECT_TRUE(m.warnings.empty());
    }
}

TEST(UnvStructure, FaultAmongRecordsThatLookAlikeIsFoundInItsLine) {
  const std::string good = opening("2411") + nodes_in_line(1, 3000) + "    -1\n";
  for (const std::size_t k : {1u, 2u, 500u, 2999u}) {
    std::string text = good;
    const std::size_t line = 14 + k * nodes_in_line(1, 1).size();
    text.replace(line + 50, 3, "x.0");
    const Error e = error_of(text);
    EXPECT_EQ(e.code, ErrorCode::kBadNumber);
    EXPECT_EQ(e.place.line, 2 + 2 * (k + 1));
  }
}

// As many characters as records of equal length would have, but more records or less.
TEST(UnvStructure, RecordsOfUnequalLengthThatAddUp) {
  const std::size_t length = nodes_in_line(1, 1).size();
  std::string two = "7 1 1 11\n1 2 3\n8 1 1 11\n1 2 3";
  two.append(length - two.size() - 1, ' ').append("\n");
  const std::string twice = node(7, fmt::format("{:25}{:25}{:25}{:{}}", 1, 2, 3, "", length));
  ASSERT_EQ(twice.size(), 2 * length);
  for (const std::string& odd : {two, twice}) {
    const Model m = read(dataset("2411", nodes_in_line(10, 4) + odd + nodes_in_line(20, 3000)));
    ASSERT_EQ(m.n_nodes(), odd == two ? 3006u : 3005u);
    EXPECT_EQ(m.node_label[4], 7);
    EXPECT_EQ(m.position[4], (Vec3{1, 2, 3}));
    EXPECT_EQ(m.node_label.back(), 3019);
  }
}

// Among beams that look alike, a delimiter with blanks behind it is as long as a beam line.
TEST(UnvStructure, DelimiterIsNoBeamLine) {
  std::string elements;
  for (std::int64_t label = 1; label <= 3000; ++label)
    elements += line({label, 21, 1, 1, 7, 2}) + line({0, 1, 1}) + line({1, 2});
  const std::string good = dataset("2411", kNodes) + dataset("2412", elements);
  ASSERT_EQ(read(good).n_elements(), 3000u);
  const std::string beam = line({700, 21, 1, 1, 7, 2}) + line({0, 1, 1});
  const std::string cut = line({700, 21, 1, 1, 7, 2}) + "    -1" + std::string(24, ' ') + "\n";
  const Error e = error_of(replaced(good, beam, cut));
  EXPECT_EQ(e.code, ErrorCode::kMalformed);
  EXPECT_EQ(e.place.line, 2u + 12 + 1 + 2 + 3 * 699 + 1);
}

}  // namespace
}  // namespace meshgraft
