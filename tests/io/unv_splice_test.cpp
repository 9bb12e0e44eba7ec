// Base + graft as text: what is not named in the graft keeps its bytes.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "io/grafts.hpp"
#include "io/unv_samples.hpp"

namespace meshgraft {
namespace {

using namespace samples;
using Names = std::vector<std::int64_t>;

std::string spliced(const Model& base, std::span<const Model> parts, const Merged& merged, Report& report) {
  const auto text = unv_text(base, parts, merged, report);
  EXPECT_TRUE(text) << (text ? "" : to_string(text.error()));
  return text ? *text : std::string();
}

TEST(UnvSplice, NothingChanged) {
  const std::string text = dataset("151", "ship\n\n\n") + mesh() + "a comment\n" + dataset("2414", line({1}));
  const Model base = read(text);
  Report report;
  EXPECT_EQ(spliced(base, {}, nothing(base), report), text);
  EXPECT_EQ(report.untouched.bytes, text.size());
  ASSERT_EQ(report.datasets.size(), 2u);
  EXPECT_EQ(report.datasets[1].number, "2414");
  EXPECT_EQ(report.datasets[1].fate, "kept");
  EXPECT_EQ(report.datasets[1].line, 48u);
}

/// Face 4 is cut in two at a new node 7 on the edge 5-6; node 3 goes, and face 3 with it.
Merged small_graft(const Model& base) {
  Merged merged = nothing(base);
  Graft& g = merged.graft;
  g.removed_nodes[0] = {NodeId(2u)};
  g.removed_elements[0] = {ElementId(2u), ElementId(3u)};
  const GroupSetId left = g.group_sets.intern({GroupId(0u)});
  const NodeRef n2{0, NodeId(1u)}, n5{0, NodeId(4u)}, n6{0, NodeId(5u)}, n7{kNew, NodeId(0u)};
  g.new_nodes.push_back({{1.5, 1, 1.0 / 3.0}, n6, GroupSets::kEmpty});
  g.new_elements.push_back({{0, ElementId(3u)}, {n2, n6, n7}, left});
  g.new_elements.push_back({{0, ElementId(3u)}, {n2, n7, n5}, left});
  merged.labels.first_new_node = 7, merged.labels.first_new_element = 6;
  return merged;
}

const std::string kNewNode =
    line({7, 1, 1, 11}) + "   1.5000000000000000D+00   1.0000000000000000D+00   3.3333333333333331D-01\n";
const std::string kNewFaces = line({6, 91, 2, 1, 7, 3}) + line({2, 6, 7}) + line({7, 91, 2, 1, 7, 3}) + line({2, 7, 5});
const std::string kNewGroups = line({1, 0, 0, 0, 0, 0, 0, 4}) + "LEFT\n" + line({8, 1, 0, 0, 8, 2, 0, 0}) +
                               line({8, 6, 0, 0, 8, 7, 0, 0}) + line({2, 0, 0, 0, 0, 0, 0, 2}) + "ENDS\n" +
                               line({7, 6, 0, 0, 8, 5, 0, 0});

std::string without(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos);
  return replaced(text, part, "");
}

TEST(UnvSplice, OnlyWhatTheGraftNamesChanges) {
  const std::string nodes =
      without(kNodes, node(3, "   2.0000000000000000D+00   0.0000000000000000D+00   3.3333333333333331D-01"));
  const std::string elements =
      without(kElements, line({3, 91, 2, 1, 7, 3}) + line({2, 3, 6}) + line({4, 91, 2, 1, 7, 3}) + line({2, 6, 5}));
  const std::string rest = dataset("757", line({1}) + "DOF\n") + "tail\n";
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const Model base = read(replaced(mesh() + rest, "\n", end));
    Report report;
    const std::string expected =
        dataset("2411", nodes + kNewNode) + dataset("2412", elements + kNewFaces) + dataset("2467", kNewGroups) + rest;
    EXPECT_EQ(replaced(spliced(base, {}, small_graft(base), report), end, "\n"), expected);
    ASSERT_EQ(report.datasets.size(), 1u);
    EXPECT_EQ(report.datasets[0].fate, "kept, stale: may name nodes or elements that were removed");
  }
}

