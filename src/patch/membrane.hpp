// A membrane in a frame, over any triangulation.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshgraft/vec3.hpp"

namespace meshgraft {

/// The positions of all nodes with each free one in a weighted mean of its neighbours. The weights are mean values
/// (Floater 2003) of the triangulation as it lies: all are positive, so that no free node is outside of the convex hull
/// of the others, and where the fixed ones lie on a plane, seen from some side, as the corners of a convex polygon, no
/// face is folded from there however poor the triangulation is (Tutte 1963; Floater 1997); and free nodes of a
/// triangulation in a plane stay where they are.
///
///   position   n
///   is_free    n; a free node is inside: all its edges have two faces
///
/// As they were if that has no solution: free nodes are not connected to others.
[[nodiscard]] std::vector<Vec3> on_membrane(std::span<const std::array<std::uint32_t, 3>> faces,
                                            std::vector<Vec3> position, std::span<const std::uint8_t> is_free);

}  // namespace meshgraft
