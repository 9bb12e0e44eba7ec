// Triangulation of small polygons in the plane.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/predicates.hpp"

namespace meshgraft {

/// A corner of a polygon. `lines` has a bit for each straight line known to hold the corner (an
/// edge of the original face): corners with a common bit are collinear whatever their coordinates.
struct PolygonCorner {
  Vec2 at;
  std::uint32_t id = 0;
  std::uint32_t lines = 0;
};

/// Triangulates a counter-clockwise polygon of n corners without holes into n - 2 triangles (of
/// positions in `polygon`). The polygon may touch itself along edges and in corners (bridges).
///
///  (1) Every triangle turns left, by exact sign, and has no three corners on one line. As the signed
///      areas add up to the polygon, triangles that all turn left cannot overlap.
///  (2) Up to kBestPolygon corners: the worst Q (in the plane) is as good as possible.
///
/// Nothing if there is no such triangulation. Cost O(n^3) up to kBestPolygon corners, O(n^2) beyond.
std::optional<std::vector<std::array<std::uint32_t, 3>>> triangulated(std::span<const PolygonCorner> polygon);

inline constexpr std::size_t kBestPolygon = 40;

}  // namespace meshgraft
