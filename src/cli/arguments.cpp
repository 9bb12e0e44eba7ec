#include "cli/arguments.hpp"

#include <array>
#include <numbers>

#include "cli/command_reader.hpp"
#include "cli/cut_arguments.hpp"
#include "cli/fill_arguments.hpp"
#include "cli/help.hpp"
#include "cli/zone_options.hpp"

namespace meshgraft::cli {
namespace {

constexpr double kRightAngle = 90;  // degrees
constexpr double kRadians = std::numbers::pi / 180;

Result<double> angle(const Typed& typed) {
  constexpr Range kRange{.low = 0,
                         .high = kRightAngle,
                         .low_included = false,
                         .high_included = false,
                         .allowed = "an angle in degrees between 0 and 90"};
  return number_in(typed, kRange).map([](double degrees) { return degrees * kRadians; });
}

Result<Mode> mode(const Typed& typed) {
  static const std::vector<std::string> kNames{"auto", "face-edge", "face-face"};
  static constexpr std::array kModes{Mode::kAuto, Mode::kFaceEdge, Mode::kFaceFace};
  return choice(typed, kNames).map([](std::size_t k) { return kModes[k]; });
}

Result<Overlap> overlap(const Typed& typed) {
  static const std::vector<std::string> kNames{"fuse", "keep-base", "keep-part", "project"};
  static constexpr std::array kOverlaps{Overlap::kFuse, Overlap::kKeepBase, Overlap::kKeepPart, Overlap::kProject};
  return choice(typed, kNames).map([](std::size_t k) { return kOverlaps[k]; });
}

class MergeCommand : public CommandReader<MergeArguments> {
 public:
  explicit MergeCommand(CLI::App& app)
      : CommandReader(app, "merge", "graft PARTs onto BASE, or join the meshes in BASE") {
    a_.name("BASE", out_.base, "mesh that is kept but for the zone where parts meet it (UNV)");
    a_.names("PART", out_.parts,
             "meshes that are grafted onto it (UNV); with none, the meshes in BASE are joined with each other");
    a_.repeated("--join", "A:B", joins_,
                "join only faces of element group A with faces of element group B; may be given several times "
                "[default: all that meet]");
    add_output_options(a_);
    a_.value("--mode", "MODE",
             "how meeting faces are treated: auto (place by place), face-edge or face-face [default: auto]");
    a_.value("--overlap", "KIND",
             "where faces lie on each other: fuse (one layer in the groups of both), keep-base or keep-part (the other "
             "side's faces go), project (two layers on the same nodes) [default: fuse]");
    add_method_option(a_);
    add_blend_option(a_, "; with --method paper");
    a_.value("--angle", "DEG", "faces that meet at less than this lie on each other; degrees [default: 20]");
    a_.value("--trim", "beyond=LEN|none",
             "loose ends of parts that are less than LEN long from the junction on are dropped; file units "
             "[default: none]");
    add_zone_options(a_,
                     "gap or penetration that is closed; a length in file units, or a share of the local edge length "
                     "[default: 1%]",
                     out_);
    a_.flag("--allow-apart", out_.options.allow_apart, "add parts that meet nothing, unjoined [default: no]");
    common_.add(a_, "no progress and no summary; errors and warnings stay", "also timings and groups that changed");
  }

 private:
  Result<void> read_own() override {
    if (out_.base.empty()) return a_.missing("BASE, the mesh to graft onto,");
    return read_options();
  }

  Result<void> read_options() {
    MergeOptions& o = out_.options;
    Result<void> done = read_zone_options(a_, out_);
    if (done) done = store(a_, "--mode", mode, o.mode);
    if (done) done = store(a_, "--overlap", overlap, o.overlap);
    if (done) done = store(a_, "--method", method, o.method);
    if (done) done = store(a_, "--blend", blend, o.blend);
    if (done && a_.typed("--blend") && o.method != Method::kPaper)
      return failure(ErrorCode::kUsage,
                     "--blend needs --method paper: the adaptive method leaves new nodes on the surface that was there",
                     a_.see_help());
    if (done) done = store(a_, "--angle", angle, o.contact_angle);
    if (done) done = store(a_, "--trim", trim, o.trim);
    for (const std::string& names : joins_) {
      if (!done) break;
      done = joined_groups({"--join", names}).map([&](const JoinedGroups& groups) { o.joins.push_back(groups); });
    }
    return done;
  }

  std::vector<std::string> joins_;
};

class CheckCommand : public CommandReader<CheckArguments> {
 public:
  explicit CheckCommand(CLI::App& app) : CommandReader(app, "check", "say what is wrong with the mesh in FILE") {
    a_.name("FILE", out_.file, "mesh to check (UNV)");
    a_.value("--min-quality", "Q", "faces with a lower aspect ratio are counted, 0 to 0.9 [default: 0.5]");
    common_.add(a_, "print nothing; the exit code is the answer", "all places of each kind, not only the first 10");
  }

