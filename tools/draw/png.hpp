// Portable Network Graphics, 8 bits per channel.
#pragma once

#include <string>

#include "render.hpp"

namespace meshgraft::draw {

/// The bytes of a PNG file.
[[nodiscard]] std::string png(const Image& image);

}  // namespace meshgraft::draw
