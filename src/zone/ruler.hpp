// Resampling of a curve (the ruler of paper 5.3), extended to even spacing and graded size.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "meshgraft/vec3.hpp"

namespace meshgraft {

struct RulerOptions {
  double max_sagitta = 0.07;  // share of the chord
  double slack = 0;           // length; a chord this near to the polyline follows it, however short it is
  double gradation = 0.4;     // change of piece length per unit of length around tight bends
};

/// Arc lengths of the nodes that shall stand on a polyline between its two ends (both included,
/// ascending; the first is 0, the last the length).
///
///   polyline   at least 2 points; for a closed curve the last equals the first
///   size       wanted edge length at arc length s and point p, > 0; asked for at several places at the same time
///
///  (1) Spacing is even in units of `size`: with m = the integral of ds / size over a piece, m is the
///      same for all pieces, up to 5 %.
///  (2) No short last piece: the number of pieces is the one for which m is nearest to 1 in ratio, so
///      that m is in [0.70, 1.42] on every curve with a total of at least 0.71, and nearer to 1 the more
///      pieces there are. A curve that ends where it starts gets at least 3 pieces.
///  (3) A chord between two neighbours stays within `max_sagitta` x its length, or `slack`, of the polyline. Where it
///      would not, (1) and (2) give way there: a tight bend is spaced more finely, graded; a kink gets
///      a node, and (1) and (2) hold on its two sides.
///  (4) The reversed polyline gives the reversed nodes, up to rounding.
[[nodiscard]] std::vector<double> resampled(std::span<const Vec3> polyline, bool closed,
                                            const std::function<double(double s, Vec3 p)>& size,
                                            const RulerOptions& options = {});

/// Cumulative arc length by point; and the point at an arc length.
[[nodiscard]] std::vector<double> arc_lengths(std::span<const Vec3> polyline);
[[nodiscard]] Vec3 point_at(std::span<const Vec3> polyline, std::span<const double> arc, double s);

}  // namespace meshgraft
