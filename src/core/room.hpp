// Memory for arrays with a value for each node or element of a large model.
#pragma once

#include <tbb/parallel_invoke.h>

#include <cstddef>
#include <vector>

namespace meshgraft {

/// Asks the system for large pages for a block that is about to be filled for the first time; small blocks stay as
/// they are. It may decline.
void prefer_large_pages(void* begin, std::size_t n_bytes);

/// Reserves memory for `n` values. The first touch of each page is a tenth of the time of reading a model: with large
/// pages there are few.
template <class T>
void make_room(std::vector<T>& values, std::size_t n) {
  if (n <= values.capacity()) return;
  values.reserve(n);
  T* const fresh = values.data() + values.size();
  prefer_large_pages(fresh, (values.capacity() - values.size()) * sizeof(T));
}

/// Arrays of `n` values each, all at the same time: to write the first value of each page takes long.
template <class... Ts>
void resize_all(std::size_t n, std::vector<Ts>&... values) {
  tbb::parallel_invoke([&] { make_room(values, n), values.resize(n); }...);
}

}  // namespace meshgraft