TEST(UnvSplice, ExponentLetterIsThatOfTheBase) {
  const Model base = read(replaced(mesh(), "D+", "E+"));
  Report report;
  EXPECT_NE(spliced(base, {}, small_graft(base), report).find("   1.5000000000000000E+00"), std::string::npos);
}

TEST(UnvSplice, UnchangedGroupsKeepOddSpacing) {
  const std::string odd = line({9, 0, 0, 0, 0, 0, 0, 2}) + "ODD  \n" + line({8, 1, 0, 0}) + line({7, 99, 0, 0});
  const Model base = read(mesh(dataset("2467", odd + kGroups)));
  Merged merged = small_graft(base);
  merged.graft.new_elements.clear();
  Report report;
  const std::string text = spliced(base, {}, merged, report);
  EXPECT_NE(text.find(odd), std::string::npos);
}

TEST(UnvSplice, LinesOfAGroupOfWhichNothingGoesStayAsTheyAre) {
  const auto strip = [](const std::string& members, std::int64_t count) {
    return line({5, 0, 0, 0, 0, 0, 0, count}) + "STRIP\n" + members;
  };
  const std::string first = line({8, 1, 0, 0, 8, 2, 0, 0}), second = line({7, 3, 0, 0, 8, 3, 0, 0}),
                    third = line({7, 5, 0, 0, 7, 4, 0, 0}), rest = line({8, 4, 0, 0});
  const Model base = read(mesh(dataset("2467", strip(first + second + third + rest, 7) + kGroups)));
  Merged merged = nothing(base);
  merged.graft.removed_elements[0] = {ElementId(2u), ElementId(3u)};  // 3 and 4
  merged.graft.new_elements.push_back(
      {{0, ElementId(3u)}, {NodeRef{0, NodeId(1u)}, NodeRef{0, NodeId(5u)}, NodeRef{0, NodeId(4u)}}, {}});
  merged.graft.new_elements.back().groups = merged.graft.group_sets.intern({GroupId(0u)});
  merged.labels.first_new_node = 7, merged.labels.first_new_element = 6;
  Report report;
  EXPECT_NE(spliced(base, {}, merged, report).find(strip(first + third + line({7, 3, 0, 0, 8, 6, 0, 0}), 6)),
            std::string::npos);
}

