#include "core/text.hpp"

#include <array>
#include <cstdio>

namespace meshgraft {

std::string text_of(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

std::string text_of(Vec3 p) {
  const std::array<std::string, 3> c{text_of(p.x), text_of(p.y), text_of(p.z)};
  std::string text("(");
  return text.append(c[0]).append(", ").append(c[1]).append(", ").append(c[2]).append(")");
}

}  // namespace meshgraft
