// The faces of a corefined complex, gathered by the input face they descend from.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/complex.hpp"

namespace meshgraft {

/// A parent is a dense number, ascending by ElementRef. Cost O(m log m).
struct Parents {
  explicit Parents(const Complex& complex);

  std::vector<std::uint32_t> of_face;  // by face
  std::vector<std::uint32_t> first;    // by parent, and the end: positions in `faces`
  std::vector<FaceId> faces;           // by parent, ascending

  [[nodiscard]] std::size_t size() const { return first.size() - 1; }
  [[nodiscard]] std::span<const FaceId> faces_of(std::uint32_t parent) const {
    return std::span(faces).subspan(first[parent], first[parent + 1] - first[parent]);
  }
};

/// Area vector of each parent: the sum over its faces. Unlike the normals of slivers that
/// corefinement leaves, it is not noise.
[[nodiscard]] std::vector<Vec3> area_vectors(const Parents& parents, const Complex& complex);

/// Edge length of the equilateral triangle with that area.
[[nodiscard]] double edge_length_of_area(double area);

}  // namespace meshgraft
