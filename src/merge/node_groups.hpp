// Node groups of nodes that are new, that stay, or that take the place of others.
#pragma once

#include "core/complex.hpp"
#include "merge/group_table.hpp"
#include "merge/stitch.hpp"
#include "meshgraft/graft.hpp"

namespace meshgraft {

/// Completes the groups of `graft.new_nodes` and fills `graft.joined_nodes`.
///
///  (1) A node that stays keeps the groups that its input gives it.
///  (2) It joins those that its vertex has in the final complex beyond these (it lies between
///      nodes of the group on another input), and those of nodes it replaces.
///  (3) A node group that covered an element group in an input (all nodes of all members were in
///      it) still covers it: every node of a new member is in it.
void assign_node_groups(Inputs inputs, SetTranslation& translated, const Complex& final_complex,
                        const Stitched& stitched, Graft& graft);

}  // namespace meshgraft
