// From the faces of a corefined complex back to those before it.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/complex.hpp"

namespace meshgraft {

/// Finds the face of the complex before corefinement that a face descends from.
class OriginalFaces {
 public:
  explicit OriginalFaces(const Complex& original) : original_(original), order_(original.n_faces()) {
    std::iota(order_.begin(), order_.end(), 0u);
    const auto parent = [&](std::uint32_t f) { return original_.parent[f]; };
    if (!std::ranges::is_sorted(order_, {}, parent)) std::ranges::stable_sort(order_, {}, parent);
  }
  /// Invalid if there is none.
  [[nodiscard]] FaceId find(ElementRef parent) const {
    const auto it = std::ranges::lower_bound(order_, parent, {}, [&](std::uint32_t f) { return original_.parent[f]; });
    return it != order_.end() && original_.parent[*it] == parent ? FaceId(std::size_t{*it}) : FaceId();
  }

 private:
  const Complex& original_;
  std::vector<std::uint32_t> order_;
};

}  // namespace meshgraft
