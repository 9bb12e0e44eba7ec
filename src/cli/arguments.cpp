#include "cli/arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <list>
#include <numbers>
#include <optional>

#include "cli/help.hpp"
#include "cli/nearest.hpp"
#include "cli/values.hpp"

namespace meshgraft::cli {
namespace {

constexpr int kMostThreads = 1024;
constexpr double kRightAngle = 90;  // degrees
constexpr double kRadians = std::numbers::pi / 180;
constexpr double kHighestMinQuality = 0.9;  // a sheet of triangles all better than this is rarely possible
constexpr const char* kNamesFollow = "--";  // what stands after it is a name, even with a dash in front
constexpr const char* kHidden = "";         // the option group that --help does not show

/// One command: CLI11 cuts the arguments into options and names; values are judged here, so that
/// every message is ours. Values are kept as typed until asked for.
class Arguments {
 public:
  Arguments(CLI::App& parent, const std::string& name, const std::string& help)
      : app_(*parent.add_subcommand(name, help)) {
    app_.group("Commands");
    app_.allow_extras();
  }

  void names(const std::string& name, std::vector<std::string>& into, const std::string& help) {
    app_.add_option(name, into, help)->type_name("")->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }
  void name(const std::string& name, std::string& into, const std::string& help) {
    app_.add_option(name, into, help)->type_name("");
  }
  CLI::Option* value(const std::string& names, const std::string& kind, const std::string& help) {
    CLI::Option* option = app_.add_option(names, typed_.emplace_back(), help);
    values_.push_back(option);
    return option->type_name(kind)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  }
  /// An option that may be given several times.
  void repeated(const std::string& names, const std::string& kind, std::vector<std::string>& into,
                const std::string& help) {
    app_.add_option(names, into, help)
        ->type_name(kind)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }
  void flag(const std::string& names, bool& into, const std::string& help) { app_.add_flag(names, into, help); }

  [[nodiscard]] bool called() const { return app_.parsed(); }
  [[nodiscard]] std::vector<std::string> extras() const { return app_.remaining(); }

  [[nodiscard]] std::optional<Typed> typed(const std::string& option) const {
    const CLI::Option* o = app_.get_option(option);
    if (o->count() == 0) return std::nullopt;
    return Typed{option, o->results().back()};
  }

  /// "--tolerance" and so on.
  [[nodiscard]] std::vector<std::string> option_names() const {
    std::vector<std::string> names;
    for (const CLI::Option* option : app_.get_options()) {
      if (option->get_group() == kHidden) continue;
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
  }

  /// What is wrong before any value is looked at: names nobody knows, values left out or given twice.
  [[nodiscard]] Result<void> well_formed() const {
    for (const std::string& extra : extras()) {
      if (extra == kNamesFollow) continue;
      if (!extra.starts_with('-') || extra.size() < 2)
        return failure(ErrorCode::kUsage, fmt::format("'{}' is one argument too many", extra), see_help());
      const std::string option = extra.substr(0, extra.find('='));
      const auto near = nearest(option, option_names());
      return failure(ErrorCode::kUsage,
                     near ? fmt::format("unknown option '{}'; did you mean '{}'?", option, *near)
                          : fmt::format("unknown option '{}'", option),
                     see_help());
    }
    for (const CLI::Option* option : values_) {
      const std::string name = option->get_name(false, false);
      if (option->count() > 1)
        return failure(ErrorCode::kUsage, fmt::format("{} is given {} times", name, option->count()), see_help());
      if (option->count() == 0) continue;
      const std::string& text = option->results().back();
      if (text.empty() || is_option(text))
        return failure(ErrorCode::kUsage,
                       text.empty() ? fmt::format("{} has an empty value", name)
                                    : fmt::format("{} needs a value, but '{}' is an option", name, text),
                       see_help());
    }
    return {};
  }

  [[nodiscard]] Failure missing(std::string_view what) const {
    return failure(ErrorCode::kUsage, fmt::format("{} is missing", what), see_help());
  }

  [[nodiscard]] std::string see_help() const { return fmt::format("see meshgraft {} --help", app_.get_name()); }

 private:
  [[nodiscard]] bool is_option(const std::string& text) const {
    return text.starts_with("--") || app_.get_option_no_throw(text) != nullptr;
  }

  CLI::App& app_;
  std::list<std::string> typed_;  // CLI11 keeps references
  std::vector<const CLI::Option*> values_;
};

/// The options that every command has.
struct CommonOptions {
  bool quiet = false, verbose = false;

