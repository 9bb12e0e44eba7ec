// The surface and the curves as they were before remeshing: where new vertices must lie.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "geometry/box_tree.hpp"
#include "zone/brep.hpp"
#include "zone/edge_table.hpp"

namespace meshgraft {

/// The point of the reference surface nearest to a given one.
struct Foot {
  Vec3 point;
  FaceId face;
  double distance = 0;
};

/// Faces of the zone and those around it, by sheet, and the curves of the zone. Keeps references to
/// complex and brep.
class Reference {
 public:
  Reference(const Complex& complex, const Brep& brep, const std::vector<std::uint8_t>& in_zone);

  /// The nearest place in the sheet; `hint`, if valid, is a face of the sheet likely to be near. In a sheet that is
  /// made up every place is its own foot.
  [[nodiscard]] Foot project(SheetId sheet, Vec3 p, FaceId hint) const;
  /// The place reached from a face of the sheet by going on to its neighbours as long as that leads nearer to p. No
  /// nearer than project(), mostly the same, and several times as fast.
  [[nodiscard]] Foot walk(SheetId sheet, Vec3 p, FaceId from) const;
  /// Where a vertex wanted at p may stand: the place that walk() finds, or in a planar sheet the foot on its plane
  /// (beneath which `hint` stays). A border that was pulled off the plane does not draw vertices after it.
  [[nodiscard]] Foot place(SheetId sheet, Vec3 p, FaceId hint) const;
  [[nodiscard]] Vec3 normal(FaceId f) const;  // unit
  /// Edge length of the input face that a face of the complex is a piece of.
  [[nodiscard]] double edge_length(FaceId f) const { return edge_length_[f.value]; }
  /// The same of the smallest one around it, which would be lost first; at least `kFine` of its own.
  [[nodiscard]] double least_edge_length(FaceId f) const { return least_edge_length_[f.value]; }

  [[nodiscard]] const Curve& curve(CurveId c) const { return brep_.curves[c.value]; }
  [[nodiscard]] std::span<const Vec3> polyline(CurveId c) const { return points_[c.value]; }
  /// Arc lengths of the points of the polyline.
  [[nodiscard]] std::span<const double> arcs(CurveId c) const { return arcs_[c.value]; }
  [[nodiscard]] double length(CurveId c) const { return arcs_[c.value].back(); }
  /// Position on the curve; arc lengths outside [0, length] wrap around.
  [[nodiscard]] Vec3 point(CurveId c, double arc) const;
  /// Number of the edge of the chain that holds the arc length.
  [[nodiscard]] std::size_t edge(CurveId c, double arc) const;
  [[nodiscard]] double wrapped(CurveId c, double arc) const;
  /// Largest distance of the curve between two arc lengths (from < to, may exceed the length) from
  /// the chord between its ends.
  [[nodiscard]] double sagitta(CurveId c, double from, double to) const;

 private:
  void find_neighbours();

  const Complex& complex_;
  const Brep& brep_;
  std::vector<std::vector<FaceId>> faces_;  // by sheet, ascending
  std::vector<BoxTree> trees_;              // by sheet
  // Where a walk goes on, if any sheet is curved; else empty.
  std::vector<std::array<FaceId, 3>> beside_;  // by face: in the same sheet, across the edge from corner k to the next
  std::optional<VertexFaces> around_;
  std::vector<double> edge_length_;        // by face
  std::vector<double> least_edge_length_;  // by face
  std::vector<std::vector<Vec3>> points_;  // by curve; empty if no edge of it is in the zone
  std::vector<std::vector<double>> arcs_;
};

}  // namespace meshgraft
