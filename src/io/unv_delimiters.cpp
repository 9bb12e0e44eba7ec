#include "io/unv_delimiters.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <string>

#include "io/unv_elements.hpp"
#include "io/unv_nodes.hpp"
#include "io/unv_numbers.hpp"

namespace meshgraft::unv {
namespace {

constexpr std::size_t kScanPiece = std::size_t{4} << 20;  // bytes looked through by one task
constexpr std::size_t kFirstWindow = std::size_t{1} << 16, kGrowth = 4, kLargestWindow = std::size_t{1} << 27;

/// First offset >= `at` and < `last` at which `pattern` begins, or `last`. The last two characters of a
/// delimiter, and the end of the line before it, are rare together: blocks are passed over by these alone, which
/// compilers turn into vector code, several times as fast as going from line to line.
std::size_t find_rare(std::string_view text, std::string_view pattern, std::size_t at, std::size_t last) {
  constexpr std::size_t kBlock = 256;
  const std::size_t n = pattern.size();
  const char front = pattern.front(), next_to_last = pattern[n - 2], back = pattern.back();
  const std::size_t end = std::min(last, text.size() >= n ? text.size() - n + 1 : 0);
  for (; at + kBlock <= end; at += kBlock) {
    const char* begin = text.data() + at;
    unsigned char any = 0;
    for (std::size_t k = 0; k < kBlock; ++k)
      any = static_cast<unsigned char>(any | static_cast<unsigned char>((begin[k] == front) &
                                                                        (begin[k + n - 2] == next_to_last) &
                                                                        (begin[k + n - 1] == back)));
    if (any == 0) continue;
    for (std::size_t k = 0; k < kBlock; ++k)
      if (text.compare(at + k, n, pattern) == 0) return at + k;
  }
  for (; at < end; ++at)
    if (text.compare(at, n, pattern) == 0) return at;
  return last;
}

/// End of the record of nodes or elements at `begin`, or `begin`.
std::size_t record_end(const Document& d, const Dataset& dataset, std::size_t begin) {
  const std::size_t size = d.lines.text.size();
  std::size_t end = begin;
  if (dataset.kind() == DatasetKind::kNodes) {
    std::vector<std::int64_t> scratch;
    if (const auto record = node_record(d.lines, begin, size, node_layout_of(dataset.number), scratch))
      end = record->end;
  } else {
    ElementRecord record;
    if (!element_record(d.lines, begin, size, element_layout_of(dataset.number), record)) end = record.end;
  }
  for (std::size_t at = begin; at < end;) {
    const Line line = d.lines.at(at);
    if (d.is_delimiter(line)) return begin;
    at = line.next;
  }
  return end;
}

/// End of the records like the one in [begin, end): goes ahead in steps that double while they hit such a record, and
/// halves the last one.
std::size_t end_of_run(std::string_view text, char terminator, std::size_t begin, std::size_t end) {
  const std::size_t length = end - begin, most = (text.size() - begin) / length;
  std::vector<std::size_t> line_ends;
  for (std::size_t at = begin; at < end; ++at)
    if (text[at] == terminator) line_ends.push_back(at);
  if (line_ends.empty()) return end;
  // What the first line says behind the label: kind and properties.
  const std::string_view head = text.substr(begin, line_ends.front() - begin);
  const std::size_t tail = std::min(kIntegerWidth, head.size());
  const auto is_like = [&](std::size_t k) {
    return std::ranges::all_of(line_ends, [&](std::size_t at) { return text[at + k * length] == terminator; }) &&
           text.substr(begin + k * length, head.size()).substr(tail) == head.substr(tail);
  };
  std::size_t like = 0, other = 1;
  while (other < most && is_like(other)) like = other, other *= 2;
  other = std::min(other, most);
  while (other - like > 1) {
    const std::size_t middle = (like + other) / 2;
    (is_like(middle) ? like : other) = middle;
  }
  return begin + (like + 1) * length;
}

}  // namespace

std::size_t Delimiters::next(std::size_t at) {
  const std::string_view text = d_.lines.text;
  if (at <= d_.first && d_.first < text.size() && d_.is_delimiter(d_.lines.at(d_.first))) return d_.first;
  at = std::max(at, d_.first + 1);
  for (;;) {
    if (at - 1 < begin_ || at - 1 >= end_) look_through(at - 1);
    const auto found = std::ranges::lower_bound(found_, at);
    if (found != found_.end()) return *found;
    if (end_ >= text.size()) return text.size();
    at = end_ + 1;
  }
}

void Delimiters::look_through(std::size_t begin) {
  const std::string_view text = d_.lines.text;
  const std::string pattern =
      d_.lines.terminator + (d_.delimiter.empty() ? std::string(kUsualDelimiter) : d_.delimiter);
  const bool goes_on = begin == end_ && begin > 0;
  const std::size_t size = goes_on ? std::min(kGrowth * (end_ - begin_), kLargestWindow) : kFirstWindow;
  begin_ = begin, end_ = std::min(begin + size, text.size());
  const std::size_t n = (end_ - begin_ + kScanPiece - 1) / kScanPiece;
  std::vector<std::vector<std::size_t>> found(n);
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t piece) {
    const std::size_t from = begin_ + piece * kScanPiece, last = std::min(from + kScanPiece, end_);
    for (std::size_t at = find_rare(text, pattern, from, last); at < last; at = find_rare(text, pattern, at + 1, last))
      if (d_.is_delimiter(d_.lines.at(at + 1))) found[piece].push_back(at + 1);
  });
  found_.clear();
  for (const auto& piece : found) found_.insert(found_.end(), piece.begin(), piece.end());
}

std::size_t end_of_like_records(const Document& d, const Dataset& dataset) {
  const bool has_records = dataset.kind() == DatasetKind::kNodes || dataset.kind() == DatasetKind::kElements;
  std::size_t at = dataset.body;
  while (has_records && at < d.lines.text.size()) {
    const std::size_t end = record_end(d, dataset, at);
    const std::size_t stop = end > at ? end_of_run(d.lines.text, d.lines.terminator, at, end) : at;
    const bool is_short = stop - at < kFirstWindow;
    at = stop;
    if (is_short) break;
  }
  return at;
}

}  // namespace meshgraft::unv
