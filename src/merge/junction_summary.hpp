// The curves along which the inputs are joined in the result.
#pragma once

#include <array>
#include <vector>

#include "merge/outcome.hpp"
#include "meshgraft/report.hpp"

namespace meshgraft {

/// An edge of the final complex with faces of several inputs.
struct JunctionEdge {
  std::array<VertexId, 2> ends;       // ascending
  std::vector<std::uint32_t> inputs;  // ascending
};

/// Ascending by ends.
[[nodiscard]] std::vector<JunctionEdge> junction_edges(const Complex& complex);

struct JunctionSummaryOptions {
  double turn_angle = 35.0 / 180.0 * 3.14159265358979323846;  // radians; sharper turns count as corners (5.3)
};

/// Chains the edges to polylines. A polyline ends where other than two edges of the same inputs
/// meet; its corners are its ends and its sharp turns. Order: by smallest vertex.
[[nodiscard]] std::vector<PolylineSummary> polylines_of(const Complex& complex, std::span<const JunctionEdge> edges,
                                                        const JunctionSummaryOptions& options = {});

}  // namespace meshgraft
