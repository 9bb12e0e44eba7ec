// The layout of --help.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

namespace meshgraft::cli {

/// Names on the left, explanations on the right, broken between words so that a line fits on a screen.
class HelpLayout : public CLI::Formatter {
 public:
  /// `usage`: what follows the program's name, by command; "" is the program itself.
  explicit HelpLayout(std::map<std::string, std::string> usage) : usage_(std::move(usage)) {
    label("Positionals", "Files");
  }

  std::string make_usage(const CLI::App* app, std::string name) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* command) const override;

 private:
  std::map<std::string, std::string> usage_;
};

}  // namespace meshgraft::cli
