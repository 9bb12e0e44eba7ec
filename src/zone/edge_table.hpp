// Edges of a complex with their faces, and faces of its vertices.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/buckets.hpp"
#include "core/complex.hpp"

namespace meshgraft {

using EdgeId = Id<struct EdgeTag>;  // in EdgeTable, ascending by (low, high)

/// One side of one face.
struct EdgeUse {
  VertexId low, high;
  FaceId face;
  std::uint8_t corner = 0;  // the edge runs from this corner of the face to the next
  bool forward = true;      // the face runs from low to high
};

/// Every edge once, whatever its number of faces. Costs O(m) time and memory; order fixed by ids.
class EdgeTable {
 public:
  explicit EdgeTable(const Complex& complex);

  [[nodiscard]] std::size_t size() const { return first_use_.size() - 1; }
  /// The faces at an edge, ascending.
  [[nodiscard]] std::span<const EdgeUse> uses(EdgeId e) const {
    return std::span(uses_.all()).subspan(first_use_[e.value], first_use_[e.value + 1] - first_use_[e.value]);
  }
  /// (smaller, larger) vertex.
  [[nodiscard]] std::array<VertexId, 2> ends(EdgeId e) const {
    const EdgeUse& use = uses_.all()[first_use_[e.value]];
    return {use.low, use.high};
  }
  [[nodiscard]] EdgeId of(FaceId f, std::size_t corner) const { return of_[f.value][corner]; }
  /// The edge between two vertices, or none if no face has it.
  [[nodiscard]] EdgeId find(VertexId a, VertexId b) const;

 private:
  Buckets<EdgeUse> uses_;                    // 3 m, by the smaller end; ascending by (low, high, face, corner)
  std::vector<std::uint32_t> first_use_;     // by edge, and the end
  std::vector<std::uint32_t> first_of_low_;  // by vertex: first edge with it as the smaller end; and the end
  std::vector<std::array<EdgeId, 3>> of_;    // by face and corner
};

/// Faces at each vertex, ascending.
class VertexFaces {
 public:
  explicit VertexFaces(const Complex& complex);
  [[nodiscard]] std::span<const FaceId> operator[](VertexId v) const { return faces_[v.value]; }

 private:
  Buckets<FaceId> faces_;
};

}  // namespace meshgraft
