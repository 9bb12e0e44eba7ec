// Filling of an opening between contours (paper 5.5).
#pragma once

#include <array>
#include <functional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "core/complex.hpp"

namespace meshgraft {

/// What is to be filled: a piece of surface without faces, and its surroundings.
struct Opening {
  /// Closed chains of vertices, the first not repeated, with the opening on their left. A chain may visit a vertex
  /// several times: an inner polyline is followed there and back, an inner vertex is a chain of one.
  std::vector<std::vector<VertexId>> contours;
  std::function<Vec3(VertexId)> position;
  /// Unit normal of the surface at a vertex of the contours. In a planar opening it is the same everywhere.
  std::function<Vec3(VertexId)> normal;
  /// Whether faces that stay have the edge already.
  std::function<bool(VertexId, VertexId)> has_edge;
  bool planar = false;
};

struct OpeningOptions {
  /// Corners of a polygon up to which it is filled in one piece: 40 MB and some seconds.
  std::size_t most_corners = 1200;
  /// Scores compared where a contour is longer than `all_scores` corners.
  std::size_t depth = 6;
  std::size_t all_scores = 64;
  /// Least cosine between a face and the normals at its corners, where the opening is not planar.
  double least_cosine = 0.2;
};

struct OpeningFill {
  std::vector<std::array<VertexId, 3>> faces;
  /// Edges that were set before the rest was optimised: between contours, and across contours that are longer
  /// than OpeningOptions::most_corners.
  std::vector<std::array<VertexId, 2>> chords;
};

/// Fills an opening without new vertices so that its worst face is as good as possible by Q, then the second
/// worst, and so on.
///
///  (1) Every side of a contour gets one face on its left; no other edge gets more than two faces, and none that
///      `has_edge` tells is made.
///  (2) In a planar opening all faces are turned like the normal and do not overlap. Elsewhere each is within
///      `least_cosine` of the normals at its corners; whether faces of a curved opening intersect is left to the
///      check of the result.
///  (3) With one contour of up to `most_corners` corners the worst face is the best possible one under (1) and (2),
///      and so are the `depth` worst ones together (all of them up to `all_scores` corners). With several contours,
///      or a longer one, that holds given the `chords`, each of which is the shortest that crosses no contour. No
///      filling is an answer too if a contour that passes through vertices more than once would make edges twice in
///      every one of hundreds of attempts, each the best of what is left; none such is known.
///  (4) Deterministic; of equal choices the one with the smaller vertex id.
///
/// Nothing, and why, if a contour cannot be reached or no triangulation is allowed.
[[nodiscard]] tl::expected<OpeningFill, std::string> fill_opening(const Opening& opening,
                                                                  const OpeningOptions& options = {});

}  // namespace meshgraft
