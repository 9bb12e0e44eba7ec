// Parallel passes over long arrays whose result does not depend on the number of threads.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace meshgraft {

inline constexpr std::size_t kBlock = 16384;  // a multiple of 64: blocks share no word of a bit set

/// Calls f(first, last) for consecutive blocks of 0 to n, in any order and at the same time.
template <class F>
void for_blocks(std::size_t n, F&& f) {
  if (n == 0) return;
  tbb::parallel_for(std::size_t{0}, (n + kBlock - 1) / kBlock,
                    [&](std::size_t b) { f(b * kBlock, std::min(n, (b + 1) * kBlock)); });
}

/// What f(i, out) appends to the vector `out`, for i = 0 to n - 1 in this order.
template <class T, class F>
std::vector<T> collected(std::size_t n, F&& f) {
  std::vector<std::vector<T>> found((n + kBlock - 1) / kBlock);
  for_blocks(n, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) f(i, found[first / kBlock]);
  });
  std::vector<T> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace meshgraft
