// Elements taken out of the inputs beside the zone, and the nodes that nothing uses then.
#pragma once

#include <span>
#include <vector>

#include "merge/inputs.hpp"
#include "meshgraft/graft.hpp"

namespace meshgraft {

/// Adds elements to those that the graft removes, and to its removed nodes those nodes of removed
/// elements that no element that stays or is new uses, be it for orientation.
///
///   elements   by input, ascending; inputs at the end that lose nothing beside the zone are left out
///
/// Cost: one pass over the elements of each of these inputs.
void remove_elements(Inputs inputs, std::span<const std::vector<ElementId>> elements, Graft& graft);

}  // namespace meshgraft