 private:
  Result<void> read_own() override {
    if (out_.file.empty()) return a_.missing("FILE");
    return store(a_, "--min-quality", quality, out_.min_quality);
  }
};

class InfoCommand : public CommandReader<InfoArguments> {
 public:
  explicit InfoCommand(CLI::App& app) : CommandReader(app, "info", "say what is in FILE") {
    a_.name("FILE", out_.file, "mesh to describe (UNV)");
    common_.add(a_, {}, "all groups, not only the first 30");
  }

 private:
  Result<void> read_own() override {
    if (out_.file.empty()) return a_.missing("FILE");
    return {};
  }
};

class ConvertCommand : public CommandReader<ConvertArguments> {
 public:
  explicit ConvertCommand(CLI::App& app) : CommandReader(app, "convert", "write the mesh in IN to OUT; loses nothing") {
    a_.name("IN", out_.input, "mesh to read (UNV)");
    a_.name("OUT", out_.output, "file written (UNV); appears whole or not at all");
    common_.add(a_, "print nothing but errors and warnings", {});
  }

 private:
  Result<void> read_own() override {
    if (out_.input.empty()) return a_.missing("IN, the file to read,");
    if (out_.output.empty()) return a_.missing("OUT, the file to write,");
    return {};
  }
};

constexpr const char* kExitCodes =
    "Exit codes: 0 done; 1 a promise is not met (nothing is written unless --allow-poor), or check found\n"
    "faults; 2 wrong usage; 3 an input cannot be read or used; 4 parts do not meet (nothing is written\n"
    "unless --allow-apart); 5 an output cannot be written.\n";

const std::map<std::string, std::string>& usage() {
  static const std::map<std::string, std::string> kUsage{{"", "COMMAND ... | --help | --version"},
                                                         {"merge", "merge BASE [PART...] -o OUT [options]"},
                                                         {"cut", "cut BASE [TOOL] --drop WHAT -o OUT [options]"},
                                                         {"fill", "fill FILE -o OUT [options] | fill FILE --list"},
                                                         {"check", "check FILE [options]"},
                                                         {"info", "info FILE [options]"},
                                                         {"convert", "convert IN OUT [options]"}};
  return kUsage;
}

/// `extras`: what stands outside of any command.
Failure no_command(const std::vector<std::string>& extras) {
  static const std::vector<std::string> kCommands{"merge", "cut", "fill", "check", "info", "convert"};
  constexpr const char* kHint = "commands: merge, cut, fill, check, info, convert; see meshgraft --help";
  if (extras.empty()) return failure(ErrorCode::kUsage, "no command", kHint);
  const std::string& word = extras.front();
  if (word.starts_with('-'))
    return failure(ErrorCode::kUsage, fmt::format("'{}' stands before the command; options follow it", word), kHint);
  const auto near = nearest(word, kCommands);
  return failure(ErrorCode::kUsage,
                 near ? fmt::format("unknown command '{}'; did you mean '{}'?", word, *near)
                      : fmt::format("unknown command '{}'", word),
                 kHint);
}

}  // namespace

Result<Command> command(std::span<const char* const> arguments) {
  CLI::App app("Grafts one finite-element shell mesh onto another, groups and all.", "meshgraft");
  app.set_version_flag("--version", std::string("meshgraft ") + MESHGRAFT_VERSION, "print the version");
  app.set_help_flag("-h,--help", "print this help");
  app.formatter(std::make_shared<HelpLayout>(usage()));
  app.require_subcommand(0, 1);
  app.allow_extras();
  app.footer(kExitCodes);

  MergeCommand merge(app);
  CutReader cut(app);
  FillReader fill(app);
  CheckCommand check(app);
  InfoCommand info(app);
  ConvertCommand convert(app);
  app.footer(std::string("meshgraft COMMAND --help tells the files and options of a command.\n\n") + kExitCodes);
  try {
    std::vector<std::string> backwards(arguments.rbegin(), arguments.rend());  // the order CLI11 asks for
    app.parse(std::move(backwards));
  } catch (const CLI::CallForHelp&) {
    return Answer{app.help()};
  } catch (const CLI::CallForVersion& version) {
    return Answer{std::string(version.what()) + "\n"};
  } catch (const CLI::ArgumentMismatch&) {  // CLI11 finds a value missing only at the very end
    return failure(ErrorCode::kUsage, fmt::format("'{}' needs a value", arguments.back()), "see meshgraft --help");
  } catch (const CLI::ConversionError& error) {  // values are kept as typed, so it is one of a flag
    return failure(ErrorCode::kUsage, fmt::format("an option that takes no value has one ({})", error.what()),
                   "see meshgraft --help");
  } catch (const CLI::ParseError& error) {
    return failure(ErrorCode::kUsage, error.what(), "see meshgraft --help");
  }
  std::vector<std::string> extras = app.remaining();
  std::erase(extras, kNamesFollow);
  if (!extras.empty()) return no_command(extras);
  if (merge.called()) return merge.read();
  if (cut.called()) return cut.read();
  if (fill.called()) return fill.read();
  if (check.called()) return check.read();
  if (info.called()) return info.read();
  if (convert.called()) return convert.read();
  return no_command({});
}

}  // namespace meshgraft::cli
