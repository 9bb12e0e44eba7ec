#include "cli/print.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>

namespace meshgraft::cli {
namespace {

constexpr std::size_t kLabelWidth = 14;
constexpr std::size_t kWarningsOfAName = 10;

}  // namespace

void print_line(std::string_view label, std::string_view text) {
  say(stdout, "{:<{}}", label, kLabelWidth);
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    say(stdout, "{}\n{:{}}", text.substr(0, end), "", kLabelWidth);
    text.remove_prefix(end + 1);
  }
  say(stdout, "{}\n", text);
}

void print_error(const Error& found) {
  const Error error{
      found.code, printable(found.what), printable(found.hint), {printable(found.place.file), found.place.line}};
  // An error of no file still begins with a name, as every compiler's does.
  say(stderr, "{}{}\n", error.place.file.empty() ? "meshgraft: " : "", to_string(error));
}

void print_warnings(std::span<const Warning> warnings, Talk talk) {
  std::map<std::string, std::size_t> met;
  for (const Warning& found : warnings) {
    if (++met[found.name] > kWarningsOfAName && talk != Talk::kVerbose) continue;
    const Warning warning{found.name, printable(found.what), {printable(found.place.file), found.place.line}};
    say(stderr, "{}{}\n", warning.place.file.empty() ? "meshgraft: " : "", to_string(warning));
  }
  if (talk == Talk::kVerbose) return;
  for (const auto& [name, n] : met)
    if (n > kWarningsOfAName)
      say(stderr, "meshgraft: warning [{}]: {} more of this kind; -v or --report shows all\n", name,
          n - kWarningsOfAName);
}

std::string counted(std::uint64_t n, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

std::string figure(double value) { return fmt::format("{:.4g}", value); }

std::string bytes(std::uint64_t n) {
  constexpr std::array<std::string_view, 5> kUnits{"bytes", "kB", "MB", "GB", "TB"};
  constexpr double kStep = 1000;
  double value = static_cast<double>(n);
  std::size_t unit = 0;
  for (; value >= kStep && unit + 1 < kUnits.size(); ++unit) value /= kStep;
  return unit == 0 ? fmt::format("{} bytes", n) : fmt::format("{:.1f} {}", value, kUnits[unit]);
}

std::string printable(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  return out;
}

Result<void> results_arrived() {
  const bool good = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (good) return {};
  return failure(ErrorCode::kCannotWrite, fmt::format("what was printed did not arrive: {}", std::strerror(errno)),
                 "look where stdout goes", {"stdout", 0});
}

}  // namespace meshgraft::cli
