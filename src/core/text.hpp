// Numbers and places in messages.
#pragma once

#include <string>

#include "meshgraft/vec3.hpp"

namespace meshgraft {

/// "1.5e-05", six digits.
[[nodiscard]] std::string text_of(double value);

/// "(1.5, 0.25, 3)", six digits.
[[nodiscard]] std::string text_of(Vec3 p);

}  // namespace meshgraft
