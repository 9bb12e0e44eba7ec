#include "io/side_file.hpp"

#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "io/atomic_output.hpp"

namespace meshgraft {

namespace fs = std::filesystem;

std::string side_path(const std::string& output) { return without_links(output) + ".carry"; }

bool is_side_path_taken(const std::string& output) {
  const fs::path path = side_path(output);
  std::error_code error;
  if (fs::symlink_status(path, error).type() == fs::file_type::not_found) return false;
  if (!fs::is_regular_file(path, error)) return true;
  const std::string_view mark = kSideFileMark;
  std::string begin(mark.size(), '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return !in || begin != mark;
}

}  // namespace meshgraft
