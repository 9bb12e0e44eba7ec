// The command line, understood: what to do, with which files and options.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "meshgraft/cut.hpp"
#include "meshgraft/fill.hpp"
#include "meshgraft/options.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft::cli {

enum class Talk { kQuiet, kNormal, kVerbose };

/// What all commands know.
struct Common {
  Talk talk = Talk::kNormal;
  unsigned threads = 0;  // 0 = all cores
};

struct MergeArguments {
  std::string base;
  std::vector<std::string> parts;
  std::string output;
  std::string report;  // empty: none
  MergeOptions options;
  bool allow_poor = false;  // write although a promise is broken
  Common common;
};

struct CutArguments {
  MergeArguments mesh;    // base, output and zone; no parts
  std::string tool_file;  // empty: `tool`
  CutTool tool;
  Drop drop;
  Common common;
};

struct FillArguments {
  MergeArguments mesh;                    // base, output and options; no parts
  std::vector<OpeningContours> openings;  // as in FillOptions
  bool list = false;                      // only tell which there are
  Common common;
};

struct CheckArguments {
  std::string file;
  double min_quality = 0.5;
  Common common;
};

struct InfoArguments {
  std::string file;
  Common common;
};

struct ConvertArguments {
  std::string input, output;
  Common common;
};

/// The answer to --help and --version.
struct Answer {
  std::string text;
};

using Command =
    std::variant<Answer, MergeArguments, CutArguments, FillArguments, CheckArguments, InfoArguments, ConvertArguments>;

/// Understands the arguments after the program's name. Errors: kUsage, naming the value, what is
/// allowed, and the nearest existing name where one was mistyped.
[[nodiscard]] Result<Command> command(std::span<const char* const> arguments);

}  // namespace meshgraft::cli
