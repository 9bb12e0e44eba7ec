// Lists that are short nearly always.
#pragma once

#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <span>

namespace meshgraft {

/// A vector that needs no allocation for up to `kUsual` entries.
template <class T, std::size_t kUsual>
class Few : public boost::container::small_vector<T, kUsual> {
 public:
  using boost::container::small_vector<T, kUsual>::small_vector;
  operator std::span<const T>() const { return {this->data(), this->size()}; }
};

}  // namespace meshgraft
