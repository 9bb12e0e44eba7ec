#include "io/splice_context.hpp"

namespace meshgraft::unv {
namespace {

/// Where something put at `offset` of the base must first end the line before it.
bool breaks_line(const Document& base, std::size_t offset) {
  return offset > base.first && base.lines.text[offset - 1] != base.lines.terminator;
}

}  // namespace

const Dataset* Splice::last_dataset(DatasetKind kind) const {
  const Dataset* last = nullptr;
  for (const Dataset& dataset : base().datasets)
    if (dataset.kind() == kind) last = &dataset;
  return last;
}

void Splice::close_dataset(std::string& text) const {
  text += base().delimiter.empty() ? std::string_view("    -1") : std::string_view(base().delimiter);
  text += line_end();
}

void Splice::open_dataset(std::int64_t number, std::string& text) const {
  constexpr std::size_t kNumberColumns = 6;
  close_dataset(text);  // both delimiters look the same
  const std::string digits = std::to_string(number);
  text.append(kNumberColumns - std::min(kNumberColumns, digits.size()), ' ');
  text += digits;
  text += line_end();
}

void Splice::insert_records(const Dataset& dataset, TextPieces records) {
  if (records.empty()) return;
  TextPieces text;
  if (breaks_line(base(), dataset.body_end)) text.made() += line_end();
  for (const std::string_view piece : records.pieces()) text.add_span(piece);
  text.keep(std::move(records));
  edits.replace(dataset.body_end, dataset.body_end, std::move(text));
}

void Splice::insert_dataset(const Dataset* after, std::int64_t number, TextPieces records) {
  if (records.empty()) return;
  TextPieces text;
  open_dataset(number, text.made());
  for (const std::string_view piece : records.pieces()) text.add_span(piece);
  text.end_line(line_end());
  close_dataset(text.made());
  text.keep(std::move(records));
  insert_datasets(after, std::move(text));
}

void Splice::append_text(TextPieces datasets) {
  if (!datasets.empty()) insert_datasets(nullptr, std::move(datasets));
}

void Splice::close_last_dataset() {
  if (base().datasets.empty()) return;
  const Dataset& last = base().datasets.back();
  if (!last.closed && !closed_[last.open]) insert_datasets(nullptr, {});
}

void Splice::insert_datasets(const Dataset* after, TextPieces datasets) {
  const std::size_t end = base().lines.text.size();
  const std::size_t offset = after != nullptr ? after->end : end;
  if (after == nullptr && !base().datasets.empty() && base().datasets.back().end == end)
    after = &base().datasets.back();
  TextPieces text;
  if (breaks_line(base(), offset)) text.made() += line_end();
  if (after != nullptr && !after->closed) {
    if (!std::exchange(closed_[after->open], true)) close_dataset(text.made());
  }
  for (const std::string_view piece : datasets.pieces()) text.add_span(piece);
  text.keep(std::move(datasets));
  edits.replace(offset, offset, std::move(text));
}

}  // namespace meshgraft::unv
