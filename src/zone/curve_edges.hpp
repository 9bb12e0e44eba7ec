// Which edges of a complex are curves, and which of them are alike.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "zone/brep.hpp"
#include "zone/edge_table.hpp"
#include "zone/parents.hpp"

namespace meshgraft {

/// Whether faces at the edge may be missing, so that neither it nor any face on it may change.
[[nodiscard]] inline bool is_frozen_edge(const Complex& complex, VertexId a, VertexId b) {
  return complex.state[a.value] == VertexState::kFrozen || complex.state[b.value] == VertexState::kFrozen;
}

/// Everything that makes an edge more than the inside of a sheet.
struct CurveEdges {
  static constexpr std::uint32_t kNoKind = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint32_t> kind;  // by edge: equal for edges that bound and carry the same; kNoKind: no curve
  std::vector<std::uint8_t> junction, fixed;    // by edge
  std::vector<std::uint32_t> first_line, line;  // by edge offsets into `line`: positions in Complex::lines
  std::vector<VertexId> ends_of_loose_lines;    // 1D elements that lie on no face edge

  [[nodiscard]] bool is_curve(EdgeId e) const { return kind[e.value] != kNoKind; }
  /// 1D elements on an edge, alike ones in the same order on all edges of a kind.
  [[nodiscard]] std::span<const std::uint32_t> lines_of(EdgeId e) const {
    return std::span(line).subspan(first_line[e.value], first_line[e.value + 1] - first_line[e.value]);
  }
};

[[nodiscard]] CurveEdges curve_edges(const Complex& complex, const EdgeTable& edges, const Parents& parents,
                                     std::span<const std::array<VertexId, 2>> junction_edges,
                                     const BrepOptions& options);

}  // namespace meshgraft
