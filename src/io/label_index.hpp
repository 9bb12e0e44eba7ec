// From label to position.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshgraft/id.hpp"

namespace meshgraft {

/// Finds the position of a label in an array of labels. Labels without gaps need no memory, dense
/// ones a direct table (4 bytes per label of the range), sparse ones a hash table of 8 to 16 bytes
/// per label; memory never depends on the largest label. The array must outlive the index.
class LabelIndex {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  /// A later position whose label is already at an earlier one.
  struct Duplicate {
    std::uint32_t first, later;
  };

  LabelIndex() = default;
  /// Cost O(n). Of equal labels the first is found; the others are in duplicates(), ascending.
  explicit LabelIndex(std::span<const std::int64_t> labels);

  [[nodiscard]] std::uint32_t find(std::int64_t label) const {
    const auto offset = static_cast<std::uint64_t>(label) - static_cast<std::uint64_t>(lowest_);
    switch (form_) {
      case Form::kConsecutive:
        return offset < labels_.size() ? static_cast<std::uint32_t>(offset) : kNone;
      case Form::kDirect:
        return offset < table_.size() ? table_[offset] : kNone;
      case Form::kHash:
        return table_[slot(label)];
    }
    return kNone;
  }
  [[nodiscard]] bool contains(std::int64_t label) const { return find(label) != kNone; }
  /// 0 without labels.
  [[nodiscard]] std::int64_t largest() const { return largest_; }
  [[nodiscard]] const std::vector<Duplicate>& duplicates() const { return duplicates_; }

 private:
  enum class Form : std::uint8_t { kConsecutive, kDirect, kHash };

  void put(std::uint32_t& entry, std::uint32_t position);
  [[nodiscard]] std::size_t slot(std::int64_t label) const;

  Form form_ = Form::kConsecutive;
  std::int64_t lowest_ = 0, largest_ = 0;
  std::span<const std::int64_t> labels_;
  std::vector<std::uint32_t> table_;
  std::vector<Duplicate> duplicates_;
};

}  // namespace meshgraft
