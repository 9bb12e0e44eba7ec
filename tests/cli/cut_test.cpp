// The command `cut`: what is printed where, what is written, and what is refused.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "meshgraft/check.hpp"
#include "meshgraft/unv.hpp"
#include "program.hpp"

namespace meshgraft::cli_tests {
namespace {

double area(const Folder& folder, const std::string& name) { return check(read_unv(folder / name).value()).area; }

TEST(Cut, WritesWhatIsLeftAndSummarises) {
  const Folder folder;
  folder.put_plates();
  const Outcome outcome =
      folder.run({"cut", "base.unv", "--box", "0.61,-1,-1,3,3,3", "--drop", "inside", "-o", "out.unv"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("\ndropped "), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.rfind("cut ", 0), 0u) << outcome.out;
  EXPECT_EQ(folder.run({"check", "-q", "out.unv"}).code, 0);
  EXPECT_NEAR(area(folder, "out.unv"), 0.61 * area(folder, "base.unv"), 1e-6);
  EXPECT_EQ(folder.files(), (std::vector<std::string>{"base.unv", "far.unv", "out.unv", "part.unv"}));
}

TEST(Cut, TakesNegativeNumbersAndTheOtherTools) {
  const Folder folder;
  folder.put_plates();
  for (const std::vector<std::string>& tool : {std::vector<std::string>{"--plane", "-0.1,0.5,0,-1,0.9,0.3"},
                                               {"--plane=0.5,0.5,0,-1,0,0"},
                                               {"--cylinder", "0.5,0.5,-4,0,0,-1,0.21"},
                                               {"part.unv"}}) {
    std::vector<std::string> arguments{"cut", "base.unv", "--drop", "outside", "-o", "out.unv"};
    arguments.insert(arguments.end(), tool.begin(), tool.end());
    const Outcome outcome = folder.run(arguments);
    // part.unv is a rib in the middle of the plate: it does not cut through.
    EXPECT_EQ(outcome.code, tool[0] == "part.unv" ? 3 : 0) << tool[0] << "\n" << outcome.err;
    if (tool[0] == "part.unv") {
      EXPECT_NE(outcome.err.find("[not-separated]"), std::string::npos) << outcome.err;
    }
  }
}

TEST(Cut, ReportsWhatWentAndBothInputs) {
  const Folder folder;
  folder.put_plates();
  ASSERT_EQ(folder
                .run({"cut", "base.unv", "--plane", "0.5,0,0,1,0,0", "--drop", "outside", "-o", "out.unv", "--report",
                      "r.json", "-q"})
                .code,
            0);
  const auto report = nlohmann::json::parse(folder.text("r.json"));
  ASSERT_EQ(report["inputs"].size(), 1u);
  EXPECT_EQ(report["inputs"][0]["sha256"].get<std::string>().size(), 64u);
  ASSERT_EQ(report["dropped"].size(), 1u);
  EXPECT_EQ(report["dropped"][0]["cause"], "cut");
  EXPECT_EQ(report["junction"][0]["kind"], "cut");
}

TEST(Cut, RefusesWhatMakesNoSense) {
  const Folder folder;
  folder.put_plates();
  const std::vector<std::pair<std::vector<std::string>, std::string>> refused{
      {{"--drop", "inside"}, "what cuts"},
      {{"--box", "0,0,0,1,1,1"}, "--drop"},
      {{"--box", "0,0,0,1,1", "--drop", "inside"}, "--box"},
      {{"--box", "0,0,0,1,1,x", "--drop", "inside"}, "--box"},
      {{"--box", "1,1,1,0,0,0", "--drop", "inside"}, "no volume"},
      {{"--box", "0.3000000001,0.3,-1,0.3000000002,0.6,1", "--drop", "inside"}, "box 0.3000000001,0.3,-1"},
      {{"--cylinder", "0.5,0.5,0,0,0,1,0", "--drop", "inside"}, "no radius"},
      {{"--cylinder", "0.5,0.5,0,0,0,1,-0.1", "--drop", "inside"}, "no radius"},
      {{"--cylinder", "0.5,0.5,0,0,0,1,nan", "--drop", "inside"}, "not a list of numbers"},
      {{"--cylinder", "0.5,0.5,0,0,0,1,1e-300", "--drop", "inside"}, "2e-300 across"},
      {{"--cylinder", "0.5,0.5,0,0,0,1,0.2", "--drop", "inside", "--size", "1e-9"}, "edge length of 1e-09"},
      {{"--plane", "0,0,0,0,0,0", "--drop", "inside"}, "no direction"},
      {{"--plane", "0.5,0,0,1,0,0", "--drop", "BASE"}, "no group 'BASE'"},  // as BASE is called in the help
      {{"part.unv", "--plane", "0,0,0,0,0,1", "--drop", "inside"}, "more than one tool"},
      {{"--plane", "0.5,0,0,1,0,0", "--drop", "PLTAE"}, "group"}};
  for (const auto& [options, expected] : refused) {
    std::vector<std::string> arguments{"cut", "base.unv", "-o", "out.unv"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = folder.run(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(expected), std::string::npos) << outcome.err;
    EXPECT_FALSE(folder.has("out.unv"));
  }
}

TEST(Cut, SuggestsTheNearestGroup) {
  const Folder folder;
  folder.put_plates();
  const Outcome outcome = folder.run({"cut", "base.unv", "--plane", "0.5,0,0,1,0,0", "--drop", "WAL", "-o", "out.unv"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("did you mean 'WALL'?"), std::string::npos) << outcome.err;
}

TEST(Cut, AToolThatMissesIsExitCode4) {
  const Folder folder;
  folder.put_plates();
  const Outcome outcome = folder.run({"cut", "base.unv", "--box", "7,7,7,8,8,8", "--drop", "inside", "-o", "out.unv"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("[parts-apart]"), std::string::npos) << outcome.err;
  EXPECT_FALSE(folder.has("out.unv"));
}

TEST(Cut, ADamagedToolIsAnErrorOfItsLine) {
  const Folder folder;
  folder.put_plates();
  folder.put("tool.unv", folder.text("part.unv").substr(0, 700));
  const Outcome outcome = folder.run({"cut", "base.unv", "tool.unv", "--drop", "inside", "-o", "out.unv"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("tool.unv"), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.run({"cut", "base.unv", "tool.unv", "--drop", "inside", "-o", "tool.unv"}).code, 2);
}

}  // namespace
}  // namespace meshgraft::cli_tests
