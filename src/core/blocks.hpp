// Parallel passes over long arrays whose result does not depend on the number of threads.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "meshgraft/vec3.hpp"

namespace meshgraft {

inline constexpr std::size_t kBlock = 16384;  // for passes that cost little per item
inline constexpr std::size_t kRun = 64;       // a word of a bit set
static_assert(kBlock % kRun == 0, "no run lies in two blocks");

/// Calls f(first, last) for consecutive blocks of 0 to n, in any order and at the same time.
template <class F>
void for_blocks(std::size_t n, F&& f, std::size_t block = kBlock) {
  if (n == 0) return;
  tbb::parallel_for(std::size_t{0}, (n + block - 1) / block,
                    [&](std::size_t b) { f(b * block, std::min(n, (b + 1) * block)); });
}

/// Calls f(first, last, box) for consecutive runs of first to last - 1, with the box around all box_of(i). What
/// follows each other in a file mostly lies together: a run that is far away from something is done with at once.
template <class BoxOf, class F>
void for_runs(std::size_t first, std::size_t last, BoxOf&& box_of, F&& f) {
  for (; first < last; first += kRun) {
    const std::size_t end = std::min(last, first + kRun);
    Box box;
    for (std::size_t i = first; i < end; ++i)
      if (const Box own = box_of(i); !own.empty()) box.add(own);
    f(first, end, box);
  }
}

/// What f(first, last, out) appends to the vector `out`, for the blocks of 0 to n in this order.
template <class T, class F>
std::vector<T> collected_by_block(std::size_t n, F&& f, std::size_t block = kBlock) {
  std::vector<std::vector<T>> found((n + block - 1) / block);
  for_blocks(
      n, [&](std::size_t first, std::size_t last) { f(first, last, found[first / block]); }, block);
  std::vector<T> all;
  std::size_t n_found = 0;
  for (const auto& part : found) n_found += part.size();
  all.reserve(n_found);
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// What f(i, out) appends, for i = 0 to n - 1 in this order.
template <class T, class F>
std::vector<T> collected(std::size_t n, F&& f, std::size_t block = kBlock) {
  return collected_by_block<T>(
      n,
      [&](std::size_t first, std::size_t last, std::vector<T>& out) {
        for (std::size_t i = first; i < last; ++i) f(i, out);
      },
      block);
}

/// The same without the runs for which near(first, last, box) is false.
template <class T, class BoxOf, class Near, class F>
std::vector<T> collected_near(std::size_t n, BoxOf&& box_of, Near&& near, F&& f, std::size_t block = kBlock) {
  return collected_by_block<T>(
      n,
      [&](std::size_t first_of_block, std::size_t last_of_block, std::vector<T>& out) {
        for_runs(first_of_block, last_of_block, box_of, [&](std::size_t first, std::size_t last, const Box& run) {
          if (!near(first, last, run)) return;
          for (std::size_t i = first; i < last; ++i) f(i, out);
        });
      },
      block);
}

}  // namespace meshgraft