  void add(Arguments& a, const std::string& quiet_help, const std::string& verbose_help) {
    a.value("--threads", "N", "threads used; the result does not depend on it [default: all cores]");
    if (!quiet_help.empty()) a.flag("-q,--quiet", quiet, quiet_help);
    if (!verbose_help.empty()) a.flag("-v,--verbose", verbose, verbose_help);
  }

  [[nodiscard]] Result<Common> read(const Arguments& a) const {
    Common common;
    if (quiet && verbose) return failure(ErrorCode::kUsage, "--quiet and --verbose contradict each other");
    common.talk = quiet ? Talk::kQuiet : verbose ? Talk::kVerbose : Talk::kNormal;
    if (const auto typed = a.typed("--threads")) {
      const auto n = integer_in(*typed, 1, kMostThreads, "a number from 1 to 1024");
      if (!n) return Failure(n.error());
      common.threads = static_cast<unsigned>(*n);
    }
    return common;
  }
};

/// Stores the value of an option, if it was given, through `read`.
template <class Read, class Value>
Result<void> store(const Arguments& a, const std::string& option, Read read, Value& into) {
  const auto typed = a.typed(option);
  if (!typed) return {};
  auto value = read(*typed);
  if (!value) return Failure(value.error());
  into = *value;
  return {};
}

Result<double> quality(const Typed& typed) {
  return number_in(typed, {.low = 0, .high = kHighestMinQuality, .allowed = "an aspect ratio Q from 0 to 0.9"});
}

Result<double> angle(const Typed& typed) {
  constexpr Range kRange{.low = 0,
                         .high = kRightAngle,
                         .low_included = false,
                         .high_included = false,
                         .allowed = "an angle in degrees between 0 and 90"};
  return number_in(typed, kRange).map([](double degrees) { return degrees * kRadians; });
}

Result<Mode> mode(const Typed& typed) {
  static const std::vector<std::string> kNames{"auto", "face-edge"}, kLater{"face-face"};
  return choice(typed, kNames, kLater).map([](std::size_t k) { return k == 0 ? Mode::kAuto : Mode::kFaceEdge; });
}

Result<Method> method(const Typed& typed) {
  static const std::vector<std::string> kNames{"adaptive"}, kLater{"paper"};
  return choice(typed, kNames, kLater).map([](std::size_t) { return Method::kAdaptive; });
}

/// What every command has, around what is its own.
template <class Out>
class CommandReader {
 public:
  CommandReader(CLI::App& app, const std::string& name, const std::string& help) : a_(app, name, help) {}
  CommandReader(const CommandReader&) = delete;
  CommandReader& operator=(const CommandReader&) = delete;
  virtual ~CommandReader() = default;

  [[nodiscard]] bool called() const { return a_.called(); }
  [[nodiscard]] Result<Command> read() {
    Result<void> done = a_.well_formed();
    if (done) done = read_own();
    if (!done) return Failure(done.error());
    return common_.read(a_).map([&](const Common& common) {
      out_.common = common;
      return Command(std::move(out_));
    });
  }

 protected:
  /// Judges names and values, which are well formed, and stores them in `out_`.
  [[nodiscard]] virtual Result<void> read_own() = 0;

