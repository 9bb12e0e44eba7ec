// Resampling of a curve (the ruler of paper 5.3), extended to even spacing and graded size.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "meshgraft/vec3.hpp"

namespace meshgraft {

/// Arc lengths of the nodes that shall stand on a polyline between its two ends (both included,
/// ascending; the first is 0, the last the length).
///
///   polyline   at least 2 points; for a closed curve the last equals the first
///   size       wanted edge length at arc length s and point p
///
///  (1) Spacing is even in units of `size`: every piece is the same multiple of the local size.
///  (2) No short last piece: the number of pieces is the one for which that multiple is nearest to
///      1 in ratio; a closed curve gets at least 3.
///  (3) A chord between two neighbours stays within `max_sagitta` x its length of the polyline;
///      more pieces are used where it would not.
struct RulerOptions {
  double max_sagitta = 0.08;  // share of the chord
};
[[nodiscard]] std::vector<double> resampled(std::span<const Vec3> polyline, bool closed,
                                            const std::function<double(double s, Vec3 p)>& size,
                                            const RulerOptions& options = {});

/// Cumulative arc length by point; and the point at an arc length.
[[nodiscard]] std::vector<double> arc_lengths(std::span<const Vec3> polyline);
[[nodiscard]] Vec3 point_at(std::span<const Vec3> polyline, std::span<const double> arc, double s);

}  // namespace meshgraft
