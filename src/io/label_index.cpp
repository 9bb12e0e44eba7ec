#include "io/label_index.hpp"

#include <algorithm>
#include <atomic>
#include <bit>

#include "core/blocks.hpp"

namespace meshgraft {
namespace {

// A direct table is used while it has at most this many entries per label.
constexpr std::uint64_t kDirectEntriesPerLabel = 4;

bool consecutive(std::span<const std::int64_t> labels) {
  std::atomic<bool> good = true;
  for_blocks(labels.size() - 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last && good.load(std::memory_order_relaxed); ++i)
      if (labels[i + 1] - 1 != labels[i]) good = false;
  });
  return good;
}

}  // namespace

LabelIndex::LabelIndex(std::span<const std::int64_t> labels) : labels_(labels) {
  if (labels.empty()) return;
  lowest_ = labels.front(), largest_ = labels.back();
  if (consecutive(labels)) return;
  const auto [low, high] = std::ranges::minmax(labels);
  largest_ = high;
  const std::uint64_t range = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
  const auto n = static_cast<std::uint32_t>(labels.size());
  if (range < kDirectEntriesPerLabel * n) {
    form_ = Form::kDirect, lowest_ = low;
    table_.assign(range + 1, kNone);
    for (std::uint32_t i = 0; i < n; ++i) put(table_[static_cast<std::size_t>(labels[i] - low)], i);
    return;
  }
  form_ = Form::kHash;
  table_.assign(std::bit_ceil(std::size_t{2} * n), kNone);
  for (std::uint32_t i = 0; i < n; ++i) put(table_[slot(labels[i])], i);
}

void LabelIndex::put(std::uint32_t& entry, std::uint32_t position) {
  if (entry == kNone)
    entry = position;
  else
    duplicates_.push_back({entry, position});
}

std::size_t LabelIndex::slot(std::int64_t label) const {
  const std::size_t mask = table_.size() - 1;
  std::uint64_t h = static_cast<std::uint64_t>(label) * 0x9E3779B97F4A7C15ull;  // Fibonacci hashing
  for (std::size_t i = (h ^ (h >> 32)) & mask;; i = (i + 1) & mask)
    if (table_[i] == kNone || labels_[table_[i]] == label) return i;
}

}  // namespace meshgraft