/// So many lines that they are looked through in blocks.
TEST(UnvSplice, LinesOfALargeGroupKeepTheirOrder) {
  constexpr std::int64_t kNodesInAll = 50'001;
  const std::set<std::int64_t> removed{6, 32'767, 32'770, 50'001};
  std::string nodes, lines, lines_left;
  for (std::int64_t n = 1; n <= kNodesInAll; n += 2) {
    const bool is_last = n == kNodesInAll;
    for (std::int64_t k = n; k <= (is_last ? n : n + 1); ++k)
      nodes += node(k, "   0.0000000000000000D+00   0.0000000000000000D+00   0.0000000000000000D+00");
    const std::string members = is_last ? line({7, n, 0, 0}) : line({7, n, 0, 0, 7, n + 1, 0, 0});
    lines += members;
    if (!removed.contains(n) && !removed.contains(n + 1)) lines_left += members;
  }
  const auto group = [](const std::string& members, std::int64_t count) {
    return line({5, 0, 0, 0, 0, 0, 0, count}) + "ALL\n" + members;
  };
  const Model base = read(dataset("2411", nodes) + dataset("2467", group(lines, kNodesInAll)));
  Merged merged = nothing(base);
  for (const std::int64_t label : removed)
    merged.graft.removed_nodes[0].emplace_back(static_cast<std::size_t>(label - 1));
  Report report;
  const std::string left = lines_left + line({7, 5, 0, 0, 7, 32'768, 0, 0}) + line({7, 32'769, 0, 0});
  EXPECT_NE(spliced(base, {}, merged, report).find(group(left, kNodesInAll - 4)), std::string::npos);
}

TEST(UnvSplice, NewRecordsGoBeforeAMissingDelimiterAndLineEnd) {
  std::string text = dataset("2411", kNodes) + dataset("2467", kGroups) + opening("2412") + kElements;
  text.pop_back();
  const Model base = read(text, {.unclosed = true});
  Report report;
  const auto model = read_unv_text(spliced(base, {}, small_graft(base), report), "out");
  ASSERT_TRUE(model);
  EXPECT_EQ(model->element_label, (Names{1, 2, 5, 6, 7}));
  EXPECT_TRUE(model->warnings.empty());  // the delimiter is no longer missing
}

/// A part with labels that clash, its beam oriented by its node 3, a group LEFT and one of its own.
std::string part_text(const std::string& nodes_number, const std::string& elements_number,
                      const std::string& groups_number) {
  std::string nodes;
  for (int k = 1; k <= 3; ++k)
    nodes +=
        node(k, "   " + std::to_string(k) + ".0000000000000000E+00   5.0000000000000000E-01  -1.2500000000000000E-01");
  std::string elements, groups;
  if (elements_number == "2412")
    elements = line({1, 91, 8, 9, 3, 3}) + line({1, 2, 3}) + line({2, 21, 8, 9, 3, 2}) + line({3, 4, 5}) + line({1, 2});
  else
    elements = line({1, 91, 0, 8, 0, 9, 3, 3}) + line({1, 2, 3}) + line({2, 21, 0, 8, 0, 9, 3, 2}) +
               line({3, 4, 5, 1, 1}) + line({1, 2});
  if (groups_number == "2467")
    groups = line({1, 0, 0, 0, 0, 0, 0, 2}) + "LEFT\n" + line({8, 1, 0, 0, 12, 4, 0, 0}) +
             line({2, 0, 0, 0, 0, 0, 0, 1}) + "FIN\n" + line({7, 2, 0, 0});
  else
    groups =
        line({1, 0, 0, 0, 0, 2}) + "LEFT\n" + line({8, 1, 12, 4}) + line({2, 0, 0, 0, 0, 1}) + "FIN\n" + line({7, 2});
  return dataset(nodes_number, nodes) + dataset(elements_number, elements) + dataset(groups_number, groups);
}

TEST(UnvSplice, PartsOfOtherDatasetNumbersAndLineEndsTakeTheFormOfTheBase) {
  const Model base = read(mesh());
  std::string nodes;
  for (int k = 1; k <= 3; ++k)
    nodes += node(
        100 + k, "   " + std::to_string(k) + ".0000000000000000E+00   5.0000000000000000E-01  -1.2500000000000000E-01");
  const std::string elements = line({101, 91, 8, 9, 3, 3}) + line({101, 102, 103}) + line({102, 21, 8, 9, 3, 2}) +
                               line({103, 4, 5}) + line({101, 102});
  const std::string groups = replaced(kGroups, line({1, 0, 0, 0, 0, 0, 0, 2}), line({1, 0, 0, 0, 0, 0, 0, 4}));
  const std::string left = line({8, 1, 0, 0, 8, 2, 0, 0});
  const std::string expected = dataset("2411", kNodes + nodes) + dataset("2412", kElements + elements) +
                               dataset("2467", replaced(groups, left, left + line({8, 101, 0, 0, 12, 4, 0, 0})) +
                                                   line({3, 0, 0, 0, 0, 0, 0, 1}) + "FIN\n" + line({7, 102, 0, 0}));
  for (const char* end : {"\n", "\r\n"}) {
    for (const bool old : {false, true}) {
      const Model part =
          read(replaced(old ? part_text("781", "780", "752") : part_text("2411", "2412", "2467"), "\n", end));
      Merged merged = nothing(base, {&part, 1});
      shift_all(merged, 1, part, 100);
      Report report;
      EXPECT_EQ(spliced(base, {&part, 1}, merged, report), expected) << old;
      EXPECT_EQ(report.untouched.bytes, mesh().size() - 81 - 5) << "header and name of LEFT are written anew";
    }
  }
}

TEST(UnvSplice, LabelsThatDoNotClashKeepTheBytesOfThePart) {
  const Model base = read(mesh());
  const std::string odd = "        51         1         1         9\n 1.5D0 2.5D0 0.0D0\n";
  const Model part = read(dataset("2411", odd));
  Report report;
  EXPECT_NE(spliced(base, {&part, 1}, nothing(base, {&part, 1}), report).find(kNodes + odd), std::string::npos);
}

TEST(UnvSplice, MovedAndReplacedNodesOfParts) {
  const Model base = read(mesh());
  const Model part = read(part_text("2411", "2412", "2467"));
  Merged merged = nothing(base, {&part, 1});
  shift_all(merged, 1, part, 100);
  merged.graft.moved_nodes.push_back({{1, NodeId(0u)}, {0.1, 0.2, 0.3}});
  merged.graft.removed_nodes[1] = {NodeId(1u)};
  merged.graft.replaced_nodes.push_back({{1, NodeId(1u)}, {0, NodeId(4u)}});
  const GroupSetId fin = merged.graft.group_sets.intern({GroupId(2u)});
  merged.graft.joined_nodes.push_back({{0, NodeId(4u)}, fin});
  Report report;
  const auto model = read_unv_text(spliced(base, {&part, 1}, merged, report), "out");
  ASSERT_TRUE(model);
  EXPECT_EQ(model->node_label, (Names{1, 2, 3, 4, 5, 6, 101, 103}));
  EXPECT_EQ(model->position[6], (Vec3{0.1, 0.2, 0.3}));
  EXPECT_EQ(model->nodes_of(ElementId(5u))[1], NodeId(4u));
  EXPECT_EQ(model->nodes_of(ElementId(6u))[1], NodeId(4u));
  EXPECT_EQ(model->groups[2].name, "FIN");
  EXPECT_EQ(nodes_in(*model, 2), (Names{5}));
}

TEST(UnvSplice, BaseElementsFollowAReplacedNode) {
  const Model base = read(mesh());
  Merged merged = nothing(base);
  merged.graft.removed_nodes[0] = {NodeId(5u)};
  merged.graft.replaced_nodes.push_back({{0, NodeId(5u)}, {0, NodeId(3u)}});
  Report report;
  const std::string text = spliced(base, {}, merged, report);
  EXPECT_NE(text.find(line({3, 91, 2, 1, 7, 3}) + line({2, 3, 4})), std::string::npos);
  EXPECT_NE(text.find(line({4, 91, 2, 1, 7, 3}) + line({2, 4, 5})), std::string::npos);
}

TEST(UnvSplice, NewBeamsCopyTheBeamRecordOfTheirParent) {
  const Model base = read(replaced(mesh(), line({0, 1, 1}), line({6, 2, 3})));
  Merged merged = nothing(base);
  merged.graft.removed_elements[0] = {ElementId(4u)};
  merged.graft.new_elements.push_back(
      {{0, ElementId(4u)}, {NodeRef{0, NodeId(1u)}, NodeRef{0, NodeId(0u)}, {}}, {GroupSets::kEmpty}});
  Report report;
  EXPECT_NE(spliced(base, {}, merged, report).find(line({6, 21, 3, 1, 8, 2}) + line({6, 2, 3}) + line({2, 1})),
            std::string::npos);
}

TEST(UnvSplice, BaseWithoutGroupsGetsADatasetAfterItsElements) {
  const Model base = read(mesh("") + dataset("2414", line({1})));
  const Model part = read(part_text("2411", "2412", "2467"));
  Merged merged = nothing(base, {&part, 1});
  shift_all(merged, 1, part, 100);
  Report report;
  const std::string text = spliced(base, {&part, 1}, merged, report);
  const auto model = read_unv_text(text, "out");
  ASSERT_TRUE(model);
  EXPECT_EQ(model->groups.size(), 2u);
  EXPECT_TRUE(model->warnings.empty());
  EXPECT_LT(text.find("  2412\n"), text.find("  2467\n"));
  EXPECT_LT(text.find("  2467\n"), text.find("  2414\n"));
}

TEST(UnvSplice, Dataset15IsNotGivenMoreDigitsThanItHolds) {
  const Model base =
      read(dataset("15", "         1         0         0         8  1.00000E+00 -2.50000E+00  3.00000E-01\n"));
  Merged merged = nothing(base);
  merged.graft.new_nodes.push_back({{1.0 / 3.0, 0, 0}, {0, NodeId(0u)}, GroupSets::kEmpty});
  Report report;
  const auto model = read_unv_text(spliced(base, {}, merged, report), "out");
  ASSERT_TRUE(model);
  ASSERT_EQ(model->n_nodes(), 2u);
  EXPECT_EQ(model->position[1].x, 1.0 / 3.0);
}

TEST(UnvSplice, DanglingEntryMustNotNameSomethingOfAPart) {
  const Model base =
      read(mesh(dataset("2467", line({1, 0, 0, 0, 0, 0, 0, 2}) + "OLD\n" + line({7, 1, 0, 0, 7, 51, 0, 0}))));
  const Model part = read(dataset("2411", node(51, "   1.0D+00   2.0D+00   3.0D+00")));
  Report report;
  const auto model = read_unv_text(spliced(base, {&part, 1}, nothing(base, {&part, 1}), report), "out");
  ASSERT_TRUE(model);
  EXPECT_EQ(nodes_in(*model, 0), (Names{1}));
  EXPECT_FALSE(report.warnings.empty());
}

TEST(UnvSplice, DatasetsOfPartsAreCopiedOrPutAside) {
  const Model base = read(dataset("151", "base\n") + mesh());
  const std::string own = dataset("757", line({1}) + "DOF\n" + line({51, 1}));
  const Model part = read(dataset("151", "part\n") + dataset("2411", node(51, "   1.0D+00   2.0D+00   3.0D+00")) + own);
  Merged merged = nothing(base, {&part, 1});
  Report report;
  EXPECT_TRUE(spliced(base, {&part, 1}, merged, report).ends_with("    -1\n" + own));
  const auto fate = [&](std::size_t k) { return report.datasets[k].fate; };
  EXPECT_EQ(fate(0), "kept");
  EXPECT_EQ(fate(1), "same as base");
  EXPECT_EQ(fate(2), "kept");

  shift_all(merged, 1, part, 100);
  const auto path =
      (std::filesystem::temp_directory_path() / ("meshgraft-side-file-" + std::to_string(::getpid()) + ".unv"))
          .string();
  Report shifted;
  ASSERT_TRUE(write_unv(base, {&part, 1}, merged, path, shifted));
  EXPECT_EQ(shifted.datasets[2].fate, "side file");
  const auto side = read_unv(path + ".carry");
  ASSERT_TRUE(side) << to_string(side.error());
  const auto side_text = unv_text(*side);
  EXPECT_TRUE(side_text && side_text->ends_with(own)) << *side_text;
  ASSERT_TRUE(write_unv(base, {}, nothing(base), path, shifted));
  EXPECT_FALSE(std::filesystem::exists(path + ".carry")) << "it belonged to the output before";

  std::ofstream(path + ".carry") << "mine\n";
  ASSERT_TRUE(write_unv(base, {}, nothing(base), path, shifted));
  EXPECT_TRUE(std::filesystem::exists(path + ".carry")) << "not written by us";
  const auto refused = write_unv(base, {&part, 1}, merged, path, shifted);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kCannotWrite);
  EXPECT_EQ(std::filesystem::file_size(path + ".carry"), 5u);
  std::filesystem::remove(path + ".carry");
  std::filesystem::remove(path);
}

TEST(UnvSplice, ModelsInMemoryCanBeMergedToo) {
  ModelBuilder b;
  b.add_face(b.add_node({0, 0, 0}), b.add_node({1, 0, 0}), b.add_node({0, 1, 0}));
  const Model base = b.build();
  Merged merged = nothing(base);
  merged.graft.new_nodes.push_back({{1.0 / 3.0, 0, 0}, {0, NodeId(0u)}, GroupSets::kEmpty});
  Report report;
  const auto model = read_unv_text(spliced(base, {}, merged, report), "out");
  ASSERT_TRUE(model);
  EXPECT_EQ(model->n_nodes(), 4u);
}

TEST(UnvSplice, LabelsOfElevenDigitsAreRefused) {
  const Model base = read(mesh());
  Merged merged = small_graft(base);
  merged.labels.first_new_node = 10'000'000'000;
  Report report;
  const auto text = unv_text(base, {}, merged, report);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, ErrorCode::kLabelOverflow);
}

}  // namespace
}  // namespace meshgraft
