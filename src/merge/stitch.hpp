// The remeshed zone put back between what was left of the inputs, written down as a difference.
#pragma once

#include <vector>

#include "core/complex.hpp"
#include "intersect/corefine.hpp"
#include "merge/inputs.hpp"
#include "meshgraft/graft.hpp"

namespace meshgraft {

/// How a graft and the final complex correspond.
struct Stitched {
  static constexpr std::uint32_t kKept = 0xFFFFFFFF;
  std::vector<std::uint32_t> new_element;  // by face: position in Graft::new_elements, or kKept
  std::vector<std::uint8_t> changed;       // by face: 1 if it is new, or kept with a corner at another place
  std::vector<NodeRef> node;               // by vertex: input node or {kNew, position}; invalid if unused

  /// Nodes that had to stay but are in no vertex of the final complex; empty unless a step before
  /// broke its word.
  std::vector<NodeRef> lost_nodes;
};

/// Compares the complex before (`original`, the workpiece) and after (`final_complex`).
///
///  (1) A face is kept if it has the nodes of its parent, or those that replaced them, in the same
///      orientation; a line, if in the same order. Every other face and line is new; faces and
///      lines of the workpiece not kept are removed.
///  (2) A vertex is the node it descends from if it stands where that stood or was pulled to; also
///      a vertex put, by chance, exactly where a node was that would be removed otherwise.
///  (3) A node of the workpiece that no face or line uses any more is removed, unless other elements use it.
///  (4) New elements stand in the order of their parents, new nodes in the order of first use.
///  (5) Nodes of parts that became one with another node are replaced by it.
///  (6) New elements and new nodes have the group sets of the final complex.
///
/// `graft` has its group tables already and receives everything but `joined_nodes`.
[[nodiscard]] Stitched stitch(Inputs inputs, const Complex& original, const Corefined& corefined,
                              const Complex& final_complex, Graft& graft);

}  // namespace meshgraft
