#include "cli/formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "cli/nearest.hpp"

namespace meshgraft::cli {
namespace {

// All are universal files, the only format so far.
constexpr std::array<std::string_view, 2> kExtensions{".unv", ".uff"};

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

}  // namespace

Result<void> writable_format(const std::string& path) {
  const std::string extension = lower(std::filesystem::path(path).extension().string());
  if (extension.empty() || std::ranges::find(kExtensions, extension) != kExtensions.end()) return {};
  return failure(ErrorCode::kUsage, fmt::format("'{}': no format with the extension '{}' is written", path, extension),
                 fmt::format("formats known: I-DEAS universal file ({})", fmt::join(kExtensions, ", ")));
}

}  // namespace meshgraft::cli
