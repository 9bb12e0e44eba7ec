// Sets of positions.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meshgraft {

/// A set of positions below n.
class Bits {
 public:
  explicit Bits(std::size_t n) : words_((n + 63) / 64) {}
  [[nodiscard]] bool operator[](std::size_t i) const { return words_[i / 64] >> (i % 64) & 1; }
  void set(std::size_t i) { words_[i / 64] |= std::uint64_t{1} << (i % 64); }
  /// Calls f(i) for each position in the set, ascending.
  template <class F>
  void each(F&& f) const {
    for (std::size_t w = 0; w < words_.size(); ++w)
      for (std::uint64_t rest = words_[w]; rest != 0; rest &= rest - 1)
        f(64 * w + static_cast<std::size_t>(std::countr_zero(rest)));
  }

  /// To be called before rank(), once the set is complete.
  void count() {
    before_.assign(words_.size(), 0);
    for (std::size_t w = 1; w < words_.size(); ++w)
      before_[w] = before_[w - 1] + static_cast<std::uint32_t>(std::popcount(words_[w - 1]));
  }
  /// How many positions of the set are less than i.
  [[nodiscard]] std::size_t rank(std::size_t i) const {
    const std::uint64_t below = words_[i / 64] & ((std::uint64_t{1} << (i % 64)) - 1);
    return before_[i / 64] + static_cast<std::size_t>(std::popcount(below));
  }

 private:
  std::vector<std::uint64_t> words_;
  std::vector<std::uint32_t> before_;  // by word: positions in the words before it
};

}  // namespace meshgraft
