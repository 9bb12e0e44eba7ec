// Two meshes that lie on each other made one over the area of contact (paper 4, face/face).
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "intersect/imprint.hpp"
#include "intersect/meeting.hpp"

namespace meshgraft {

/// Two sides of a complex: the faces that may meet, ascending, and which faces of the complex belong to each.
struct Sides {
  std::array<std::vector<FaceId>, 2> faces;
  std::array<std::vector<std::uint8_t>, 2> own;
  std::span<const VertexId> rims{};  // ends on third meshes that have been drawn there, ascending; see find_rims()
};

struct Overlaid {
  bool any = false;                               // the sides lie on each other somewhere
  std::vector<std::pair<VertexId, Vec3>> moved;   // and where they were
  std::vector<std::array<VertexId, 2>> replaced;  // a vertex and what it became
  std::vector<Corefined::Covered> covered;        // as in Corefined; not ascending
  std::vector<Corefined::Traded> traded;          // the same
  std::vector<std::uint32_t> behind;              // components left out; see take_out_behind()
};

/// Finds where the two sides lie on each other, imprints the border of that area on
/// both, and takes one of the two layers out.
///
///  (1) The layer of the first side remains (with Overlap::kKeepPart that of the second); what is left of the
///      other side is joined to it along the border. Faces that stand for both have what they
///      took over among their layers.
///  (2) The border runs along edges of the side that goes (free edges, and edges beyond which the
///      sides diverge) and along edges where the surface of the side that stays ends.
///  (3) With Overlap::kFuse and kProject, borders of groups and attributes, 1D elements and single nodes of
///      node groups of the layer that goes are imprinted on the one that remains.
///
/// `marks` follows the faces. Without any contact nothing is changed. After a fault the complex is
/// half done. Cost n log n in the faces whose boxes meet.
[[nodiscard]] tl::expected<Overlaid, ImprintFault> overlay(Complex& complex, GroupSets& groups, FaceMarks& marks,
                                                           const Sides& sides, const SnapRule& snap,
                                                           const CorefineOptions& options);

}  // namespace meshgraft
