// Remeshing of the zone (paper 5.5, 5.6; method "adaptive"): from a valid but ugly triangulation to
// one fit for analysis, by local steps that never leave validity.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/complex.hpp"
#include "remesh/sizing.hpp"
#include "zone/brep.hpp"
#include "zone/size_field.hpp"

namespace meshgraft {

struct RemeshOptions {
  double min_quality = 0.5;       // wanted worst Q
  double wanted_mean = 0.9;       // mean Q below which fair faces are worked on too
  double max_deviation = 0.065;   // of new faces from the reference surface, share of the edge length of the input
  int edge_samples = 3;           // inside an edge, where its distance from the reference is taken
  bool replaces_input = true;     // faces descend from faces of the input, whose details may excuse poor ones
  std::vector<VertexId> loose{};  // nodes that are not held where a curve turns, ascending
  bool keeps_good = true;         // sheets whose faces are all as they were, and good, keep their vertices
};

/// Why a face is poor, as far as the input is to blame.
struct Cause {
  enum class Kind : std::uint8_t {
    kNone,         // none was found
    kInputAngle,   // two curves of the input make the angle of the face: no mesh is better there
    kInputDetail,  // nodes that must stay are nearer to each other than the sizes are refined for
    kFixedEdges,   // a long edge that must stay is beside short ones
    kFixedNodes,   // nodes that must stay are too near to each other
    kZoneEnd,      // nodes on the boundary of the zone hold it
    kStrip,        // it lies between two curves
  };
  Kind kind = Kind::kNone;
  std::string text;  // "input angle of 9 degrees", ...; empty for kNone
};

struct BadFace {
  FaceId face;  // of Remeshed::complex
  double q = 0;
  Cause cause;
};

struct Remeshed {
  Complex complex;  // vertices no face or line uses any more are left out, except kPinned/kFrozen ones
  std::vector<std::uint8_t> in_zone;  // by face: descends from a zone face
  std::vector<VertexId> let_go;  // of the complex remeshed, ascending: held nodes that poor faces needed in the end
  std::vector<BadFace> bad;      // faces of the zone with Q < min_quality, worst first
  double mean_quality = 1;       // mean Q of the faces that are not as in the input
  double max_deviation = 0;      // of new faces from the reference surface (sampled)
  double max_deviation_relative = 0;  // over the local edge length
  Vec3 deviation_at;
};

/// Remeshes the faces marked in `in_zone`.
///
///   complex   corefined; it is the reference surface too
///   groups    of the complex; intersections for new vertices are added
///
///  (1) Faces outside the zone, corners, frozen and pinned vertices are unchanged. A vertex with a
///      face outside the zone does not move.
///  (2) Conformity holds after every step: a curve's nodes are shared by all its sheets.
///  (3) New vertices lie on the reference surface (sheet) or the reference polyline (curve). Their
///      group set is the intersection of those of the reference face or edge beneath.
///  (4) `parent` of a new face is a parent of its sheet, the one beneath its centroid. Orientation
///      is that of the sheet.
///  (5) 1D elements on resampled curve edges are rebuilt along them: each new edge has one line per
///      line of the old edges, with the parent beneath its middle, in the parent's direction.
///  (6) Inside a sheet that the junction touches, all vertices of the zone that may go are replaced;
///      other sheets change only where their faces are poor.
///  (7) Deterministic.
[[nodiscard]] Remeshed remesh(const Complex& complex, const Brep& brep, const SizeField& size,
                              const std::vector<std::uint8_t>& in_zone, GroupSets& groups,
                              const RemeshOptions& options = {});

/// The same with sizes from elsewhere.
[[nodiscard]] Remeshed remesh(const Complex& complex, const Brep& brep, const Sizing& sizing,
                              const std::vector<std::uint8_t>& in_zone, GroupSets& groups,
                              const RemeshOptions& options = {});

}  // namespace meshgraft
