// Exit codes 1, 3, 4 and 5: what is said, and that files are as they were.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "program.hpp"

namespace meshgraft::cli_tests {
namespace {

const std::string kOld = "what was there before\n";

/// A failed merge neither makes an output nor changes one that was there.
void expect_no_output(const std::vector<std::string>& arguments, int code, const std::vector<std::string>& says) {
  for (const bool was_there : {false, true}) {
    const Folder folder;
    folder.put_plates();
    folder.put("empty.unv", std::string());
    folder.put("hole.unv", std::string());
    std::filesystem::resize_file(folder / "hole.unv", std::uintmax_t{1} << 32);  // a length without content
    folder.put("prose.unv", "This is not a mesh.\n");
    folder.put("cut.unv", folder.text("base.unv").substr(0, folder.text("base.unv").size() / 2));
    std::filesystem::create_directory(folder.path() / "directory.unv");
    if (was_there) folder.put("out.unv", kOld);
    const std::vector<std::string> before = folder.files();
    const Outcome outcome = folder.run(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    for (const std::string& text : says)
      EXPECT_NE(outcome.err.find(text), std::string::npos) << "'" << text << "' is not in\n" << outcome.err;
    EXPECT_EQ(folder.files(), before);
    if (was_there) {
      EXPECT_EQ(folder.text("out.unv"), kOld);
    }
  }
}

TEST(MissingInput, IsNamed) {
  expect_no_output({"merge", "base.unv", "nowhere.unv", "-o", "out.unv"}, 3, {"nowhere.unv", "[cannot-read]"});
  expect_no_output({"check", "nowhere.unv"}, 3, {"nowhere.unv", "[cannot-read]"});
  expect_no_output({"info", "nowhere.unv"}, 3, {"nowhere.unv", "[cannot-read]"});
  expect_no_output({"convert", "nowhere.unv", "out.unv"}, 3, {"nowhere.unv", "[cannot-read]"});
}

TEST(DirectoryAsInput, IsRefused) {
  expect_no_output({"merge", "directory.unv", "part.unv", "-o", "out.unv"}, 3, {"directory.unv", "[cannot-read]"});
}

TEST(DeviceAsInput, IsRefusedAndNotReadForever) {
  expect_no_output({"info", "/dev/zero"}, 3, {"/dev/zero: error [cannot-read]", "device", "hint"});
  expect_no_output({"merge", "base.unv", "/dev/zero", "-o", "out.unv"}, 3, {"/dev/zero", "[cannot-read]"});
}

TEST(InputWithoutEnd, IsGivenUpWhereMemoryEnds) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "needs more addresses than the limit";
#endif
  const Folder folder;
  const Outcome outcome = folder.run_program(
      "/bin/sh", {"-c", "ulimit -v 1000000; cat /dev/zero | exec \"$0\" info /dev/stdin", MESHGRAFT_PROGRAM});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("/dev/stdin: error [cannot-read]"), std::string::npos) << outcome.err;
}

TEST(MessagesAboutText, HoldNothingThatWouldUpsetATerminal) {
  const Folder folder;
  folder.put_plates();
  std::string text = folder.text("base.unv");
  text.replace(text.find("0.0000000000000000", text.find("\n  2411\n")), 4, "\x1b[2J");
  folder.put("wild.unv", text);
  const Outcome outcome = folder.run({"info", "wild.unv"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos);
  EXPECT_NE(outcome.err.find("?[2J"), std::string::npos) << outcome.err;
}

TEST(PipeOrDeviceAsOutput, IsWrittenInPlace) {
  const Folder folder;
  folder.put_plates();
  const std::vector<std::string> before = folder.files();
  const Outcome merged = folder.run_program(
      "/bin/sh", {"-c", "\"$0\" merge base.unv part.unv -q -o /dev/stdout | cat", MESHGRAFT_PROGRAM});
  EXPECT_EQ(merged.err, "");
  EXPECT_EQ(folder.run({"merge", "base.unv", "part.unv", "-q", "-o", "/dev/null"}).code, 0);
  // With a summary, it would be the end of the mesh.
  const Outcome talking =
      folder.run_program("/bin/sh", {"-c", "\"$0\" merge base.unv part.unv -o /dev/stdout | cat", MESHGRAFT_PROGRAM});
  EXPECT_EQ(talking.out, merged.out);
  const Outcome converted =
      folder.run_program("/bin/sh", {"-c", "\"$0\" convert base.unv /dev/stdout | cat", MESHGRAFT_PROGRAM});
  EXPECT_EQ(converted.out, folder.text("base.unv"));
  const Outcome reported = folder.run_program(
      "/bin/sh",
      {"-c", "\"$0\" merge base.unv part.unv -o /dev/null --report /dev/stdout | tail -c 2", MESHGRAFT_PROGRAM});
  EXPECT_EQ(reported.out, "}\n");
  EXPECT_EQ(folder.files(), before);
  ASSERT_EQ(folder.run({"merge", "base.unv", "part.unv", "-q", "-o", "out.unv"}).code, 0);
  EXPECT_EQ(merged.out, folder.text("out.unv"));
}

TEST(InputBelowAFile, CannotBeRead) {
  expect_no_output({"info", "base.unv/mesh.unv"}, 3, {"base.unv/mesh.unv", "[cannot-read]"});
}

TEST(EmptyInput, IsRefused) {
  expect_no_output({"merge", "base.unv", "empty.unv", "-o", "out.unv"}, 3, {"empty.unv", "[empty-file]"});
  expect_no_output({"merge", "base.unv", "hole.unv", "-o", "out.unv"}, 3, {"hole.unv", "[empty-file]"});
}

TEST(InputOfAnotherFormat, IsRefused) {
  expect_no_output({"convert", "prose.unv", "out.unv"}, 3, {"prose.unv", "[unknown-format]"});
}

TEST(TruncatedInput, IsRefusedWithItsLine) {
  expect_no_output({"merge", "cut.unv", "part.unv", "-o", "out.unv"}, 3, {"cut.unv:", "error ["});
}

TEST(InputWithoutItsLastDelimiter, IsMergedByNoCommandButDescribed) {
  const Folder folder;
  folder.put_plates();
  const std::string text = folder.text("base.unv");
  folder.put("cut.unv", text.substr(0, text.find("    -1\n", text.find("  2412\n"))));
  const std::vector<std::string> before = folder.files();
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"merge", "cut.unv", "part.unv", "-o", "o.unv"},
        {"merge", "part.unv", "cut.unv", "-o", "o.unv"},
        {"cut", "cut.unv", "--plane", "0.5,0,0,1,0,0", "--drop", "inside", "-o", "o.unv"},
        {"fill", "cut.unv", "--contour", "1", "-o", "o.unv"}}) {
    const Outcome outcome = folder.run(arguments);
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_NE(outcome.err.find("error [truncated]"), std::string::npos) << outcome.err;
    EXPECT_EQ(folder.files(), before);
  }
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"info", "cut.unv"}, {"check", "cut.unv"}, {"convert", "cut.unv", "copy.unv"}}) {
    const Outcome outcome = folder.run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("warning [missing-delimiter]"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(folder.text("copy.unv"), folder.text("cut.unv"));
}

TEST(PartThatMeetsNothing, IsNamedWithExitCode4) {
  expect_no_output({"merge", "base.unv", "far.unv", "-o", "out.unv"}, 4, {"far.unv", "[parts-apart]"});
  expect_no_output({"merge", "base.unv", "part.unv", "far.unv", "-o", "out.unv"}, 4, {"far.unv", "[parts-apart]"});
}

TEST(PartThatMeetsNothing, IsAddedUnjoinedIfAllowed) {
  const Folder folder;
  folder.put_plates();
  const Outcome outcome = folder.run({"merge", "base.unv", "far.unv", "-o", "out.unv", "--allow-apart"});
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("warning [parts-apart]"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("meets nothing"), std::string::npos) << outcome.out;
  EXPECT_NE(folder.text("out.unv").find("FAR"), std::string::npos);
}

TEST(BrokenPromise, IsExitCode1AndNothingIsWritten) {
  expect_no_output({"merge", "base.unv", "part.unv", "-o", "out.unv", "--min-quality", "0.9"}, 1,
                   {"error [promise-broken]"});
}

TEST(BrokenPromise, IsInTheReportAllTheSame) {
  const Folder folder;
  folder.put_plates();
  const Outcome outcome =
      folder.run({"merge", "base.unv", "part.unv", "-o", "out.unv", "--min-quality", "0.9", "--report", "report.json"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_FALSE(folder.has("out.unv"));
  EXPECT_NE(folder.text("report.json").find("\"promise-broken\""), std::string::npos);
  EXPECT_NE(outcome.out.find("nothing: "), std::string::npos) << outcome.out;
}

TEST(BrokenPromise, IsWrittenIfAllowedAndKeepsItsExitCode) {
  const Folder folder;
  folder.put_plates();
  const Outcome outcome =
      folder.run({"merge", "base.unv", "part.unv", "-o", "out.unv", "--min-quality", "0.9", "--allow-poor"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("[promise-broken]"), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.run({"check", "-q", "out.unv"}).code, 0);
}

TEST(OutputDirectory, IsCheckedBeforeTheInputsAreRead) {
  expect_no_output({"merge", "nowhere.unv", "part.unv", "-o", "no/such/out.unv"}, 5,
                   {"no/such/out.unv", "[cannot-write]", "'no/such' does not exist"});
  expect_no_output({"convert", "nowhere.unv", "base.unv/out.unv"}, 5, {"[cannot-write]", "not a directory"});
  expect_no_output({"merge", "nowhere.unv", "part.unv", "-o", "directory.unv"}, 5,
                   {"[cannot-write]", "is a directory"});
  expect_no_output({"merge", "nowhere.unv", "part.unv", "-o", "out.unv", "--report", "no/such/r.json"}, 5,
                   {"no/such/r.json", "[cannot-write]"});
}

TEST(NameOfTheSideFile, IsNotTakenFromAFileOfTheUser) {
  const Folder folder;
  folder.put_plates();
  folder.put("out.unv.carry", kOld);
  const std::vector<std::string> before = folder.files();
  const Outcome outcome = folder.run({"merge", "base.unv", "part.unv", "-o", "out.unv"});
  EXPECT_EQ(outcome.code, 5) << outcome.err;
  EXPECT_NE(outcome.err.find("out.unv.carry: error [cannot-write]"), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.text("out.unv.carry"), kOld);
  EXPECT_EQ(folder.files(), before);
}

TEST(SideFile, OfAnEarlierRunIsReplacedOrRemoved) {
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--report", "r.json"}}) {
    const Folder folder;
    folder.put_plates();
    folder.put("loaded.unv",
               folder.text("part.unv") + "    -1\n   757\n         1\nDOF\n         1         1\n    -1\n");
    const auto merge = [&](const std::string& part) {
      std::vector<std::string> arguments{"merge", "base.unv", part, "-o", "out.unv"};
      arguments.insert(arguments.end(), more.begin(), more.end());
      return folder.run(arguments).code;
    };
    ASSERT_EQ(merge("loaded.unv"), 0);
    EXPECT_NE(folder.text("out.unv.carry").find("DOF"), std::string::npos);
    const std::string first = folder.text("out.unv.carry");
    ASSERT_EQ(merge("loaded.unv"), 0);
    EXPECT_EQ(folder.text("out.unv.carry"), first);
    ASSERT_EQ(merge("part.unv"), 0);
    EXPECT_FALSE(folder.has("out.unv.carry"));
  }
}

TEST(Permissions, AreRespected) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read and write everything";
  const Folder folder;
  folder.put_plates();
  folder.put("protected.unv", kOld);
  std::filesystem::create_directory(folder.path() / "locked");
  using std::filesystem::perms;
  std::filesystem::permissions(folder.path() / "protected.unv", perms::owner_read);
  std::filesystem::permissions(folder.path() / "part.unv", perms::none);
  std::filesystem::permissions(folder.path() / "locked", perms::owner_read | perms::owner_exec);
  EXPECT_EQ(folder.run({"info", "part.unv"}).code, 3);
  EXPECT_EQ(folder.run({"convert", "base.unv", "protected.unv"}).code, 5);
  EXPECT_EQ(folder.run({"convert", "base.unv", "locked/out.unv"}).code, 5);
  EXPECT_EQ(folder.text("protected.unv"), kOld);
}

TEST(FullDisk, IsExitCode5) {
  const Folder folder;
  folder.put_plates();
  const Outcome outcome = folder.run({"convert", "base.unv", "/dev/full"});
  EXPECT_EQ(outcome.code, 5);
  EXPECT_NE(outcome.err.find("[cannot-write]"), std::string::npos) << outcome.err;
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(FullDisk, OfTheReportLeavesTheMeshUnwritten) {
  const Folder folder;
  folder.put_plates();
  folder.put("out.unv", kOld);
  const std::vector<std::string> before = folder.files();
  const Outcome outcome = folder.run({"merge", "base.unv", "part.unv", "-o", "out.unv", "--report", "/dev/full"});
  EXPECT_EQ(outcome.code, 5) << outcome.err;
  EXPECT_NE(outcome.err.find("/dev/full"), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.text("out.unv"), kOld);
  EXPECT_EQ(folder.files(), before);
}

TEST(FullDisk, OrALimitOnTheSizeOfFilesLeavesNothingBehind) {
  const Folder folder;
  folder.put_plates();
  const std::vector<std::string> before = folder.files();
  const Outcome outcome = folder.run_program(
      "/bin/sh", {"-c", "ulimit -f 1; exec \"$0\" merge base.unv part.unv -o out.unv", MESHGRAFT_PROGRAM});
  EXPECT_EQ(outcome.code, 5);
  EXPECT_NE(outcome.err.find("[cannot-write]"), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.files(), before);
}

TEST(FullDisk, OfStdoutIsNoticed) {
  const Folder folder;
  folder.put_plates();
  ModelBuilder many_groups;  // more text than a buffer takes
  const NodeId node = many_groups.add_node({0, 0, 0});
  for (char c = 'A'; c <= 'Z'; ++c) many_groups.add_to_group(std::string(300, c), node);
  folder.put("many.unv", many_groups.build());
  for (const char* file : {"base.unv", "many.unv"}) {
    const Outcome outcome = folder.run_program(MESHGRAFT_PROGRAM, {"info", file}, Stderr::kFile, "/dev/full");
    EXPECT_EQ(outcome.code, 5);
    EXPECT_NE(outcome.err.find("stdout"), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace meshgraft::cli_tests
