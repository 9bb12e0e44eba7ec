// Finds the lines between datasets without looking at every line of a large file (unv.md 6, rules 2 to 4).
#pragma once

#include <cstddef>
#include <vector>

#include "io/unv_document.hpp"

namespace meshgraft::unv {

/// Delimiter lines one after the other, searched for in ever larger windows: the datasets may be passed over.
class Delimiters {
 public:
  /// `document`: with its line ends and its delimiter.
  explicit Delimiters(const Document& document) : d_(document) {}

  /// Offset of the first delimiter line at or after `at`; the size of the text if there is none. Inside binary data
  /// there may be false ones. Calls with ascending `at` look at each character once.
  [[nodiscard]] std::size_t next(std::size_t at);

 private:
  void look_through(std::size_t begin);

  const Document& d_;
  std::size_t begin_ = 0, end_ = 0;  // the window: the lines that follow the line ends in [begin_, end_)
  std::vector<std::size_t> found_;   // in the window, ascending
};

/// End of the records of nodes or elements at the beginning of a dataset that seem to be alike: their lines end where
/// those of the first do, and say the same behind the label, as far as a few of them, about as many as a search by
/// halves needs, were looked at. `dataset.body` if it is not worth while.
///
/// This is a guess. It is right if the records can be read without a fault, because no line of a record reads like a
/// delimiter; after a fault all lines must be looked at.
[[nodiscard]] std::size_t end_of_like_records(const Document& document, const Dataset& dataset);

}  // namespace meshgraft::unv
