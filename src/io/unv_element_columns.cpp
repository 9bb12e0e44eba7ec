#include "io/unv_element_columns.hpp"

#include <algorithm>

#include "io/unv_numbers.hpp"
#include "io/unv_types.hpp"

namespace meshgraft::unv {
namespace {

constexpr std::int64_t kMostNodes = 32;  // more are unusual
constexpr std::size_t kPerLine = 8;      // node labels

std::size_t beam_fields(ElementLayout layout) { return layout == ElementLayout::k780 ? 5 : 3; }

}  // namespace

ElementColumns::ElementColumns(const Document& document, std::size_t limit, ElementLayout layout)
    : d_(document),
      text_(document.lines.text.data()),
      limit_(limit),
      feed_(document.line_end.size()),
      header_width_(header_fields(layout) * kIntegerWidth),
      layout_(layout) {
  record_.header.resize(header_fields(layout));
}

const ElementRecord* ElementColumns::at(std::size_t begin) {
  if (!read_header(begin)) return nullptr;
  std::size_t at = begin + header_width_ + feed_;
  if (has_beam_) {
    record_.beam_line = at;
    if (!integers(at, record_.beam.data(), record_.beam.size())) return nullptr;
  }
  record_.node_lines = at;
  const std::size_t n = record_.nodes.size();
  for (std::size_t k = 0; k < n; k += kPerLine)
    if (!integers(at, record_.nodes.data() + k, std::min(kPerLine, n - k))) return nullptr;
  record_.end = at;
  return at == limit_ || begins_record(at) ? &record_ : nullptr;
}

bool ElementColumns::read_header(std::size_t begin) {
  if (!ends_line(begin, header_width_) || !fast_integer(text_ + begin, record_.header[0])) return false;
  const char* columns = text_ + begin + kIntegerWidth;  // behind the label
  repeats_ = like_ != nullptr && same_fields(columns, like_, record_.header.size() - 1);
  if (repeats_) return true;
  like_ = nullptr;
  for (std::size_t k = 1; k < record_.header.size(); ++k)
    if (!fast_integer(text_ + begin + k * kIntegerWidth, record_.header[k])) return false;
  const std::int64_t id = record_.header[1], n = record_.header.back();
  if (n < 1 || n > kMostNodes) return false;
  has_beam_ = layout_ != ElementLayout::k71 && has_beam_record(id);
  if (layout_ != ElementLayout::k71 && may_have_beam_record(id)) return false;
  record_.beam.resize(has_beam_ ? beam_fields(layout_) : 0);
  record_.nodes.resize(static_cast<std::size_t>(n));
  like_ = columns;
  return true;
}

bool ElementColumns::integers(std::size_t& at, std::int64_t* values, std::size_t count) const {
  const std::size_t width = count * kIntegerWidth;
  if (!ends_line(at, width)) return false;
  for (std::size_t k = 0; k < count; ++k)
    if (!fast_integer(text_ + at + k * kIntegerWidth, values[k])) return false;
  at += width + feed_;
  return true;
}

bool ElementColumns::begins_record(std::size_t at) const {
  return ends_line(at, header_width_) && text_[at + header_width_ - kIntegerWidth - 1] != ' ';
}

}  // namespace meshgraft::unv
