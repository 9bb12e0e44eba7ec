#include "io/splice_text.hpp"

#include <algorithm>
#include <functional>

#include "io/unv_format.hpp"

namespace meshgraft::unv {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;  // bytes of made text after which a new block begins

}  // namespace

void TextPieces::settle() {
  if (!open_) return;
  if (!blocks_.back().empty()) pieces_.push_back(blocks_.back());
  open_ = false;
}

void TextPieces::add_span(std::string_view span) {
  if (span.empty()) return;
  settle();
  if (!pieces_.empty() && pieces_.back().data() + pieces_.back().size() == span.data())
    pieces_.back() = {pieces_.back().data(), pieces_.back().size() + span.size()};
  else
    pieces_.push_back(span);
}

std::string& TextPieces::made() {
  if (open_ && blocks_.back().size() >= kBlock) settle();
  if (!open_) blocks_.emplace_back(), open_ = true;
  return blocks_.back();
}

void TextPieces::end_line(std::string_view line_end) {
  if (open_ && !blocks_.back().empty()) {
    if (!blocks_.back().ends_with(line_end)) blocks_.back() += line_end;
  } else if (!pieces_.empty() && !pieces_.back().ends_with(line_end)) {
    made() += line_end;
  }
}

void TextPieces::keep(TextPieces other) {
  for (auto& blocks : other.kept_) kept_.push_back(std::move(blocks));
  kept_.push_back(std::move(other.blocks_));
}

const std::vector<std::string_view>& TextPieces::pieces() {
  settle();
  return pieces_;
}

void TextEdits::cut(std::size_t begin, std::size_t end) {
  if (!edits_.empty() && edits_.back().text == kNoText && edits_.back().end == begin)
    edits_.back().end = end;
  else
    edits_.push_back({begin, end, kNoText});
}

void TextEdits::replace(std::size_t begin, std::size_t end, TextPieces text) {
  edits_.push_back({begin, end, texts_.size()});
  texts_.push_back(std::move(text));
}

TextEdits::Output TextEdits::apply(std::string_view base) {
  // A cut that begins where something is inserted comes after it: what is inserted belongs to the
  // text in front.
  std::ranges::stable_sort(edits_, [](const Edit& a, const Edit& b) {
    return a.begin != b.begin ? a.begin < b.begin : (a.begin == a.end && b.begin != b.end);
  });
  Output output;
  std::size_t at = 0;
  for (const Edit& edit : edits_) {
    if (edit.begin > at) output.pieces.push_back(base.substr(at, edit.begin - at));
    if (edit.text != kNoText) {
      const auto& pieces = texts_[edit.text].pieces();
      output.pieces.insert(output.pieces.end(), pieces.begin(), pieces.end());
    }
    at = std::max(at, edit.end);
  }
  output.pieces.push_back(base.substr(at));
  const std::less_equal<const char*> in_order;
  for (const std::string_view piece : output.pieces)
    if (in_order(base.data(), piece.data()) && in_order(piece.data() + piece.size(), base.data() + base.size()))
      output.untouched += piece.size();
  return output;
}

void set_column(std::string& line, std::size_t index, std::int64_t value) {
  if (line.size() < (index + 1) * kIntegerWidth) line.resize((index + 1) * kIntegerWidth, ' ');
  const IntegerField field(value);
  line.replace(index * kIntegerWidth, kIntegerWidth, field.text());
}

void append_lines(const LineScanner& lines, std::size_t begin, std::size_t end, std::string_view line_end,
                  std::string& out) {
  while (begin < end) {
    const Line line = lines.at(begin, end);
    out += lines.view(line);
    out += line_end;
    begin = line.next;
  }
}

}  // namespace meshgraft::unv
