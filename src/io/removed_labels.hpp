// Labels of what a merge removes, as entries of groups are compared with them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "io/unv_groups.hpp"
#include "io/unv_numbers.hpp"

namespace meshgraft::unv {

/// A set of labels that is asked far more often than it has members.
class LabelSet {
 public:
  explicit LabelSet(std::vector<std::int64_t> labels = {}) : labels_(std::move(labels)) {
    if (labels_.empty()) return;
    std::ranges::sort(labels_);
    const auto range = static_cast<std::uint64_t>(labels_.back()) - static_cast<std::uint64_t>(labels_.front());
    if (range >= kMostBits) return;
    bits_.resize(range + 1);
    for (const std::int64_t label : labels_) bits_[static_cast<std::size_t>(label - labels_.front())] = true;
  }
  [[nodiscard]] bool contains(std::int64_t label) const {
    if (labels_.empty() || label < labels_.front() || label > labels_.back()) return false;
    return bits_.empty() ? std::ranges::binary_search(labels_, label)
                         : bits_[static_cast<std::size_t>(label - labels_.front())];
  }

 private:
  static constexpr std::uint64_t kMostBits = std::uint64_t{1} << 26;  // 8 MB
  std::vector<std::int64_t> labels_;                                  // ascending
  std::vector<bool> bits_;                                            // from the first label on; empty if too many
};

/// Labels of removed entities of one input.
struct Removed {
  LabelSet nodes, elements;
  /// The set for entities of a code, null if none of these is ever removed.
  [[nodiscard]] const LabelSet* of(std::int64_t code) const {
    return code == kNodeCode ? &nodes : code == kElementCode ? &elements : nullptr;
  }
  [[nodiscard]] bool contains(const Entity& e) const {
    const LabelSet* labels = of(e.code);
    return labels != nullptr && labels->contains(e.tag);
  }
};

/// The same for entities in columns, of which most have the code of the one before.
class RemovedColumns {
 public:
  explicit RemovedColumns(const Removed& removed) : removed_(removed) {}
  bool contain(const char* columns) {
    if (like_ == nullptr || !same_fields(columns, like_)) {
      std::int64_t code = 0;
      fast_integer(columns, code);
      like_ = columns, labels_ = removed_.of(code);
    }
    std::int64_t tag = 0;
    return labels_ != nullptr && fast_integer(columns + kIntegerWidth, tag) && labels_->contains(tag);
  }

 private:
  const Removed& removed_;
  const char* like_ = nullptr;  // columns of an entity with this code
  const LabelSet* labels_ = nullptr;
};

}  // namespace meshgraft::unv
