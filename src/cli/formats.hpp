// The table of file formats. Inputs are known by their content, outputs by their extension.
#pragma once

#include <string>

#include "meshgraft/result.hpp"

namespace meshgraft::cli {

/// Whether `path` can name an output: it has the extension of a format that is written, in any case,
/// or none. Errors: kUsage, naming the formats known.
[[nodiscard]] Result<void> writable_format(const std::string& path);

}  // namespace meshgraft::cli
