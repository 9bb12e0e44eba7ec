// Wanted edge length at every place of the zone (paper 5.3: l_a along the line, the meshes' own
// size away from it, a graded transition between).
#pragma once

#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "geometry/box_tree.hpp"
#include "zone/brep.hpp"

namespace meshgraft {

struct SizeOptions {
  std::optional<double> junction_size;            // instead of l_a
  double gradation = 0.4;                         // change of size per unit of length, > 0
  double finer_share = 1.5;                       // l_a is at most this x the size of the finer mesh
  double gap_share = 1.0;                         // size allowed between two curves, as a share of their distance
  double gap_floor = 0.05;                        // a gap asks for no less than this share of the size around it
  double cone = 40.0 / 180.0 * std::numbers::pi;  // radians; curves that meet at more leave no narrow corner
  double cone_floor = 0.2;                        // as gap_floor, in a narrow corner
  /// By face: 1 if it stays as it is, and with it the nodes of the junction that it has. May be empty.
  std::span<const std::uint8_t> kept = {};
  /// How far the new edges of a junction may stand off it, share of the edge length there: the facets of curved
  /// surfaces that meet at a small angle leave a zigzag, and its short pieces are no detail of the model.
  double junction_slack = 0.05;
  double border_slack = 0.03;  // the same of borders of plane areas
  double stretched = 0.9;      // a sheet wants at least this share of the mean edge length of its faces
  double max_height = 0.065;   // of a node of the input over a new face: share of the edge length there
};

/// The junction as seen from a place.
struct NearJunction {
  double distance = 0;
  double size = 0;  // l_a there: mean edge length of the touched faces of both meshes
};

/// The size at a place is, in this order:
///
///   own       of the original faces of the sheet: edge of an equilateral triangle as large as the faces around each
///             vertex, so that there are as many new ones, but at least `stretched` x their mean edge length; or what
///             `max_height` leaves of it where they lean steeply; interpolated on the nearest face
///   at least  l_a - gradation x distance to the junction
///   at most   l_a + gradation x distance to the junction, and likewise around each place that needs
///             small faces: narrow gaps between curves, short curves, tight bends of a curve, curves
///             that the input divides more finely than their sheets; not where all faces stay (kFrozen vertices)
///
/// l_a at a place of the junction is the mean edge length of the faces of the meshes that meet there,
/// each mesh counted by the number of its faces along the line: the harmonic mean of their mean edge lengths,
/// but at most `finer_share` x the smallest. Beside faces that are kept it is their size. Read as: the mean of
/// paper 5.3 over the faces near the place instead of over the whole line, so that graded meshes get a graded line.
class SizeField {
 public:
  /// `original`: the complex before corefinement (its faces tell the meshes' own sizes);
  /// `complex`, `brep`: after it. Cost O((m + k) log m), k curve vertices.
  SizeField(const Complex& original, const Complex& complex, const Brep& brep, const SizeOptions& options);

  /// Wanted edge length at `p` in a sheet. Cost O(log n).
  [[nodiscard]] double at(SheetId sheet, Vec3 p) const;
  /// On a curve: the least wish of the sheets at it, so that all of them agree.
  [[nodiscard]] double on_curve(CurveId curve, Vec3 p) const;
  /// The junction where it is nearest to `p`; infinitely far and large without one.
  [[nodiscard]] NearJunction junction(Vec3 p) const;
  /// How far new edges may stand off a curve, whatever their length.
  [[nodiscard]] double slack(CurveId curve) const;
  /// Change of size per unit of length.
  [[nodiscard]] double gradation() const;

  struct Data;

 private:
  std::shared_ptr<const Data> data_;
};

}  // namespace meshgraft
