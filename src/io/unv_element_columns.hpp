// Element records in the usual columns, read many times as fast as any record.
#pragma once

#include "io/unv_elements.hpp"

namespace meshgraft::unv {

/// Reads records of one dataset one after the other. Most headers repeat the one before but for the label: they
/// are compared, not read.
class ElementColumns {
 public:
  /// `limit`: the end of the dataset.
  ElementColumns(const Document& document, std::size_t limit, ElementLayout layout);

  /// The record at `begin`, which lives until the next call. Null if anything is unusual, or if what follows
  /// does not begin like a record: element_record can tell.
  [[nodiscard]] const ElementRecord* at(std::size_t begin);
  /// Whether the header of that record repeats the one before but for the label.
  [[nodiscard]] bool repeats() const { return repeats_; }

 private:
  bool read_header(std::size_t begin);
  /// A line of exactly `count` integers; `at` moves behind it.
  bool integers(std::size_t& at, std::int64_t* values, std::size_t count) const;
  [[nodiscard]] bool ends_line(std::size_t at, std::size_t width) const {
    return limit_ - at >= width + feed_ && d_.ends_line(at + width);
  }
  [[nodiscard]] bool begins_record(std::size_t at) const;

  const Document& d_;
  const char* text_;
  std::size_t limit_, feed_;
  std::size_t header_width_;
  ElementLayout layout_;
  const char* like_ = nullptr;  // the columns behind the label in the header of record_
  bool has_beam_ = false;       // after such a header
  bool repeats_ = false;
  ElementRecord record_;
};

}  // namespace meshgraft::unv
