// Sets that grow together.
#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace meshgraft {

/// n items, each in a set of its own at first. The name of a set is its smallest item, so that it does
/// not depend on the order of the unions. Cost: nearly constant for each call.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : up_(n) { std::iota(up_.begin(), up_.end(), 0u); }

  [[nodiscard]] std::uint32_t find(std::uint32_t i) {
    while (up_[i] != i) i = up_[i] = up_[up_[i]];
    return i;
  }
  void unite(std::uint32_t i, std::uint32_t j) {
    i = find(i), j = find(j);
    if (i > j) std::swap(i, j);
    up_[j] = i;
  }

 private:
  std::vector<std::uint32_t> up_;  // by item: one of its set, smaller unless it is the smallest
};

}  // namespace meshgraft
