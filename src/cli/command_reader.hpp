// What all commands of the command line are read with.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <list>
#include <optional>
#include <span>

#include "cli/arguments.hpp"
#include "cli/nearest.hpp"
#include "cli/values.hpp"

namespace meshgraft::cli {

inline constexpr int kMostThreads = 1024;
inline constexpr const char* kNamesFollow = "--";  // what stands after it is a name, even with a dash in front

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
    CLI::Option* option = app_.add_option(names, into, help);
    repeated_.push_back(option);
    option->type_name(kind)->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
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
      if (const auto good = with_values(*option); !good) return good;
    }
    for (const CLI::Option* option : repeated_)
      if (const auto good = with_values(*option); !good) return good;
    return {};
  }

  /// The first option given that is none of `names`, as in "--report".
  [[nodiscard]] std::optional<std::string> given_beside(std::span<const std::string_view> names) const {
    for (const CLI::Option* option : app_.get_options()) {
      if (option->count() == 0 || option->get_lnames().empty()) continue;
      const std::string name = "--" + option->get_lnames().front();
      if (std::ranges::find(names, name) == names.end()) return name;
    }
    return std::nullopt;
  }

  [[nodiscard]] Failure missing(std::string_view what) const {
    return failure(ErrorCode::kUsage, fmt::format("{} is missing", what), see_help());
  }

  [[nodiscard]] std::string see_help() const { return fmt::format("see meshgraft {} --help", app_.get_name()); }

 private:
  [[nodiscard]] Result<void> with_values(const CLI::Option& option) const {
    const std::string name = option.get_name(false, false);
    for (const std::string& text : option.results()) {
      if (text.empty()) return failure(ErrorCode::kUsage, fmt::format("{} has an empty value", name), see_help());
      if (is_option(text))
        return failure(ErrorCode::kUsage, fmt::format("{} needs a value, but '{}' is an option", name, text),
                       see_help());
    }
    return {};
  }

  [[nodiscard]] bool is_option(const std::string& text) const {
    return text.starts_with("--") || (text.starts_with('-') && app_.get_option_no_throw(text) != nullptr);
  }

  CLI::App& app_;
  std::list<std::string> typed_;  // CLI11 keeps references
  std::vector<const CLI::Option*> values_, repeated_;
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
    if (quiet && verbose)
      return failure(ErrorCode::kUsage, "--quiet and --verbose contradict each other", a.see_help());
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

}  // namespace meshgraft::cli
