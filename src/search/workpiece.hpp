// Cuts the part of all inputs that a merge can touch out of the models.
#pragma once

#include <span>
#include <vector>

#include "core/complex.hpp"
#include "core/components.hpp"
#include "meshgraft/graft.hpp"
#include "meshgraft/model.hpp"
#include "search/face_runs.hpp"

namespace meshgraft {

struct WorkpieceOptions {
  /// In longest edges of the candidate faces: how far around them. A zone goes no farther than six
  /// neighbourhoods by itself (WidenLimits); a bandwidth that the user asks for may need more.
  double reach = 6;
  double least = 0;  // a length: at least this far
};

/// The faces around `candidates` (by input, see candidate_faces), with the 1D elements on them and
/// the constraints that other elements put on their nodes.
///
///  (1) A vertex that is not kFrozen has all its faces and lines in the complex.
///  (2) Every face whose box comes within reach of a candidate is there, so that nothing near the
///      zone is overlooked.
///  (3) Group sets are translated to merged groups. Vertices and faces stand in the order of
///      Components::input_order, so that the order of the parts changes nothing.
///
/// Nodes used by elements other than faces and lines, and orientation nodes, are kPinned.
/// Cost: one linear pass over nodes and elements; memory beyond it proportional to the result.
///
/// `runs`: of these inputs. `groups_of_input[k][g]` is the merged group of group g of input k.
[[nodiscard]] Complex workpiece(std::span<const Model* const> inputs, const FaceRuns& runs,
                                const Components& components, std::span<const std::vector<ElementId>> candidates,
                                std::span<const std::vector<GroupId>> groups_of_input, GroupSets& merged_sets,
                                const WorkpieceOptions& options = {});

}  // namespace meshgraft
