// Free edges that stop short of another mesh, or stick out beyond it, brought onto it along their own surface.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "intersect/meeting.hpp"

namespace meshgraft {

/// Where a vertex of a free edge goes so that the edge ends on another mesh.
struct Extension {
  VertexId vertex;
  Vec3 to;
};

/// What extends free edges to another mesh, in order of the vertices.
struct Extensions {
  std::vector<Extension> moved;
  std::vector<std::uint32_t> ended_on;  // components that those ended on, ascending
  std::vector<VertexId> bends;          // stay, and the free edge that is extended beside them turns in them now
  std::vector<VertexId> last;           // in reach, of edges that go on out of reach
  std::vector<Corefined::HalfReached> half_reached;  // the other ends of these edges, each once
};

/// Over the tolerance: how far a leaning part may go along itself, which is farther than the gap is wide. This is a
/// part that leans 30 degrees.
inline constexpr double kLongestWay = 2;

/// Lengths of extension.
struct ExtendRule {
  const Tolerance& tolerance;  // by the smaller of the mean edge lengths of the faces across the gap
  const SnapRule& snap;        // what is nearer than its weld length is there already
  double longest_way = kLongestWay;
  /// Faces of the other surface flatter than this to the face at a free edge are none that it ends on. Radians.
  double least_angle = 0;
};

/// By face of the complex, whether it is of the component or hangs together with it without being joined to it.
[[nodiscard]] std::vector<std::uint8_t> faces_with(const Complex& complex, std::uint32_t component);

/// Extensions of the free edges of `own`, faces of one component, to the surface of `other`.
///
///  (1) An edge is extended if both its ends are within the tolerance of the other surface and it runs
///      along that (60 to 90 degrees to its normal): it ends there. What passes it does not, nor does the
///      steeper edge of an acute corner, as the slope of a gusset. The edge beside it, with one end in reach, leaves
///      the surface from there, or is extended straight on where the surface ends beneath it.
///  (2) A vertex goes along the tangent plane of its faces, across its free edge; at a corner along the other
///      free edge, so that this stays straight (but not where it is within 17 degrees of the surface); where both
///      edges end, to where their ways meet.
///  (3) Where that way meets nothing, as between plates side by side, it goes to the nearest point of the
///      other surface, if that lies in its tangent plane.
///  (4) No face of `own` turns over or loses most of its height: such vertices stay.
///
/// `owns`: by face, whether it goes with `own`: what hangs together with it counts in telling free edges. `exact`: by
/// face, whether gaps at it are left open; may be empty. Vertices that are frozen, or of faces that `owns` leaves out,
/// stay.
[[nodiscard]] Extensions extensions(const Complex& complex, std::span<const FaceId> own, std::span<const FaceId> other,
                                    std::span<const std::uint8_t> owns, std::span<const double> size,
                                    std::span<const std::uint8_t> exact, const ExtendRule& rule);

}  // namespace meshgraft
