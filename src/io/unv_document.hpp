// A universal file as text: where its datasets and records are.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/source.hpp"
#include "io/line_scanner.hpp"
#include "io/mapped_file.hpp"
#include "meshgraft/id.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft::unv {

enum class DatasetKind : std::uint8_t { kOther, kNodes, kElements, kGroups };

[[nodiscard]] DatasetKind kind_of(std::int64_t number);

inline constexpr std::string_view kUsualDelimiter = "    -1";  // perhaps with blanks behind it

/// Byte offsets. A well-formed dataset is: delimiter at `open`, number line, records in
/// [body, body_end), delimiter, end.
struct Dataset {
  std::int64_t number = 0;
  bool binary = false;  // number followed by `b`
  bool closed = true;   // it has a closing delimiter of its own
  std::size_t open = 0, number_line = 0, body = 0, body_end = 0, end = 0;
  [[nodiscard]] DatasetKind kind() const { return binary ? DatasetKind::kOther : kind_of(number); }
};

/// Record 1 of a group has `header_fields` integers, the last one the number of entities; an entity
/// has `entity_size` integers, the first two its code and tag (unv.md 3.6).
struct GroupLayout {
  std::uint8_t header_fields = 8, entity_size = 4;
  friend bool operator==(GroupLayout, GroupLayout) = default;
};
[[nodiscard]] GroupLayout group_layout_of(std::int64_t dataset_number);

/// Where the records of one group are.
struct GroupPlace {
  std::size_t begin = 0, end = 0;
  std::uint32_t dataset = 0;
  GroupLayout layout;
  bool regular = false;  // all lines are full and in columns, see regular_group
};

/// A further record with the label of `kept`, which the model does not have twice.
struct DuplicateRecord {
  std::size_t begin;
  std::uint32_t kept;
};

inline constexpr const char* kExportAgain = "copy or export the file again";
inline constexpr const char* kLookHere = "if the file was edited here, undo that; else export it again";

/// A finding about the text; Document::error turns it into an Error.
struct Fault {
  ErrorCode code = ErrorCode::kMalformed;
  std::size_t offset = 0;
  std::string what, hint;
};

class Document final : public Source {
 public:
  Document(MappedFile file, std::string path);
  Document(std::string text, std::string path);

  [[nodiscard]] std::string_view text() const override { return text_; }
  [[nodiscard]] std::uint64_t line_of(std::uint64_t offset) const override;
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] Error error(const Fault& fault) const;
  [[nodiscard]] Warning warning(std::string name, std::string what, std::size_t offset) const;

  /// The part of the text that is read: without a byte order mark (`first`), trailing NULs and
  /// Ctrl-Z. Offsets count from the start of the whole text.
  LineScanner lines;
  std::size_t first = 0;
  std::string_view line_end = "\n";
  std::string delimiter;  // empty: columns 5-6; else the spelling learned from the first line

  /// Whether the line end of this file stands at `at`, which must leave room for it.
  [[nodiscard]] bool ends_line(std::size_t at) const {
    return lines.text[at] == line_end[0] && (line_end.size() == 1 || lines.text[at + 1] == line_end[1]);
  }
  [[nodiscard]] bool is_delimiter(const Line& line) const;

  /// Whether datasets were taken for longer than what was looked at, which holds if they can be read.
  bool passed_over = false;
  /// As before the datasets were looked for.
  void forget_datasets();

  std::vector<Dataset> datasets;                               // in file order
  std::vector<GroupPlace> groups;                              // by GroupId
  std::vector<DuplicateRecord> double_nodes, double_elements;  // ascending

  /// End of the record that begins at `places[i]`: the next record or the end of the dataset.
  [[nodiscard]] std::size_t record_end(const std::vector<std::uint64_t>& places, std::size_t i,
                                       const std::vector<DuplicateRecord>& doubles) const;
  /// The dataset that `offset` is in.
  [[nodiscard]] std::size_t dataset_at(std::size_t offset) const;

 private:
  void find_line_ends();

  std::unique_ptr<MappedFile> file_;
  std::string owned_;
  std::string_view text_;
  std::string path_;
  mutable std::mutex counting_;
  mutable std::vector<std::uint64_t> lines_before_;  // by block of the text, as far as it was asked for
};

}  // namespace meshgraft::unv
