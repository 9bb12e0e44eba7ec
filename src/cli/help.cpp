#include "cli/help.hpp"

#include <fmt/format.h>

#include <string_view>

namespace meshgraft::cli {
namespace {

constexpr std::size_t kLeft = 26, kScreen = 100;  // letters

/// One entry of a two-column list.
std::string entry(std::string_view left, std::string_view right) {
  std::string text = fmt::format("  {:<{}}", left, kLeft - 2);
  std::size_t column = text.size();
  if (column > kLeft) {
    text += fmt::format("\n{:{}}", "", kLeft);
    column = kLeft;
  }
  while (!right.empty()) {
    // "[default: 20]" stays in one piece.
    const std::size_t end = right.front() == '[' ? right.find(']') + 1 : right.find(' ');
    const std::string_view word = right.substr(0, end);
    right.remove_prefix(std::min(right.size(), word.size() + 1));
    if (column + 1 + word.size() > kScreen) {
      text += fmt::format("\n{:{}}", "", kLeft);
      column = kLeft;
    }
    text += " ";
    text += word;
    column += 1 + word.size();
  }
  return text + "\n";
}

}  // namespace

std::string HelpLayout::make_usage(const CLI::App* app, std::string) const {
  const bool program = app->get_parent() == nullptr;
  return fmt::format("\nusage: meshgraft {}\n", usage_.at(program ? "" : app->get_name()));
}

std::string HelpLayout::make_option(const CLI::Option* option, bool is_positional) const {
  const bool has_value = option->get_type_size() != 0 && !is_positional;
  std::string names = make_option_name(option, is_positional);
  if (const std::size_t comma = names.find(','); comma != std::string::npos) names.insert(comma + 1, " ");
  if (has_value) names += " " + option->get_type_name();
  return entry(names, option->get_description());
}

std::string HelpLayout::make_subcommand(const CLI::App* command) const {
  return entry(command->get_name(), command->get_description());
}

}  // namespace meshgraft::cli
