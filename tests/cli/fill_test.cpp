// The command `fill`: what is listed, what is written, and what is refused.
#include "meshgraft/fill.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "meshgraft/check.hpp"
#include "meshgraft/unv.hpp"
#include "program.hpp"

namespace meshgraft::cli_tests {
namespace {

double area(const Folder& folder, const std::string& name) { return check(read_unv(folder / name).value()).area; }

/// holed.unv: the plate base.unv with a square hole.
void put_holed(const Folder& folder) {
  folder.put_plates();
  ASSERT_EQ(
      folder.run({"cut", "base.unv", "--box", "0.31,0.33,-1,0.62,0.64,1", "--drop", "inside", "-o", "holed.unv"}).code,
      0);
}

TEST(Fill, ListsContoursWithTheirNumbers) {
  const Folder folder;
  put_holed(folder);
  const Outcome outcome = folder.run({"fill", "holed.unv", "--list"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out.rfind("contour 1", 0), 0u) << outcome.out;
  EXPECT_NE(outcome.out.find("outer border"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\ncontour 2"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("hole; "), std::string::npos) << outcome.out;
}

TEST(Fill, ListsNothingBesideOptionsThatItWouldIgnore) {
  const Folder folder;
  put_holed(folder);
  const std::vector<std::vector<std::string>> ignored{
      {"-o", "out.unv"},       {"--report", "r.json"}, {"--contour", "2"},    {"--size", "0.1"},
      {"--blend", "tangency"}, {"--allow-poor"},       {"--method", "paper"}, {"--min-quality", "0.4"}};
  for (const auto& option : ignored) {
    std::vector<std::string> arguments{"fill", "holed.unv", "--list"};
    arguments.insert(arguments.end(), option.begin(), option.end());
    const Outcome outcome = folder.run(arguments);
    EXPECT_EQ(outcome.code, 2) << option.front();
    EXPECT_EQ(outcome.out, "") << option.front();
    EXPECT_NE(outcome.err.find(option.front() == "-o" ? "--output" : option.front()), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(folder.run({"fill", "holed.unv", "--list", "-v", "--threads", "2"}).code, 0);
}

/// Elements on the same nodes, all around the hole or at one of its sides, are named: they hide it.
TEST(Fill, NamesDoubledElementsThatHideAHole) {
  const Folder folder;
  put_holed(folder);
  const Model holed = read_unv(folder / "holed.unv").value();
  const auto with_doubles = [&](std::size_t n) {
    ModelBuilder builder;
    for (std::size_t k = 0; k < holed.n_nodes(); ++k) builder.add_node(holed.position[k], holed.node_label[k]);
    const auto add = [&](ElementId e, std::int64_t label) {
      builder.add_element(holed.attributes_of(e), holed.nodes_of(e), label);
    };
    for (std::size_t k = 0; k < holed.n_elements(); ++k) add(ElementId(k), holed.element_label[k]);
    std::size_t made = 0;
    const auto on_rim = contours_of(holed).back().nodes;
    for (std::size_t k = 0; k < holed.n_elements() && made < n; ++k) {
      const auto at_rim = [&](NodeId node) { return std::ranges::find(on_rim, node) != on_rim.end(); };
      const auto nodes = holed.nodes_of(ElementId(k));
      if (std::count_if(nodes.begin(), nodes.end(), at_rim) < 2) continue;
      add(ElementId(k), 100'000 + static_cast<std::int64_t>(k));
      ++made;
    }
    return builder.build();
  };
  folder.put("one.unv", with_doubles(1));
  folder.put("all.unv", with_doubles(1000));
  for (const char* file : {"one.unv", "all.unv"})
    for (const bool list : {true, false}) {
      const Outcome outcome = list ? folder.run({"fill", file, "--list"}) : folder.run({"fill", file, "-o", "out.unv"});
      EXPECT_EQ(outcome.code, list ? 0 : 2) << file << outcome.err;
      EXPECT_NE(outcome.err.find("on the same nodes"), std::string::npos) << outcome.err;
      EXPECT_NE(outcome.err.find(" 100"), std::string::npos) << outcome.err;
      EXPECT_EQ(outcome.out.find("no free edges"), std::string::npos) << outcome.out;
    }
  EXPECT_FALSE(folder.has("out.unv"));
}

TEST(Fill, ListsFreeEdgesThatCloseNoContourToo) {
  const Folder folder;
  folder.put_plates();
  ASSERT_EQ(folder.run({"cut", "part.unv", "--box", "-1,-1,-1,2,2,0", "--drop", "inside", "-o", "rib.unv"}).code, 0);
  ASSERT_EQ(folder.run({"merge", "base.unv", "rib.unv", "-o", "merged.unv"}).code, 0);
  const Outcome outcome = folder.run({"fill", "merged.unv", "--list"});
  EXPECT_NE(outcome.out.find("no contour"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("no free edges"), std::string::npos) << outcome.out;
}

TEST(Fill, WritesTheFilledMeshAndSummarises) {
  const Folder folder;
  put_holed(folder);
  const Outcome outcome = folder.run({"fill", "holed.unv", "-o", "out.unv", "--report", "r.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("[left-open]"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out.rfind("filled ", 0), 0u) << outcome.out;
  EXPECT_EQ(folder.run({"check", "-q", "out.unv"}).code, 0);
  EXPECT_NEAR(area(folder, "out.unv"), area(folder, "base.unv"), 1e-9);
  const auto report = nlohmann::json::parse(folder.text("r.json"));
  ASSERT_EQ(report["junction"].size(), 1u);
  EXPECT_EQ(report["junction"][0]["kind"], "filled");
  EXPECT_EQ(report["zone"]["faces_removed"], 0);
  EXPECT_GT(report["zone"]["faces_created"], 0);
  EXPECT_GE(report["quality"]["min"], 0.5);
  for (const auto& figures : {report["fidelity"], report["fidelity"]["removed"]})  // there was no surface
    for (const char* field : {"max_distance", "max_distance_relative", "at"})
      EXPECT_TRUE(figures.at(field).is_null()) << field;
  EXPECT_EQ(outcome.out.find("from that of the inputs"), std::string::npos) << outcome.out;

  // Up to the end of the old nodes the text is the same.
  const std::string before = folder.text("holed.unv"), after = folder.text("out.unv");
  const std::size_t end = before.find("\n    -1\n", before.find("\n  2411\n"));
  ASSERT_NE(end, std::string::npos);
  EXPECT_EQ(after.substr(0, end), before.substr(0, end));
}

TEST(Fill, JoinsAnIslandToWhatIsAround) {
  const Folder folder;
  put_holed(folder);
  ASSERT_EQ(
      folder.run({"cut", "base.unv", "--box", "0.42,0.44,-1,0.52,0.53,1", "--drop", "outside", "-o", "island.unv"})
          .code,
      0);
  ASSERT_EQ(folder.run({"merge", "holed.unv", "island.unv", "--allow-apart", "-o", "both.unv"}).code, 4);  // apart
  const Outcome listed = folder.run({"fill", "both.unv", "--list"});
  EXPECT_NE(listed.out.find("within contour 2"), std::string::npos) << listed.out;
  for (const char* contours : {"all", "2+3"}) {
    const Outcome outcome = folder.run({"fill", "both.unv", "--contour", contours, "-o", "out.unv"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("[island]") != std::string::npos, contours == std::string("all")) << outcome.err;
    EXPECT_EQ(folder.run({"check", "-q", "out.unv"}).code, 0);
    EXPECT_NEAR(area(folder, "out.unv"), area(folder, "base.unv"), 1e-9);
  }
  EXPECT_EQ(folder.run({"fill", "both.unv", "--contour", "2", "-o", "alone.unv"}).code, 1);  // over the island
  EXPECT_FALSE(folder.has("alone.unv"));
}

TEST(Fill, RefusesWhatCannotBe) {
  const Folder folder;
  put_holed(folder);
  for (const std::vector<std::string>& extra : {std::vector<std::string>{"--contour", "7"},
                                                {"--contour", "0"},
                                                {"--contour", "x"},
                                                {"--contour", "1+"},
                                                {"--contour", "1+1"},
                                                {"--contour", "1", "--contour", "2+1"},
                                                {"--contour", "1+9"},
                                                {"--contour", ""},
                                                {"--contour", "2", "--contour", ""},
                                                {"--blend", "smooth"},
                                                {"--contour", "all", "--contour", "2"},
                                                {"--size", "-1"}}) {
    std::vector<std::string> arguments{"fill", "holed.unv", "-o", "out.unv"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    const Outcome outcome = folder.run(arguments);
    EXPECT_EQ(outcome.code, 2) << extra[1] << outcome.err;
    EXPECT_FALSE(folder.has("out.unv"));
  }
  EXPECT_EQ(folder.run({"fill", "base.unv", "-o", "out.unv"}).code, 2);  // nothing but its outer border
  EXPECT_EQ(folder.run({"fill", "-o", "out.unv"}).code, 2);
  EXPECT_EQ(folder.run({"fill", "holed.unv"}).code, 2);
  EXPECT_EQ(folder.run({"fill", "none.unv", "-o", "out.unv"}).code, 3);
}

}  // namespace
}  // namespace meshgraft::cli_tests
