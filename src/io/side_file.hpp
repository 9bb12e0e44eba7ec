// The file beside the output of a merge: datasets of parts that could not go into the output.
#pragma once

#include <string>

namespace meshgraft {

/// First line of every side file. What does not begin with it is none of ours, and is neither removed nor replaced.
inline constexpr const char* kSideFileMark = "meshgraft side file: datasets of parts that could not go into the output";

/// OUT.carry beside the file that writing to OUT makes or replaces (see without_links).
[[nodiscard]] std::string side_path(const std::string& output);

/// Whether something has the name of the side file of `output` and is not one.
[[nodiscard]] bool is_side_path_taken(const std::string& output);

}  // namespace meshgraft
