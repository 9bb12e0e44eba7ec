// The neighbourhood of a junction read as a little boundary representation: corners, curves, sheets.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "geometry/angles.hpp"
#include "zone/ruler.hpp"

namespace meshgraft {

using CurveId = Id<struct CurveTag>;
using SheetId = Id<struct SheetTag>;

/// What a vertex may do in remeshing.
enum class Dimension : std::uint8_t {
  kCorner,  // stays
  kCurve,   // slides along its curve, may be removed or added there
  kSheet,   // moves in its sheet
};

/// A chain of edges between corners, or a closed one. Bounds any number of sheets.
struct Curve {
  std::vector<VertexId> chain;       // in order; a closed curve repeats the first vertex at the end
  std::vector<std::uint32_t> lines;  // by edge of the chain: position in Complex::lines of the 1D
                                     // elements on it; all edges of a curve carry alike elements
  std::uint32_t lines_per_edge = 0;  // lines has lines_per_edge entries for each edge of the chain
  bool closed = false;
  bool junction = false;  // components meet along it
  bool free = false;      // its edges have one face
  bool fixed = false;     // may not be resampled (fixed edges, frozen surroundings)
  bool border = false;    // of a plane area, which would lose what is cut off its corners

  /// Of new edges, share of their length.
  [[nodiscard]] double max_sagitta() const {
    constexpr double kOfBorders = 0.03;  // rings of 12 to 30 sides keep their area within the 2 % of the ledger
    return border ? kOfBorders : RulerOptions{}.max_sagitta;
  }
};

/// A maximal piece of manifold surface between curves: one group set, one set of attributes.
struct Sheet {
  std::vector<FaceId> faces;  // ascending
  bool planar = false;        // all within rounding of one plane, but for a border pulled off it a little
  Vec3 normal, origin;        // of that plane, and a point of it; zero otherwise
  bool made_up = false;       // the faces close a hole: they are no surface to stay on, and all alike
};

struct Brep {
  std::vector<Dimension> dimension;  // by vertex
  std::vector<Curve> curves;
  std::vector<Sheet> sheets;
  std::vector<SheetId> sheet_of_face;  // by face
  /// By face and corner k: the curve of the edge from corner k to corner k+1, or none.
  std::vector<std::array<CurveId, 3>> curve_of_edge;
};

struct BrepOptions {
  double sharp_angle = radians(30);     // radians; edges folded more are curves
  double line_turn_angle = radians(1);  // the same for curves that carry 1D elements
  double turn_angle = radians(35);      // radians; sharper turns of a curve are corners (5.3)
  /// The complex before it was cut. Where pieces of faces were taken out, what is left of them does not
  /// tell the edge length of the input; without it, pieces do.
  const Complex* original = nullptr;
};

/// Curves are: junction edges, free edges, non-manifold edges, sharp edges, edges between faces of
/// different group set, attributes, component or orientation, edges with 1D elements, fixed edges. The borders of an
/// open seam are fixed (free edges in one place). An edge that is fixed, or has a kFrozen end, is a curve of its own.
///
/// Corners are: vertices where other than two curve edges meet or where the two differ in what
/// they bound or carry; sharp turns; bends between 1D elements; kPinned and kFrozen vertices; junction points; ends of
/// fixed edges and of 1D elements that lie on no face edge; vertices in which surfaces touch without an edge; vertices
/// with explicit node groups: one that neither all vertices of all faces around have (the group covers an area) nor
/// both neighbours on the curve (it goes on along a line), each component taken by itself. Corners may lie
/// inside a sheet.
///
/// A turn is measured over a tenth of the edge length of the input faces there, so that the direction of a very
/// short edge, which is noise, makes no corner, and a small chamfer makes one.
///
/// `junction_edges`, `junction_points`: as in Corefined.
[[nodiscard]] Brep read_brep(const Complex& complex, std::span<const std::array<VertexId, 2>> junction_edges,
                             std::span<const VertexId> junction_points, GroupSets& groups,
                             const BrepOptions& options = {});

}  // namespace meshgraft
