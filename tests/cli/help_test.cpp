#include <gtest/gtest.h>

#include "program.hpp"

namespace meshgraft::cli_tests {
namespace {

TEST(Help, NamesAllCommandsAndExitCodes) {
  const Folder folder;
  const Outcome outcome = folder.run({"--help"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  for (const char* text : {"merge", "check", "info", "convert", "--version", "Exit codes: 0 done"})
    EXPECT_NE(outcome.out.find(text), std::string::npos) << text;
}

TEST(Help, SaysTheDefaultOfEveryOptionOfMerge) {
  const Folder folder;
  const Outcome outcome = folder.run({"merge", "--help"});
  EXPECT_EQ(outcome.code, 0);
  const std::vector<std::pair<std::string, std::string>> defaults{
      {"--report", "none"},     {"--mode", "auto"},     {"--method", "adaptive"}, {"--blend", "tangency"},
      {"--angle", "20"},        {"--size", "auto"},     {"--tolerance", "1%"},    {"--bandwidth", "auto"},
      {"--min-quality", "0.5"}, {"--allow-poor", "no"}, {"--allow-apart", "no"},  {"--threads", "all cores"}};
  for (const auto& [option, value] : defaults) {
    const std::size_t at = outcome.out.find("\n  " + option);
    ASSERT_NE(at, std::string::npos) << option;
    const std::size_t next = outcome.out.find("\n  -", at + 1);
    EXPECT_NE(outcome.out.substr(at, next - at).find("[default: " + value + "]"), std::string::npos) << option;
  }
}

TEST(Help, FitsOnAScreen) {
  const Folder folder;
  for (const char* command : {"merge", "cut", "fill", "check", "info", "convert"}) {
    const std::string out = folder.run({command, "-h"}).out;
    for (std::size_t begin = 0; begin < out.size();) {
      const std::size_t end = out.find('\n', begin);
      EXPECT_LE(end - begin, 100u) << out.substr(begin, end - begin);
      begin = end + 1;
    }
  }
}

TEST(Help, IsGivenEvenAmongErrors) {
  const Folder folder;
  EXPECT_EQ(folder.run({"merge", "--frobnicate", "--help"}).code, 0);
}

TEST(Version, IsThatOfTheProject) {
  const Folder folder;
  const Outcome outcome = folder.run({"--version"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "meshgraft " MESHGRAFT_VERSION "\n");
}

}  // namespace
}  // namespace meshgraft::cli_tests
