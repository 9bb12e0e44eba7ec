// The curves along which the inputs are joined in the result.
#pragma once

#include <array>
#include <vector>

#include "merge/outcome.hpp"
#include "meshgraft/report.hpp"
#include "zone/brep.hpp"

namespace meshgraft {

/// An edge of the final complex in which components meet that are joined: its faces are not all of the same ones.
struct JunctionEdge {
  std::array<VertexId, 2> ends;           // ascending
  std::vector<std::uint32_t> components;  // ascending
  enum Kind {
    kCrossing,  // each component has two faces or more on it
    kTouching,
    kOverlap,  // around an area in which they lie on each other
  } kind = kTouching;
  [[nodiscard]] const char* name() const {
    return kind == kCrossing ? "crossing" : kind == kTouching ? "touching" : "overlap";
  }
  /// Whether a polyline may go on from one to the other.
  [[nodiscard]] bool continues(const JunctionEdge& next) const {
    return components == next.components && kind == next.kind;
  }
};

/// A vertex of the final complex with faces of several such components, on no junction edge.
struct JunctionPoint {
  VertexId vertex;
  std::vector<std::uint32_t> components;  // ascending
};

struct Junction {
  std::vector<JunctionEdge> edges;    // ascending by ends
  std::vector<JunctionPoint> points;  // ascending by vertex
};

[[nodiscard]] Junction junction_of(const Complex& complex);

struct JunctionSummaryOptions {
  double turn_angle = BrepOptions{}.turn_angle;  // radians; sharper turns count as corners (5.3)
};

/// Chains the edges to polylines; the points follow. A polyline ends where other than two edges of
/// the same components and kind meet; its corners are its ends and its sharp turns. Order: open ones
/// first, by smallest vertex.
[[nodiscard]] std::vector<PolylineSummary> polylines_of(const Complex& complex, const Junction& junction,
                                                        const Components& components,
                                                        const JunctionSummaryOptions& options = {});

}  // namespace meshgraft
