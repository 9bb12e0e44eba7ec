// Lists as sets.
#pragma once

#include <algorithm>
#include <vector>

namespace meshgraft {

/// Sorts a list and keeps one of each.
template <class T>
void make_distinct(std::vector<T>& list) {
  std::ranges::sort(list);
  const auto rest = std::ranges::unique(list);
  list.erase(rest.begin(), rest.end());
}

}  // namespace meshgraft
