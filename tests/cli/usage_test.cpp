// Every wrong use of the command line: exit code 2, the value and what is allowed on stderr, nothing
// on stdout, nothing written.
#include <gtest/gtest.h>

#include <ostream>

#include "program.hpp"

namespace meshgraft::cli_tests {
namespace {

struct Wrong {
  const char* name;
  std::vector<std::string> arguments;
  std::vector<std::string> says;
};

std::ostream& operator<<(std::ostream& out, const Wrong& wrong) { return out << wrong.name; }

std::vector<std::string> merge_with(std::vector<std::string> more) {
  std::vector<std::string> all{"merge", "base.unv", "part.unv", "-o", "out.unv"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

class WrongUsage : public testing::TestWithParam<Wrong> {};

TEST_P(WrongUsage, IsExplainedAndNothingIsWritten) {
  const Folder folder;
  const Outcome outcome = folder.run(GetParam().arguments);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(outcome.err.starts_with("meshgraft: error [usage]: ")) << outcome.err;
  for (const std::string& text : GetParam().says)
    EXPECT_NE(outcome.err.find(text), std::string::npos) << "'" << text << "' is not in\n" << outcome.err;
  EXPECT_TRUE(folder.files().empty());
}

INSTANTIATE_TEST_SUITE_P(
    Of, WrongUsage,
    testing::Values(
        Wrong{"NoCommand", {}, {"no command", "merge, cut, fill, check, info, convert"}},
        Wrong{"MistypedCommand", {"mrege", "a", "b"}, {"'mrege'", "did you mean 'merge'?"}},
        Wrong{"UnknownCommand", {"weld"}, {"unknown command 'weld'", "merge, cut, fill, check, info, convert"}},
        Wrong{"OptionBeforeCommand", {"-v", "merge", "a", "b"}, {"'-v' stands before the command"}},
        Wrong{"NoBase", {"merge"}, {"BASE", "is missing", "meshgraft merge --help"}},
        Wrong{"JoinWithoutColon", merge_with({"--join", "WALL"}), {"--join", "'WALL' is not two names"}},
        Wrong{"JoinOfAnEmptyName", merge_with({"--join", ":RIB"}), {"':RIB' is not two names"}},
        Wrong{"JoinOfThreeNames", merge_with({"--join", "A:B:C"}), {"'A:B:C' is not two names"}},
        Wrong{"NoOutput", {"merge", "a.unv", "b.unv"}, {"-o OUT", "is missing"}},
        Wrong{"NoFileToCheck", {"check"}, {"FILE is missing"}},
        Wrong{"NoFileToDescribe", {"info"}, {"FILE is missing"}},
        Wrong{"NoFileToConvertTo", {"convert", "a.unv"}, {"OUT", "is missing"}},
        Wrong{"TooManyFiles", {"check", "a.unv", "b.unv"}, {"'b.unv' is one argument too many"}},
        Wrong{"MistypedOption", merge_with({"--tolernce", "3"}), {"'--tolernce'", "did you mean '--tolerance'?"}},
        Wrong{"MistypedOptionWithValue", merge_with({"--agnle=3"}), {"'--agnle'", "did you mean '--angle'?"}},
        Wrong{"CutOption", merge_with({"--tol", "3"}), {"'--tol'", "did you mean '--tolerance'?"}},
        Wrong{"UnknownOption", merge_with({"--frobnicate"}), {"unknown option '--frobnicate'"}},
        Wrong{"UnknownShortOption", merge_with({"-x"}), {"unknown option '-x'"}},
        Wrong{"OptionOfAnotherCommand", {"info", "a.unv", "--angle", "3"}, {"'--angle'"}},
        Wrong{"ValueLeftOutAtTheEnd", {"merge", "a", "b", "-o"}, {"'-o' needs a value"}},
        Wrong{"ValueLeftOut", {"merge", "a", "b", "-o", "--report", "r"}, {"--output needs a value", "'--report'"}},
        Wrong{"EmptyValue", {"merge", "a", "b", "-o", ""}, {"--output has an empty value"}},
        Wrong{"GivenTwice", merge_with({"-o", "again.unv"}), {"--output is given 2 times"}},
        Wrong{"ValueForAFlag", merge_with({"--quiet=perhaps"}), {"takes no value", "--quiet", "perhaps"}},
        Wrong{"QuietAndVerbose", merge_with({"-q", "-v"}), {"--quiet and --verbose contradict"}}),
    [](const auto& tested) { return tested.param.name; });

INSTANTIATE_TEST_SUITE_P(
    OfValues, WrongUsage,
    testing::Values(
        Wrong{"AngleOfZero", merge_with({"--angle", "0"}), {"--angle: '0' is out of range", "between 0 and 90"}},
        Wrong{"AngleOfNinety", merge_with({"--angle", "90"}), {"'90' is out of range", "degrees between 0 and 90"}},
        Wrong{"AngleBelowZero", merge_with({"--angle", "-5"}), {"'-5' is out of range"}},
        Wrong{"AngleInWords", merge_with({"--angle", "steep"}), {"'steep' is not a number"}},
        Wrong{"AngleWithUnit", merge_with({"--angle", "20deg"}), {"'20deg' is not a number"}},
        Wrong{"ToleranceBelowZero", merge_with({"--tolerance", "-1%"}), {"--tolerance: '-1%'", "as in 1%"}},
        Wrong{"ToleranceWithComma", merge_with({"--tolerance", "0,5"}), {"'0,5'", "as in 0.5"}},
        Wrong{"ToleranceWithTwoPercentSigns", merge_with({"--tolerance", "5%%"}), {"'5%%'"}},
        Wrong{"SizeOfZero", merge_with({"--size", "0"}), {"--size: '0'", "greater than 0", "auto"}},
        Wrong{"SizeWithComma", merge_with({"--size", "1,5"}), {"'1,5'", "decimals are written with a point"}},
        Wrong{"SizeNotANumber", merge_with({"--size", "nan"}), {"'nan' is not a number"}},
        Wrong{"SizeInfinite", merge_with({"--size", "inf"}), {"'inf' is not a number"}},
        Wrong{"SizeTooLarge", merge_with({"--size", "1e999"}), {"'1e999' is not a number"}},
        Wrong{"BandwidthOfZero", merge_with({"--bandwidth", "0"}), {"--bandwidth: '0'", "from 1", "auto"}},
        Wrong{"BandwidthBroken", merge_with({"--bandwidth", "1.5"}), {"'1.5' is not a whole number"}},
        Wrong{"QualityTooHigh", merge_with({"--min-quality", "0.95"}), {"--min-quality: '0.95'", "from 0 to 0.9"}},
        Wrong{"QualityBelowZero", {"check", "a.unv", "--min-quality", "-0.1"}, {"'-0.1'", "from 0 to 0.9"}},
        Wrong{"NoThreads", merge_with({"--threads", "0"}), {"--threads: '0'", "from 1"}},
        Wrong{"ManyThreads", merge_with({"--threads", "99999999999"}), {"'99999999999'"}},
        Wrong{"MistypedMode", merge_with({"--mode", "face-egde"}), {"'face-egde'", "did you mean 'face-edge'?"}},
        Wrong{"UnknownMethod", merge_with({"--method", "magic"}), {"'magic' is not known", "adaptive"}},
        Wrong{"Overlap", merge_with({"--overlap", "glue"}), {"'glue'", "fuse", "project"}},
        Wrong{"Blend", merge_with({"--blend", "tangency"}), {"--blend needs --method paper"}},
        Wrong{"FormatNotWritten", {"merge", "a", "b", "-o", "out.med"}, {"'.med'", "universal file (.unv, .uff)"}},
        Wrong{"FormatNotConverted", {"convert", "a.unv", "b.inp"}, {"'.inp'", "universal file (.unv, .uff)"}}),
    [](const auto& tested) { return tested.param.name; });

TEST(Outputs, AreNeverAnInput) {
  const Folder folder;
  folder.put_plates();
  const std::string base = folder.text("base.unv"), part = folder.text("part.unv");
  std::filesystem::create_symlink("part.unv", folder.path() / "link.unv");
  const std::vector<std::vector<std::string>> calls{
      {"merge", "base.unv", "part.unv", "-o", "base.unv"},
      {"merge", "base.unv", "part.unv", "-o", "./part.unv"},
      {"merge", "base.unv", "part.unv", "-o", "link.unv"},
      {"merge", "base.unv", "part.unv", "-o", "o.unv", "--report", "base.unv"},
      {"convert", "base.unv", folder / "base.unv"}};
  for (const auto& call : calls) {
    const Outcome outcome = folder.run(call);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find("are the same file"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(folder.text("base.unv"), base);
  EXPECT_EQ(folder.text("part.unv"), part);
}

TEST(Inputs, AreGivenOnce) {
  const Folder folder;
  folder.put_plates();
  std::filesystem::create_symlink("part.unv", folder.path() / "link.unv");
  for (const std::vector<std::string>& parts : {std::vector<std::string>{"base.unv"}, {"part.unv", "./link.unv"}}) {
    std::vector<std::string> call{"merge", "base.unv", "-o", "out.unv"};
    call.insert(call.begin() + 2, parts.begin(), parts.end());
    const Outcome outcome = folder.run(call);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find("PART are the same file"), std::string::npos) << outcome.err;
  }
}

TEST(Outputs, AreNoDash) {
  const Folder folder;
  folder.put_plates();
  const Outcome outcome = folder.run({"merge", "base.unv", "part.unv", "-o", "-"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("/dev/stdout"), std::string::npos) << outcome.err;
  EXPECT_FALSE(folder.has("-"));
}

TEST(Outputs, AreNeverEachOther) {
  const Folder folder;
  folder.put_plates();
  const Outcome outcome = folder.run({"merge", "base.unv", "part.unv", "-o", "out.unv", "--report", "./out.unv"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--report and -o are the same file"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("input"), std::string::npos) << outcome.err;
  EXPECT_FALSE(folder.has("out.unv"));
}

}  // namespace
}  // namespace meshgraft::cli_tests
