// An output text put together from spans of the inputs and of text made for it.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "io/unv_document.hpp"

namespace meshgraft::unv {

/// Pieces of text in order; neighbours in memory become one. Made text is kept in blocks.
class TextPieces {
 public:
  void add_span(std::string_view span);
  /// Returns a string to append to; what is appended comes after everything added so far.
  std::string& made();
  /// Makes sure that the next record begins on a line of its own.
  void end_line(std::string_view line_end);

  /// Takes over the made text of `other`, of which pieces were added here as spans.
  void keep(TextPieces other);

  [[nodiscard]] bool empty() const { return pieces_.empty() && blocks_.empty(); }
  /// The pieces; they live as long as this object and the inputs.
  [[nodiscard]] const std::vector<std::string_view>& pieces();

 private:
  void settle();

  std::vector<std::string_view> pieces_;
  std::deque<std::string> blocks_;
  std::vector<std::deque<std::string>> kept_;
  bool open_ = false;  // blocks_.back() is being appended to and is not in pieces_ yet
};

/// Replaces parts of a text; what no edit names is copied in spans.
class TextEdits {
 public:
  /// [begin, end) goes away.
  void cut(std::size_t begin, std::size_t end);
  /// [begin, end) is replaced; insertions (begin == end) at one place keep their order.
  void replace(std::size_t begin, std::size_t end, TextPieces text);
  [[nodiscard]] bool empty() const { return edits_.empty(); }

  struct Output {
    std::vector<std::string_view> pieces;
    std::size_t untouched = 0;  // bytes copied from `base`
  };
  [[nodiscard]] Output apply(std::string_view base);

 private:
  struct Edit {
    std::size_t begin, end, text;  // text: position in texts_, or kNoText
  };
  static constexpr std::size_t kNoText = static_cast<std::size_t>(-1);
  std::vector<Edit> edits_;
  std::deque<TextPieces> texts_;
};

/// Overwrites the `index`-th field of ten columns of a line.
void set_column(std::string& line, std::size_t index, std::int64_t value);

/// The lines of `text` with other line ends, appended to `out`.
void append_lines(const LineScanner& lines, std::size_t begin, std::size_t end, std::string_view line_end,
                  std::string& out);

}  // namespace meshgraft::unv
