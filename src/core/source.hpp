// The text a model was read from.
#pragma once

#include <cstdint>
#include <string_view>

namespace meshgraft {

/// Bytes that live as long as the object; formats derive their own document from it.
class Source {
 public:
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  virtual ~Source() = default;
  [[nodiscard]] virtual std::string_view text() const = 0;
  /// 1-based line of a byte offset.
  [[nodiscard]] virtual std::uint64_t line_of(std::uint64_t offset) const = 0;
};

}  // namespace meshgraft
