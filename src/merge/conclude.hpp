// The last steps of every operation: from the remeshed zone to the graft, its labels and the report.
#pragma once

#include "core/components.hpp"
#include "merge/dropped.hpp"
#include "merge/ground.hpp"
#include "merge/inputs.hpp"
#include "merge/operation_kind.hpp"
#include "merge/remesh_zone.hpp"
#include "merge/stopwatch.hpp"
#include "meshgraft/merge.hpp"

namespace meshgraft {

/// What an operation has done so far.
struct Operation {
  Inputs inputs;
  const Components& components;
  const Complex& original;     // the workpiece
  const Corefined& corefined;  // the same, cut along the junction, without what was dropped
  const RemeshedZone& zone;
  const Dropped& dropped;
  Ground& ground;
  const MergeOptions& options;
  OperationKind kind = OperationKind::kMerge;
};

/// Stitches, gives labels, checks, and completes the report with all that is told by these; `merged`
/// has the groups of the graft already. Errors kLabelOverflow, and
/// kDegenerateFace where promises are broken and a face without area had to be remeshed.
[[nodiscard]] Result<void> conclude(const Operation& operation, Stopwatch& watch, Merged& merged);

}  // namespace meshgraft
