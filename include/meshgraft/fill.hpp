// Filling of holes: faces where a mesh has none.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshgraft/merge.hpp"
#include "meshgraft/model.hpp"
#include "meshgraft/options.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

/// A closed chain of free edges.
struct Contour {
  /// In order, what is open on the left; starts at the smallest label. A node in which the mesh touches itself across
  /// the opening is there several times.
  std::vector<NodeId> nodes;
  double length = 0;
  Vec3 centre;  // mean of the nodes
  /// The surface around goes on into it: its area vector makes less than 60 degrees with the mean normal of the
  /// faces around, which look one way. Otherwise it is the outer border of an open shell, or the end of a pipe, where
  /// they look outwards.
  bool is_hole = false;
  /// All its faces are linear triangles and turned alike.
  bool is_fillable = true;
};

/// All contours of the surface elements of a model, the longest first (equal ones: the smaller label). Holes that
/// touch in a node are contours of their own. Cost O(m log m).
[[nodiscard]] std::vector<Contour> contours_of(const Model& model);

struct FreeEdges {
  std::vector<Contour> contours;              // as of contours_of()
  std::vector<std::array<NodeId, 2>> others;  // that close no contour: orientations change along them, or they end at
                                              // an edge of three faces
  /// Pairs of surface elements on the same nodes with a side that no others have. It is free of neither, so that a hole
  /// beside them is not seen. Ascending.
  std::vector<std::array<ElementId, 2>> doubled;
};

[[nodiscard]] FreeEdges free_edges_of(const Model& model);

/// Positions in contours_of() of contours that bound one opening together: an outer one and the borders of islands
/// in it, or two ends of a pipe that lacks a piece.
using OpeningContours = std::vector<std::size_t>;

/// Each hole that is fillable, with the outer borders of pieces that stand in it: a contour within the hole, seen
/// along its mean normal, that a straight way from the hole reaches within 20 degrees of the surface at both ends.
/// The hole comes first. Cost: for each hole the product of its nodes and those of the borders inside its box.
[[nodiscard]] std::vector<OpeningContours> openings_of(const Model& model, std::span<const Contour> contours);

struct FillOptions {
  /// No contour twice; empty: openings_of().
  std::vector<OpeningContours> openings;
  /// min_quality, size (by default that of the faces around), blend, progress. With Method::kPaper the mesh is left as
  /// the paper makes it; otherwise it is improved once the surface is known.
  MergeOptions zone;
};

/// Fills contours of `base` with triangles that continue the surface around them (paper 5.5, 5.6; see
/// MergeOptions::blend) and its edge lengths.
///
///  (1) No element and no node of the base changes.
///  (2) New faces are turned like those around. They have the attributes that hold along the greatest part of the
///      contours of their opening, and are in the groups that all faces along these are in.
///  (3) New nodes are in the node groups that all nodes of these contours are in, and in those that covered a group
///      that the new faces are in.
///  (4) Labels count on from the largest.
///  (5) 1D elements in an opening, along the surface, that hang together with a contour and are no longer than two of
///      its sides become edges of new faces, unless that breaks a promise which holds without. Others are warnings
///      if they are along the surface, or on a way from a contour to a contour.
///  (6) No edge gets a third face. Where new faces meet other surface elements of the model, or fold back on each
///      other, that is a broken promise of the report.
///
/// The result has one input: apply(base, {}, result) and write_unv(base, {}, result, ...). Contours left open by an
/// empty `openings` are warnings.
///
/// Errors: those of merge(); kUsage if a contour is asked for that there is not, or twice, or there is none to fill;
/// kUnsupportedElement if one is not fillable; kContourNotFilled, with the place, if no triangulation follows the
/// surface.
[[nodiscard]] Result<Merged> fill(const Model& base, const FillOptions& options = {});

}  // namespace meshgraft
