// One list behind another.
#pragma once

#include <iterator>
#include <vector>

namespace meshgraft {

/// Moves the items of `from` behind those of `to`.
template <class T>
void append(std::vector<T>& to, std::vector<T> from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

}  // namespace meshgraft
