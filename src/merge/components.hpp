// What is joined with what: whole inputs, the connected meshes of one input, or groups of them.
#pragma once

#include "core/components.hpp"
#include "merge/inputs.hpp"
#include "meshgraft/options.hpp"
#include "meshgraft/report.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

/// The base and each part is a component. A single input falls apart into its connected meshes:
/// faces connected through nodes that surface elements share. With MergeOptions::joins each of these
/// falls apart again by the named groups its faces are in, and only what they pair is joined.
///
/// The order, base first, then by number of faces, the largest first, then by groups and labels, depends neither on
/// that of the parts nor on where all of them are. Error kUsage if a named group does not exist or has no triangle.
[[nodiscard]] Result<Components> components_of(Inputs inputs, const MergeOptions& options);

/// For the report; component by component.
[[nodiscard]] std::vector<ComponentSummary> summaries_of(Inputs inputs, const Components& components);

}  // namespace meshgraft
