// Cuts the records of a dataset into pieces of whole lines for parallel parsing.
#pragma once

#include <cstddef>
#include <vector>

#include "io/line_scanner.hpp"

namespace meshgraft::unv {

/// Size of a piece: large enough to amortise a task, small enough to balance the load. The pieces
/// depend on the text only, never on the number of threads.
inline constexpr std::size_t kPieceBytes = std::size_t{1} << 19;

/// Offsets of line starts, from `begin` to `end` (both included), about kPieceBytes apart.
[[nodiscard]] inline std::vector<std::size_t> piece_borders(const LineScanner& lines, std::size_t begin,
                                                            std::size_t end) {
  std::vector<std::size_t> borders{begin};
  while (borders.back() < end) {
    const std::size_t near = borders.back() + kPieceBytes;
    borders.push_back(near >= end ? end : lines.at(near, end).next);
  }
  return borders;
}

/// First line start at or after `begin` whose line is not blank; `limit` if there is none.
[[nodiscard]] inline std::size_t skip_blank_lines(const LineScanner& lines, std::size_t begin, std::size_t limit) {
  while (begin < limit) {
    const Line line = lines.at(begin, limit);
    if (!trimmed(lines.view(line)).empty()) return begin;
    begin = line.next;
  }
  return limit;
}

/// Lines that were not in columns, for one warning per dataset.
struct Irregular {
  std::size_t count = 0, first = 0;
  void add(std::size_t offset) {
    if (count++ == 0) first = offset;
  }
  void add(const Irregular& later) {
    if (count == 0) first = later.first;
    count += later.count;
  }
};

}  // namespace meshgraft::unv