  Arguments a_;
  CommonOptions common_;
  Out out_;
};

class MergeCommand : public CommandReader<MergeArguments> {
 public:
  explicit MergeCommand(CLI::App& app)
      : CommandReader(app, "merge", "graft PARTs onto BASE, or join the meshes in BASE") {
    a_.name("BASE", out_.base, "mesh that is kept but for the zone where parts meet it (UNV)");
    a_.names("PART", out_.parts,
             "meshes that are grafted onto it (UNV); with none, the meshes in BASE are joined with each other");
    a_.value("-o,--output", "OUT", "file written (UNV); appears whole or not at all; required");
    a_.value("--report", "FILE", "JSON file with the ledger and all figures [default: none]");
    a_.repeated("--join", "A:B", joins_,
                "join only faces of element group A with faces of element group B; may be given several times "
                "[default: all that meet]");
    a_.value("--mode", "MODE", "how meeting faces are treated: auto or face-edge [default: auto]");
    a_.value("--method", "METHOD", "how the zone is filled: adaptive [default: adaptive]");
    a_.value("--angle", "DEG", "faces that meet at less than this lie on each other; degrees [default: 20]");
    a_.value("--tolerance", "LEN|N%",
             "gap or penetration that is closed; a length in file units, or a share of the local edge length "
             "[default: 1%]");
    a_.value("--trim", "beyond=LEN|none",
             "loose ends of parts that stick out beyond the junction by less than LEN are dropped; file units "
             "[default: none]");
    a_.value("--size", "LEN|auto",
             "edge length along the junction, in file units; auto: mean edge length there [default: auto]");
    a_.value("--bandwidth", "N|auto", "neighbourhoods of the junction remeshed on both sides, a count [default: auto]");
    a_.value("--min-quality", "Q",
             "worst aspect ratio accepted in new faces, 0 to 0.9; 1 is equilateral [default: 0.5]");
    a_.flag("--allow-poor", out_.allow_poor, "write the result although a promise is not met [default: no]");
    a_.flag("--allow-apart", out_.options.allow_apart, "add parts that meet nothing, unjoined [default: no]");
    common_.add(a_, "no progress and no summary; errors and warnings stay", "also timings and groups that changed");
    for (const auto& [name, reason] : kNotInThisVersion) a_.value(name, "NAME", reason)->group(kHidden);
  }

 private:
  Result<void> read_own() override {
    for (const auto& [name, reason] : kNotInThisVersion)
      if (a_.typed(name)) return failure(ErrorCode::kUsage, fmt::format("{} is {}", name, reason), a_.see_help());
    if (out_.base.empty()) return a_.missing("BASE, the mesh to graft onto,");
    Result<void> done = read_options();
    if (done && out_.output.empty()) return a_.missing("-o OUT, the file to write,");
    return done;
  }

  /// Options of the method that this version refuses: an option is honoured or an error.
  static constexpr std::pair<const char*, const char*> kNotInThisVersion[] = {
      {"--overlap", "not in this version of meshgraft: faces that lie on each other are an error [overlap]"},
      {"--blend", "not in this version of meshgraft: new nodes lie on the surfaces of the inputs"}};

  Result<void> read_options() {
    const auto text = [](const Typed& typed) { return Result<std::string>(typed.text); };
    MergeOptions& o = out_.options;
    Result<void> done = store(a_, "--output", text, out_.output);
    if (done) done = store(a_, "--report", text, out_.report);
    if (done) done = store(a_, "--mode", mode, o.mode);
    if (done) done = store(a_, "--method", method, o.method);
    if (done) done = store(a_, "--angle", angle, o.contact_angle);
    if (done) done = store(a_, "--tolerance", tolerance, o.tolerance);
    if (done) done = store(a_, "--trim", trim, o.trim);
    if (done) done = store(a_, "--size", size, o.size);
    if (done) done = store(a_, "--bandwidth", bandwidth, o.bandwidth);
    if (done) done = store(a_, "--min-quality", quality, o.min_quality);
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
    common_.add(a_, "print nothing; the exit code is the answer", {});
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
                                                         {"check", "check FILE [options]"},
                                                         {"info", "info FILE [options]"},
                                                         {"convert", "convert IN OUT [options]"}};
  return kUsage;
}

/// `extras`: what stands outside of any command.
Failure no_command(const std::vector<std::string>& extras) {
  static const std::vector<std::string> kCommands{"merge", "check", "info", "convert"};
  constexpr const char* kHint = "commands: merge, check, info, convert; see meshgraft --help";
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
  if (check.called()) return check.read();
  if (info.called()) return info.read();
  if (convert.called()) return convert.read();
  return no_command({});
}

}  // namespace meshgraft::cli
