// Memory for arrays with a value for each node or element of a large model.
#pragma once

#include <tbb/parallel_invoke.h>

#include <cstddef>
#include <vector>

namespace meshgraft {

/// Asks the system for the memory of a block that is about to be filled for the first time, in large pages and at
/// once; small blocks stay as they are. It may decline.
void prepare_pages(void* begin, std::size_t n_bytes);

/// Reserves memory for `n` values. The first touch of each page would be a tenth of the time of reading a model, and
/// half of that of copying one.
template <class T>
void make_room(std::vector<T>& values, std::size_t n) {
  if (n <= values.capacity()) return;
  values.reserve(n);
  T* const fresh = values.data() + values.size();
  prepare_pages(fresh, (values.capacity() - values.size()) * sizeof(T));
}

/// Arrays of `n` values each, all at the same time: to write the first value of each page takes long.
template <class... Ts>
void resize_all(std::size_t n, std::vector<Ts>&... values) {
  tbb::parallel_invoke([&] { make_room(values, n), values.resize(n); }...);
}

}  // namespace meshgraft
