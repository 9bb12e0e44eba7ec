// The boxes around the faces of runs of elements, made once for all passes over the inputs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/blocks.hpp"
#include "meshgraft/model.hpp"

namespace meshgraft {

/// Empty if the element is not a face or has not all its nodes.
[[nodiscard]] Box box_of_face(const Model& model, ElementId element);

class FaceRuns {
 public:
  /// One parallel pass; 48 bytes for each kRun elements.
  explicit FaceRuns(std::span<const Model* const> inputs);

  /// What f(element, out) appends to the vector `out` for the elements of an input in their order, but for the runs for
  /// which near(first, last, box) is false.
  template <class T, class Near, class F>
  [[nodiscard]] std::vector<T> collected_by_run(std::uint32_t input, std::size_t n_elements, Near&& near, F&& f) const {
    const std::vector<Box>& boxes = of_input_[input];
    return collected_by_block<T>(n_elements, [&](std::size_t begin, std::size_t end, std::vector<T>& out) {
      for (std::size_t first = begin; first < end; first += kRun) {
        const std::size_t last = std::min(end, first + kRun);
        if (!near(first, last, boxes[first / kRun])) continue;
        for (std::size_t i = first; i < last; ++i) f(ElementId(i), out);
      }
    });
  }

 private:
  std::vector<std::vector<Box>> of_input_;  // by run
};

}  // namespace meshgraft
