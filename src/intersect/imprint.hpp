// Rebuilds a complex with the imprint of a meeting.
#pragma once

#include <optional>
#include <vector>

#include "intersect/links.hpp"

namespace meshgraft {

/// What goes with each face of the complex under work; same length as Complex::face.
struct FaceMarks {
  std::vector<double> size;           // mean edge length of the input face
  std::vector<std::uint8_t> touched;  // its input face meets another component
  std::vector<std::uint8_t> active;   // near the other side in the last meeting, or cut out of such a face
  std::vector<FaceId> from;           // the face that it was, or was part of, before its component was joined
  std::vector<std::uint8_t> kept;     // lies in an area of contact that stays as it is; empty: there is none
  std::vector<Reach> reach;           // of what lay on it; empty: nothing lay off any face
  /// Components that lay on it and went without an heir, ascending, as Complex::layers where they have one; empty:
  /// none.
  std::vector<std::vector<std::uint32_t>> over;
  std::vector<Triangle> input;  // its input face, where that was before anything was moved

  /// One more face, like face f of `other`.
  void add(const FaceMarks& other, std::size_t f) {
    size.push_back(other.size[f]), touched.push_back(other.touched[f]), active.push_back(other.active[f]);
    from.push_back(other.from[f]), input.push_back(other.input[f]);
    if (!other.kept.empty()) kept.push_back(other.kept[f]);
    if (!other.reach.empty()) reach.push_back(other.reach[f]);
    if (!other.over.empty()) over.push_back(other.over[f]);
  }
};

/// By face of the complex: its corners, or, of a face with corners that were moved off the plane of its input face,
/// their feet there. What ends on a mesh at a distance is bent beside that; what it lies on is told by how it lay.
[[nodiscard]] std::vector<Triangle> unbent_faces(const Complex& complex, const FaceMarks& marks, const SnapRule& snap);

/// Why an imprint failed.
struct ImprintFault {
  JunctionFault fault;
  FaceId face;  // that cannot be cut; invalid for other faults
};

/// Cuts the faces of both sides, replaces vertices that became one, splits lines along split edges.
/// `marks` follows the faces. Pieces of a face stand where the face stood.
///
/// Faults: kUnsupportedElement if an edge that may not be split has a point, kDegenerateFace or
/// kJunctionNotResolved if a face cannot be cut. The complex is then left half done, but its
/// faces are as they were.
std::optional<ImprintFault> apply(Meeting& meeting, const std::array<Imprint, 2>& imprint, FaceMarks& marks);

}  // namespace meshgraft
