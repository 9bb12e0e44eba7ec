// Merges that succeed: what is printed where, and what is written.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.hpp"
#include "support/scenes.hpp"

namespace meshgraft::cli_tests {
namespace {

std::string label_of_line(const std::string& out, const std::string& label) {
  const std::size_t at = ("\n" + out).find("\n" + label + " ");
  return at == std::string::npos ? "" : out.substr(at, out.find('\n', at) - at);
}

TEST(Merge, SummarisesOnStdoutAndIsSilentOnStderr) {
  const Folder folder;
  folder.put_plates();
  const Outcome outcome = folder.run({"merge", "base.unv", "part.unv", "-o", "out.unv"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const char* label :
       {"parts met", "zone", "quality", "surface", "groups", "labels", "moved", "untouched", "warnings"})
    EXPECT_NE(label_of_line(outcome.out, label), "") << label << "\n" << outcome.out;
  EXPECT_NE(label_of_line(outcome.out, "parts met").find("1 curve"), std::string::npos) << outcome.out;
  EXPECT_NE(label_of_line(outcome.out, "written").find("out.unv"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("timings"), std::string::npos);
  EXPECT_EQ(folder.run({"check", "-q", "out.unv"}).code, 0);
}

TEST(Merge, SaysOfAPartThatLiesOnTheBaseHowLargeTheAreaIs) {
  const Folder folder;
  folder.put_plates();
  folder.put("doubler.unv", scenes::plate({0.2, 0.2, 0}, {0.5, 0, 0}, {0, 0.5, 0}, 0.1, "DOUBLER"));
  folder.put("same.unv", folder.text("base.unv"));
  const Outcome all = folder.run({"merge", "base.unv", "same.unv", "-o", "out.unv"});
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_NE(all.out.find("same.unv: lies on others, area 1\n"), std::string::npos) << all.out;
  EXPECT_EQ(all.out.find("meets nothing"), std::string::npos);
  const Outcome border = folder.run({"merge", "base.unv", "doubler.unv", "-o", "out.unv"});
  EXPECT_NE(border.out.find("length 2; lies on others, area 0.25\n"), std::string::npos) << border.out;
}

TEST(Merge, OfTwoLayersIsDuplicateForCheckAndNothingElse) {
  const Folder folder;
  folder.put_plates();
  folder.put("doubler.unv", scenes::plate({0.2, 0.2, 0}, {0.5, 0, 0}, {0, 0.5, 0}, 0.1, "DOUBLER"));
  ASSERT_EQ(folder.run({"merge", "base.unv", "doubler.unv", "--overlap", "project", "-q", "-o", "out.unv"}).code, 0);
  const Outcome check = folder.run({"check", "out.unv"});
  EXPECT_EQ(check.code, 1);
  EXPECT_EQ(label_of_line(check.out, "duplicate").find(" 0"), std::string::npos) << check.out;
  EXPECT_NE(label_of_line(check.out, "intersecting").find(" 0"), std::string::npos) << check.out;
}

TEST(Merge, SaysNothingWhenQuiet) {
  const Folder folder;
  folder.put_plates();
  const Outcome outcome = folder.run({"merge", "base.unv", "part.unv", "-q", "-o", "out.unv"}, Stderr::kTerminal);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
}

TEST(Merge, TellsTimesAndChangedGroupsWhenVerbose) {
  const Folder folder;
  folder.put_plates();
  const Outcome outcome = folder.run({"merge", "base.unv", "part.unv", "-v", "-o", "out.unv"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(label_of_line(outcome.out, "timings"), "") << outcome.out;
  EXPECT_NE(label_of_line(outcome.out, "ledger").find("WALL (faces)"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("RIB (faces)"), std::string::npos) << outcome.out;
}

TEST(Progress, IsShownOnATerminalAndWipedAway) {
  const Folder folder;
  folder.put_plates();
  const Outcome outcome = folder.run({"merge", "base.unv", "part.unv", "-o", "out.unv"}, Stderr::kTerminal);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("reading base.unv"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("writing out.unv"), std::string::npos) << outcome.err;
  ASSERT_FALSE(outcome.err.empty());
  EXPECT_EQ(outcome.err.back(), '\r');
  const std::size_t last = outcome.err.rfind('\r', outcome.err.size() - 2);
  EXPECT_EQ(outcome.err.find_first_not_of(' ', last + 1), outcome.err.size() - 1) << outcome.err;
}

TEST(Merge, GivesTheSameBytesForAnyNumberOfThreads) {
  const Folder folder;
  folder.put_plates();
  ASSERT_EQ(folder.run({"merge", "base.unv", "part.unv", "-o", "one.unv", "--threads", "1"}).code, 0);
  ASSERT_EQ(folder.run({"merge", "base.unv", "part.unv", "-o", "two.unv", "--threads", "2"}).code, 0);
  ASSERT_EQ(folder.run({"merge", "base.unv", "part.unv", "-o", "all.unv", "--report", "r.json"}).code, 0);
  EXPECT_EQ(folder.text("one.unv"), folder.text("two.unv"));
  EXPECT_EQ(folder.text("one.unv"), folder.text("all.unv"));
}

TEST(Merge, ReplacesAnOldOutputAndLeavesNothingElse) {
  const Folder folder;
  folder.put_plates();
  folder.put("out.unv", "old\n");
  ASSERT_EQ(folder.run({"merge", "base.unv", "part.unv", "-o", "out.unv", "--report", "r.json"}).code, 0);
  EXPECT_TRUE(folder.text("out.unv").starts_with("    -1\n"));
  EXPECT_EQ(folder.files(), (std::vector<std::string>{"base.unv", "far.unv", "out.unv", "part.unv", "r.json"}));
}

TEST(Merge, KeepsALinkAsTheNameOfItsOutput) {
  const Folder folder;
  folder.put_plates();
  folder.put("real.unv", "old\n");
  std::filesystem::create_symlink("real.unv", folder.path() / "link.unv");
  ASSERT_EQ(folder.run({"merge", "base.unv", "part.unv", "-o", "link.unv", "--report", "r.json"}).code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.unv"));
  EXPECT_TRUE(folder.text("real.unv").starts_with("    -1\n"));
}

TEST(Merge, FollowsALinkToAFileThatIsNotThereYet) {
  const Folder folder;
  folder.put_plates();
  std::filesystem::create_symlink("new.unv", folder.path() / "link.unv");
  ASSERT_EQ(folder.run({"merge", "base.unv", "part.unv", "-o", "link.unv"}).code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.unv"));
  EXPECT_TRUE(folder.text("new.unv").starts_with("    -1\n"));
  std::filesystem::create_symlink("other.unv", folder.path() / "name.unv");
  EXPECT_EQ(folder.run({"merge", "base.unv", "part.unv", "-o", "name.unv", "--report", "other.unv"}).code, 2);
  std::filesystem::create_symlink("circle.unv", folder.path() / "circle.unv");
  EXPECT_EQ(folder.run({"merge", "base.unv", "part.unv", "-o", "circle.unv"}).code, 5);
}

TEST(Merge, TakesPathsWithBlanksAndForeignLetters) {
  const Folder folder;
  folder.put_plates();
  const std::string strange = "Träger für Löcher \xE6\xA2\x81.unv";
  std::filesystem::rename(folder / "part.unv", folder / strange);
  const Outcome outcome = folder.run({"merge", "base.unv", strange, "-o", "das Ergebnis.unv", "--report", "r é.json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(folder.has("das Ergebnis.unv"));
  const auto report = nlohmann::json::parse(folder.text("r é.json"));
  EXPECT_EQ(report["inputs"][1]["path"], strange);
}

TEST(Merge, TakesPathsThatAreNotUtf8) {
  const Folder folder;
  folder.put_plates();
  const std::string latin = "Tr\xE4ger.unv";
  std::filesystem::rename(folder / "part.unv", folder / latin);
  EXPECT_EQ(folder.run({"merge", "base.unv", latin, "-o", "out.unv", "--report", "r.json"}).code, 0);
  EXPECT_TRUE(nlohmann::json::accept(folder.text("r.json")));
}

TEST(Merge, TakesANameWithADashAfterTwoDashes) {
  const Folder folder;
  folder.put_plates();
  std::filesystem::rename(folder / "part.unv", folder / "-part.unv");
  EXPECT_EQ(folder.run({"merge", "-o", "out.unv", "--", "base.unv", "-part.unv"}).code, 0);
}

TEST(Example, GraftsAPart) {
  const Folder folder;
  folder.put_plates();
  const Outcome outcome = folder.run_program(MESHGRAFT_EXAMPLE, {"base.unv", "part.unv", "out.unv"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("new triangles, worst Q 0."), std::string::npos) << outcome.out;
  EXPECT_EQ(folder.run({"check", "-q", "out.unv"}).code, 0);
}

}  // namespace
}  // namespace meshgraft::cli_tests
