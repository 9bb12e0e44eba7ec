// Which of its operations the program runs.
#pragma once

#include <cstdint>

namespace meshgraft {

/// Advice differs; and the faces of a filling replace nothing: they are in the groups that all faces around share.
enum class OperationKind : std::uint8_t { kMerge, kCut, kFill };

/// What a user can do about a place that is wrong.
[[nodiscard]] inline const char* hint_for_place(OperationKind kind) {
  switch (kind) {
    case OperationKind::kMerge:
      return "look at the place in both inputs, and try another --tolerance, --size or --bandwidth";
    case OperationKind::kCut:
      return "look at the place in the input; move the tool a little, or try another --tolerance, --size or "
             "--bandwidth";
    case OperationKind::kFill:
      return "look at the place in the input, and try another --size or --blend";
  }
  return "";
}

}  // namespace meshgraft
