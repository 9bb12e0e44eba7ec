// Puts the nodes of a cut on the true cylinder, of which the tool's facets are only chords.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "merge/junction_summary.hpp"
#include "meshgraft/cut.hpp"

namespace meshgraft {

/// Moves new vertices of the cut that lie on edges of the original faces along these edges onto the
/// cylinder. Those inside of faces lie on it already: there an edge of the tool goes through the face.
/// A vertex stays where it is if a face around it would turn over, or if the edge hardly crosses the
/// cylinder; round_nodes() mends it then, unless a T-line, a fold or a free edge holds it.
///
///   original   the workpiece of the base; its vertices are the first of `complex`
///   border     edges of the cut
void round_border(const Complex& original, std::span<const std::array<VertexId, 2>> border,
                  const CylinderTool& cylinder, Complex& complex);

/// Moves new vertices inside the cut (not its ends and branches) within the original faces onto the
/// cylinder, after remeshing.
void round_nodes(const Complex& original, const Junction& cut, const CylinderTool& cylinder, Complex& complex);

}  // namespace meshgraft
