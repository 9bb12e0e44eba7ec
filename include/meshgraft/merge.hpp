// The merge of parts onto a base: the paper's three steps in one call.
#pragma once

#include <span>

#include "meshgraft/graft.hpp"
#include "meshgraft/model.hpp"
#include "meshgraft/options.hpp"
#include "meshgraft/report.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

struct Merged {
  Graft graft;
  Labels labels;
  Report report;  // check report.broken_promises before the result is used
};

/// Grafts `parts` onto `base` (paper, section 4: detect and intersect, clean, remesh). Without parts
/// the connected meshes of `base` are joined with each other; see also MergeOptions::joins.
///
///  (1) The inputs are only read. Nothing outside the zone is named in the graft.
///  (2) New faces have Q >= options.min_quality, or the report says where not, and why.
///  (3) Every new entity has a parent and the groups and attributes of that parent.
///  (4) The same inputs and options give the same graft, whatever the number of threads.
///
/// Errors: kUsage, kNoFaces, kPartsApart, kOverlap, kUnitsDiffer, kCoordinateSystem,
/// kScaleMismatch, kDegenerateFace, kDuplicateFace, kUnsupportedElement, kJunctionNotResolved, kLabelOverflow.
[[nodiscard]] Result<Merged> merge(const Model& base, std::span<const Model> parts, const MergeOptions& options = {});

/// The merged model as arrays: kept entities in input order, new ones after them.
[[nodiscard]] Model apply(const Model& base, std::span<const Model> parts, const Merged& merged);

}  // namespace meshgraft
