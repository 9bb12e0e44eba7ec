// Numbers and records as text, in Fortran columns (unv.md 7).
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "io/unv_groups.hpp"
#include "io/unv_numbers.hpp"
#include "meshgraft/vec3.hpp"

namespace meshgraft::unv {

inline constexpr std::int64_t kLargestLabel = 9'999'999'999;  // fits in ten columns

/// I10; wider if the number does not fit.
class IntegerField {
 public:
  explicit IntegerField(std::int64_t value) {
    std::uint64_t rest = value < 0 ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
    do characters_[--first_] = static_cast<char>('0' + rest % 10);
    while ((rest /= 10) > 0);
    if (value < 0) characters_[--first_] = '-';
    while (first_ > characters_.size() - kIntegerWidth) characters_[--first_] = ' ';
  }
  [[nodiscard]] std::string_view text() const { return {characters_.data() + first_, characters_.size() - first_}; }

 private:
  std::array<char, 20> characters_;  // filled from the end; room for any number
  std::size_t first_ = characters_.size();
};

inline void append_integer(std::int64_t value, std::string& text) { text += IntegerField(value).text(); }

/// 1P1D25.16: 17 significant digits, which read back to the same bits. Values nearer to zero than
/// 1e-99, which would need a third digit of the exponent, are written as zero.
inline void append_real(double value, char exponent_letter, std::string& text) {
  constexpr double kSmallest = 1e-99;
  constexpr int kFraction = 16;
  if (std::fabs(value) < kSmallest) value = 0;
  std::array<char, 32> digits;
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::scientific, kFraction).ptr;
  const auto n = static_cast<std::size_t>(end - digits.data());
  const std::size_t begin = text.size() + kRealWidth - n;
  text.append(kRealWidth - n, ' ');
  text.append(digits.data(), n);
  text[text.find('e', begin)] = exponent_letter;
}

inline void append_point(Vec3 p, char exponent_letter, std::string_view line_end, std::string& text) {
  for (std::size_t axis = 0; axis < 3; ++axis) append_real(p[axis], exponent_letter, text);
  text += line_end;
}

/// Integers, at most `per_line` in a line.
inline void append_integers(std::span<const std::int64_t> values, std::string_view line_end, std::string& text,
                            std::size_t per_line = 8) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    append_integer(values[k], text);
    if ((k + 1) % per_line == 0 || k + 1 == values.size()) text += line_end;
  }
}

/// Writes entities of a group in full lines.
class EntityWriter {
 public:
  EntityWriter(GroupLayout layout, std::string_view line_end, std::string& text)
      : layout_(layout), per_line_(entities_per_line(layout)), line_end_(line_end), text_(text) {}
  void add(const Entity& e) {
    append_integer(e.code, text_), append_integer(e.tag, text_);
    if (layout_.entity_size == 4) append_integer(e.leaf, text_), append_integer(e.component, text_);
    end_entity();
  }
  /// An entity as it stands in the columns of another file of the same layout.
  void add_columns(std::string_view columns) {
    text_ += columns;
    end_entity();
  }
  void finish() {
    if (in_line_ > 0) text_ += line_end_, in_line_ = 0;
  }

 private:
  void end_entity() {
    if (++in_line_ == per_line_) finish();
  }
  GroupLayout layout_;
  std::size_t per_line_, in_line_ = 0;
  std::string_view line_end_;
  std::string& text_;
};

}  // namespace meshgraft::unv
