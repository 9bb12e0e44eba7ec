// Makes the components of a complex conforming along the curves in which they meet (paper 5.2).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/complex.hpp"
#include "geometry/angles.hpp"
#include "meshgraft/options.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

struct CorefineOptions {
  /// Gap or penetration closed where a feature (free, sharp or non-manifold edge, pinned vertex) of
  /// one component ends on another, or another line that stays (border of groups or attributes, edge with 1D
  /// elements) runs along it.
  Tolerance tolerance;
  /// Everything else nearer than this share of the local edge length is one place: far above
  /// rounding, so that decisions beyond it are well conditioned; far below what analysis sees.
  double weld_share = 1e-6;
  /// Faces flatter to each other than this and nearer than the tolerance overlap. Radians.
  double contact_angle = radians(20);
  Mode mode = Mode::kAuto;
  Overlap overlap = Overlap::kFuse;
  /// Edges folded more than this are sharp. Radians.
  double sharp_angle = radians(30);
  /// Pockets (see find_pockets()) are imprinted like all else, and no fault.
  bool leaves_pockets = false;
  /// What lies on another mesh ends on what goes through both: its rims are drawn onto a third mesh before anything is
  /// joined, and its border is a line that others end on. Where that cannot be imprinted, it is tried without.
  bool ends_on_borders = true;
};

/// The complex after all components have been imprinted on each other.
struct Corefined {
  Complex complex;  // each face lies in its parent; shared junction vertices and edges

  /// Edges whose faces are not all of the same components (Complex::are_of_the_same), each once, (smaller,
  /// larger) vertex, ascending.
  std::vector<std::array<VertexId, 2>> junction_edges;
  /// Vertices in which components meet but which are on no junction edge, ascending.
  std::vector<VertexId> junction_points;
  /// By face: 1 if its parent meets another component (F1, F2 of paper 5.4).
  std::vector<std::uint8_t> touched;

  struct Move {
    NodeRef node;
    VertexId vertex;
    Vec3 from, to;
  };
  std::vector<Move> moves;  // nodes that were moved to close gaps, ascending

  struct Replaced {
    NodeRef node;
    VertexId by;
  };
  std::vector<Replaced> replaced;  // nodes of later components that became one with an earlier vertex

  /// By face: 1 if it is to stay as it is because it lies in an area of contact that is kept. Empty:
  /// there is none.
  std::vector<std::uint8_t> kept;

  /// Faces that went because they lie on others, ascending.
  struct Covered {
    ElementRef face;
    double area = 0;                      // of it that went
    double area_there = 0;                // the same as drawn onto the other surface, which may be bent the other way
    bool has_heir = false;                // another face stands for it now (Complex::layers)
    std::uint32_t component = 0, on = 0;  // its own, and that of the face it lay on
    std::size_t gaps = 1;                 // over each other: one more than what lay between, if it has no heir
    friend auto operator<=>(const Covered&, const Covered&) = default;
  };
  std::vector<Covered> covered;

  /// What the pieces of a face have gained (less than 0: lost) from those of its neighbours, where edges became whole
  /// again; see take_out_points().
  struct Traded {
    ElementRef face;
    double area = 0;
    friend auto operator<=>(const Traded&, const Traded&) = default;
  };
  std::vector<Traded> traded;  // ascending; a face may be there more than once

  /// Pairs (smaller, larger) of components that meet, ascending.
  std::vector<std::array<std::uint32_t, 2>> met;

  /// A place where components are within the tolerance and yet not joined; see (6).
  struct OpenGap {
    std::array<ElementRef, 2> faces;  // of an earlier component, of the later one
    Vec3 at;
    double distance = 0;
    std::size_t feature = 1;  // which of the two faces has the edge or vertex that ends there
  };
  std::vector<OpenGap> left_open;  // in the order of the components

  /// A place where a free edge is in reach of another component with one end only: it is joined up to that.
  struct HalfReached {
    ElementRef face;      // that has the edge
    Vec3 at;              // its other end
    double distance = 0;  // of that
  };
  std::vector<HalfReached> half_reached;  // in the order of the components

  /// A place where an open seam of one component (free edges within the tolerance of each other) is met by another:
  /// its borders share the vertex there now.
  struct JoinedSeam {
    ElementRef face;  // on one of the borders
    Vec3 at;
  };
  std::vector<JoinedSeam> joined_seams;  // in the order of the components

  /// Where two free edges of one component, or pieces of them, have the same vertices at both ends now: pieces of open
  /// seams, which are one edge. In the order of the components.
  std::vector<std::array<Vec3, 2>> sewn;
};

/// Why components could not be made conforming; `merge` turns it into an Error with labels.
struct JunctionFault {
  ErrorCode code = ErrorCode::kJunctionNotResolved;  // or kOverlap, kDegenerateFace, kDuplicateFace
  std::string what;
  std::vector<ElementRef> elements;
  Vec3 at;
  std::string hint{};  // where it is not that of the code
};

/// Imprints the components of `complex` on each other, component by component in ascending order.
///
///  (1) Symbols first: every new vertex is "edge e of one meets face f of the other", "node n lies
///      on edge e" and so on; faces that share an edge agree on it by construction.
///  (2) Incidences within the tolerance (features) or the weld length (everything) are decided
///      first and declared; signs of what is left come from exact predicates.
///  (3) Free edges that end within the tolerance of another component are extended to it along their
///      own surface, each vertex by at most twice the tolerance; those of the mesh of component 0 never.
///      All other vertices of earlier components stay, and of later ones move at most by the tolerance.
///      Every move is listed.
///  (4) On each component that a vertex comes to lie on it is in the groups that all vertices of the
///      edge or face beneath it are in, on that component (Complex::groups_on).
///
///  (5) Vertices of the input keep their ids; one that was replaced stays behind without faces. The
///      pieces of a face stand where the face stood.
///  (6) The tolerance counts in full for the extension of free edges and where faces lie on each other, else
///      up to a quarter of the local edge length. A gap within it that is not closed all the same, because it
///      is wider, or because details smaller than the tolerance stand in the way (two edges of one component
///      nearer to each other than that), is listed in `left_open`.
///
///  (7) A tolerance that would weld two sides of one component together is a fault, with their distance.
///
/// Frozen vertices are not moved; a junction that reaches one is cut like any other, the faces are
/// then simply split. Faults: kOverlap (coplanar or nearly parallel faces share area; see pocket_fault()),
/// kDegenerateFace and kDuplicateFace (near the junction), kUsage (mode, tolerance), kJunctionNotResolved.
[[nodiscard]] tl::expected<Corefined, JunctionFault> corefine(const Complex& complex, GroupSets& groups,
                                                              const CorefineOptions& options);

}  // namespace meshgraft
