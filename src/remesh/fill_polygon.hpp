// The best triangulation of a polygon (paper 5.5).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/complex.hpp"

namespace meshgraft {

struct PolygonFill {
  std::vector<std::array<std::uint32_t, 3>> faces;  // k - 2, positions in the polygon, in its orientation
  std::vector<double> scores;                       // k - 2, ascending
};

struct FillRules {
  /// Score of the face on three corners (ascending positions in the polygon); not positive: not allowed.
  std::function<double(std::uint32_t, std::uint32_t, std::uint32_t)> score;
  /// Whether two corners that are not neighbours may be joined.
  std::function<bool(std::uint32_t, std::uint32_t)> may_join;
  /// How many scores are compared, worst first; 0: all. With a few, memory and time per choice do not grow with
  /// the polygon.
  std::size_t depth = 0;
};

/// The triangulation without inner vertices whose worst score is best, then whose second worst is
/// best, and so on.
///
///   polygon   k >= 3 vertices in order; the first is not repeated at the end. A vertex may stand at several
///             corners (a contour that touches itself, or follows a line there and back); the rules must not allow
///             a face or a join between them.
///
///  (1) Of all triangulations that the rules allow it is the best one: in its `depth` worst scores, or in all.
///  (2) Rotating `polygon` gives the same faces; of equal choices the apex with the smaller id wins.
///  (3) Nothing if the rules allow no triangulation.
///
/// Cost: O(k^3) choices, nearly all of them dismissed by one comparison of the worst scores; those that are not
/// compare `depth` scores (k without). Memory O(k^2 depth). After Liepa, "Filling Holes in Meshes", SGP 2003, with
/// the lexicographic order in place of the area.
[[nodiscard]] std::optional<PolygonFill> fill_polygon(std::span<const VertexId> polygon, const FillRules& rules);

}  // namespace meshgraft
