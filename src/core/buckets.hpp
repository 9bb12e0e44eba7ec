// Items sorted by a small number, such as what is at each vertex.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace meshgraft {

/// One list of items for each key from 0 to n - 1, one after the other in an array.
template <class T>
class Buckets {
 public:
  Buckets() = default;
  /// Those that each_item(f) calls f(key, item) for, in the same order within each key. It is called twice: the items
  /// are counted first. Costs O(n) and two passes over the items.
  template <class EachItem>
  Buckets(std::size_t n, EachItem&& each_item) : first_(n + 1, 0) {
    each_item([&](std::size_t key, const T&) { ++first_[key + 1]; });
    for (std::size_t key = 0; key < n; ++key) first_[key + 1] += first_[key];
    items_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    each_item([&](std::size_t key, const T& item) { items_[next[key]++] = item; });
  }

  [[nodiscard]] std::size_t size() const { return first_.empty() ? 0 : first_.size() - 1; }
  /// Position in all() of the first item with a key that is not less.
  [[nodiscard]] std::uint32_t first(std::size_t key) const { return first_[key]; }
  [[nodiscard]] std::span<const T> operator[](std::size_t key) const {
    return std::span(items_).subspan(first_[key], first_[key + 1] - first_[key]);
  }
  [[nodiscard]] std::span<T> operator[](std::size_t key) {
    return std::span(items_).subspan(first_[key], first_[key + 1] - first_[key]);
  }
  [[nodiscard]] const std::vector<T>& all() const { return items_; }
  /// Leaves no list.
  [[nodiscard]] std::vector<T> take_all() && { return std::move(items_); }

 private:
  std::vector<std::uint32_t> first_;  // n + 1
  std::vector<T> items_;
};

}  // namespace meshgraft
