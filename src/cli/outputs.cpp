#include "cli/outputs.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <system_error>

#include "io/atomic_output.hpp"

namespace meshgraft::cli {
namespace {

namespace fs = std::filesystem;

bool same_file(const std::string& a, const std::string& b) {
  std::error_code none;
  if (fs::equivalent(a, b, none)) return true;
  const auto full = [&](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(without_links(path), none), none);
  };
  return !full(a).empty() && full(a) == full(b);
}

Failure cannot_write(const NamedFile& file, std::string what, std::string hint) {
  return failure(ErrorCode::kCannotWrite, std::move(what), std::move(hint), {file.path, 0});
}

Result<void> check_place(const NamedFile& file) {
  std::error_code error;
  const fs::path path = without_links(file.path);
  const fs::path directory = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const fs::file_status there = fs::status(directory, error);
  if (!fs::exists(there))
    return cannot_write(file, fmt::format("the directory '{}' does not exist", directory.string()),
                        "make it, or give another name to " + file.role);
  if (!fs::is_directory(there))
    return cannot_write(file, fmt::format("'{}' is not a directory", directory.string()),
                        "give another name to " + file.role);
  const fs::file_status old = fs::status(path, error);
  if (old.type() == fs::file_type::none)  // a circle of links, a name that is too long
    return cannot_write(file, fmt::format("cannot be written: {}", error.message()),
                        "give another name to " + file.role);
  if (fs::is_directory(old)) return cannot_write(file, "is a directory", "give the name of a file to " + file.role);
  if (fs::exists(old) && ::access(path.c_str(), W_OK) != 0)
    return cannot_write(file, fmt::format("is protected: {}", std::strerror(errno)),
                        "make it writable, or give another name to " + file.role);
  if (fs::exists(old) && !fs::is_regular_file(old)) return {};  // a device or a pipe is written in place
  if (::access(directory.c_str(), W_OK | X_OK) != 0)
    return cannot_write(file, fmt::format("no file can be made in '{}': {}", directory.string(), std::strerror(errno)),
                        "choose a directory you may write to");
  return {};
}

}  // namespace

bool is_replaced(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return !fs::exists(status) || fs::is_regular_file(status);
}

bool is_stdout(const std::string& path) {
  struct ::stat named {
  }, ours{};
  return ::stat(path.c_str(), &named) == 0 && ::fstat(STDOUT_FILENO, &ours) == 0 && named.st_dev == ours.st_dev &&
         named.st_ino == ours.st_ino;
}

Result<void> check_inputs(std::span<const NamedFile> inputs) {
  for (std::size_t k = 0; k < inputs.size(); ++k)
    for (const NamedFile& other : inputs.first(k))
      if (same_file(inputs[k].path, other.path))
        return failure(ErrorCode::kUsage,
                       fmt::format("{} and {} are the same file, '{}'", other.role, inputs[k].role, inputs[k].path),
                       "give each file once; a file alone is joined with itself");
  return {};
}

Result<void> check_outputs(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs) {
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    const NamedFile& file = outputs[k];
    if (file.path == "-")
      return failure(ErrorCode::kUsage, fmt::format("{} is '-', which is no file", file.role),
                     "give /dev/stdout for the standard output");
    const auto clash = [&](const NamedFile& other, const char* rule) {
      return failure(ErrorCode::kUsage,
                     fmt::format("{} and {} are the same file, '{}'", file.role, other.role, file.path),
                     fmt::format("{}; give another name to {}", rule, file.role));
    };
    for (const NamedFile& input : inputs)
      if (same_file(file.path, input.path)) return clash(input, "no input is overwritten");
    for (const NamedFile& other : outputs.first(k))
      if (same_file(file.path, other.path)) return clash(other, "one output would overwrite the other");
  }
  for (const NamedFile& file : outputs)
    if (const auto good = check_place(file); !good) return good;
  return {};
}

}  // namespace meshgraft::cli
