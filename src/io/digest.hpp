// What the report says about an input.
#pragma once

#include <string>
#include <string_view>

#include "meshgraft/model.hpp"
#include "meshgraft/report.hpp"

namespace meshgraft {

/// SHA-256 in hexadecimal.
[[nodiscard]] std::string sha256(std::string_view bytes);

/// Path, digest and size of the source (both empty without one), and counts.
[[nodiscard]] InputSummary input_summary(const Model& model);

}  // namespace meshgraft
