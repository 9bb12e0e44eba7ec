// Checks of the files before any work is done.
#pragma once

#include <span>
#include <string>

#include "meshgraft/result.hpp"

namespace meshgraft::cli {

/// A file the user named, and what for.
struct NamedFile {
  std::string role;  // "-o", "--report", "BASE"
  std::string path;
};

/// Error kUsage if two inputs are one file (links are followed): what is wanted by that is not to be known.
[[nodiscard]] Result<void> check_inputs(std::span<const NamedFile> inputs);

/// Errors: kUsage if an output is an input or another output (links are followed), or `-`; kCannotWrite if
/// its directory does not exist or admits no new file, or if it is a directory or write-protected.
[[nodiscard]] Result<void> check_outputs(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs);

/// Whether writing to `path` makes a new file that takes the place of an old one. Devices and pipes are
/// written in place.
[[nodiscard]] bool is_replaced(const std::string& path);

/// Whether what is written to `path` goes where stdout goes, so that nothing else may be printed there.
[[nodiscard]] bool is_stdout(const std::string& path);

}  // namespace meshgraft::cli
