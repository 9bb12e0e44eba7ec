// Lines of a text that stays where it is.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace meshgraft {

/// Offsets: the content is [begin, end), the next line begins at `next`.
struct Line {
  std::size_t begin = 0, end = 0, next = 0;
};

/// Splits at `terminator`; a CR before an LF belongs to the line end.
struct LineScanner {
  std::string_view text;
  char terminator = '\n';

  /// The line that begins at `begin` (< text.size()); nothing at or after `limit` belongs to it.
  [[nodiscard]] Line at(std::size_t begin, std::size_t limit = std::string_view::npos) const {
    if (limit > text.size()) limit = text.size();
    const void* found = std::memchr(text.data() + begin, terminator, limit - begin);
    if (found == nullptr) return {begin, without_return(begin, limit), limit};
    const auto end = static_cast<std::size_t>(static_cast<const char*>(found) - text.data());
    return {begin, without_return(begin, end), end + 1};
  }
  [[nodiscard]] std::string_view view(const Line& line) const { return text.substr(line.begin, line.end - line.begin); }

 private:
  [[nodiscard]] std::size_t without_return(std::size_t begin, std::size_t end) const {
    return terminator == '\n' && end > begin && text[end - 1] == '\r' ? end - 1 : end;
  }
};

/// How often `c` occurs. Counts in many narrow counters, which compilers turn into vector code.
inline std::size_t count_of(char c, std::string_view text) {
  constexpr std::size_t kLanes = 64, kRows = 255;
  std::size_t total = 0;
  while (text.size() >= kLanes) {
    std::array<std::uint8_t, kLanes> count{};
    const std::size_t rows = std::min(text.size() / kLanes, kRows);
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t k = 0; k < kLanes; ++k)
        count[k] = static_cast<std::uint8_t>(count[k] + (text[row * kLanes + k] == c ? 1 : 0));
    for (const std::uint8_t n : count) total += n;
    text.remove_prefix(rows * kLanes);
  }
  return total + static_cast<std::size_t>(std::count(text.begin(), text.end(), c));
}

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }

inline std::string_view right_trimmed(std::string_view s) {
  while (!s.empty() && is_blank(s.back())) s.remove_suffix(1);
  return s;
}

inline std::string_view trimmed(std::string_view s) {
  s = right_trimmed(s);
  while (!s.empty() && is_blank(s.front())) s.remove_prefix(1);
  return s;
}

/// Calls f(token) for each run of non-blanks; stops when f returns false.
template <class F>
void for_each_token(std::string_view s, F&& f) {
  std::size_t i = 0;
  for (;;) {
    while (i < s.size() && is_blank(s[i])) ++i;
    if (i == s.size()) return;
    std::size_t end = i;
    while (end < s.size() && !is_blank(s[end])) ++end;
    if (!f(s.substr(i, end - i))) return;
    i = end;
  }
}

}  // namespace meshgraft
