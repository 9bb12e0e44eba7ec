#include "meshgraft/merge.hpp"

#include <algorithm>
#include <optional>

#include "merge/compatibility.hpp"
#include "merge/components.hpp"
#include "merge/conclude.hpp"
#include "merge/faults.hpp"
#include "merge/ground.hpp"
#include "merge/overlaps.hpp"
#include "merge/remesh_zone.hpp"
#include "merge/report_summary.hpp"
#include "merge/stopwatch.hpp"
#include "merge/trim.hpp"
#include "merge/unsupported.hpp"
#include "search/candidates.hpp"
#include "search/workpiece.hpp"

namespace meshgraft {
namespace {

/// An error, or a warning if the user allows it.
Result<void> refuse_unless_allowed(const Error& error, const MergeOptions& options, Report& report) {
  if (!options.allow_apart) return Failure(error);
  report.warnings.push_back({name(error.code), error.what + "; left unjoined", error.place});
  return {};
}

/// What was to be joined and meets nothing.
Result<void> check_parts_meet(Inputs inputs, const Components& components, const Corefined& corefined,
                              const MergeOptions& options, Report& report) {
  std::optional<Error> error = nothing_joined(inputs, components, corefined.met, options.joins);
  const std::vector<std::uint32_t> apart = parts_apart(components, corefined.met);
  if (!error && !apart.empty()) error = apart_error(inputs, apart, corefined);
  return error ? refuse_unless_allowed(*error, options, report) : Result<void>();
}

/// Groups of one mesh may meet only where they shared nodes before.
Result<void> check_anything_new(Inputs inputs, const MergeOptions& options, Report& report) {
  if (options.joins.empty() || !report.junction.empty()) return {};
  return refuse_unless_allowed({ErrorCode::kPartsApart,
                                "the groups named by --join share nodes already and meet nowhere else",
                                "name groups that cross, touch or lie on each other",
                                {inputs[0]->path, 0}},
                               options, report);
}

Result<Merged> merge(Inputs inputs, const MergeOptions& options) {
  Merged merged;
  Report& report = merged.report;
  Graft& graft = merged.graft;
  Stopwatch watch(options.progress);

  watch.start("search", 0);
  if (const auto ok = check_compatible(inputs, options); !ok) return Failure(ok.error());
  Ground ground(inputs, merged);
  SearchOptions search_options;
  search_options.tolerance = options.tolerance;
  const Result<Components> components = components_of(inputs, options);
  if (!components) return Failure(components.error());
  if (const auto ok = check_meeting_elements(inputs, *components, options.tolerance); !ok) return Failure(ok.error());
  if (components->are_parted()) report.components = summaries_of(inputs, *components);
  const FaceRuns runs(inputs);
  const auto candidates = candidate_faces(inputs, runs, *components, search_options);
  if (const auto ok = check_local_scale(inputs, candidates, options); !ok) return Failure(ok.error());
  if (const auto ok = check_component_sizes(inputs, *components, candidates, options); !ok) return Failure(ok.error());
  WorkpieceOptions workpiece_options;
  if (options.bandwidth) workpiece_options.reach = std::max(workpiece_options.reach, 1.0 + *options.bandwidth);
  if (options.trim) workpiece_options.least = *options.trim;
  const Complex original =
      workpiece(inputs, runs, *components, candidates, ground.table.of_input, graft.group_sets, workpiece_options);

  watch.start("intersect", 0.2);  // paper 5.1, 5.2
  CorefineOptions corefine_options;
  corefine_options.tolerance = options.tolerance;
  corefine_options.contact_angle = options.contact_angle;
  corefine_options.mode = options.mode, corefine_options.overlap = options.overlap;
  auto corefined = corefine(original, graft.group_sets, corefine_options);
  if (!corefined) return Failure(to_error(inputs, corefined.error()));
  if (const auto ok = check_something_left(inputs, *components, original, *corefined); !ok) return Failure(ok.error());
  if (const auto ok = check_parts_meet(inputs, *components, *corefined, options, report); !ok)
    return Failure(ok.error());

  Dropped dropped;
  if (options.trim) report.dropped = trim(original, *corefined, *options.trim, graft, dropped);

  watch.start("remesh", 0.3);  // paper 5.3 to 5.6
  const auto zone = remesh_zone(original, *corefined, graft.group_sets, options);
  if (!zone) return Failure(to_error(inputs, zone.error()));
  const Operation operation{inputs, *components, original, *corefined, *zone, dropped, ground, options};
  if (const auto ok = conclude(operation, watch, merged); !ok) return Failure(ok.error());
  if (const auto ok = check_anything_new(inputs, options, report); !ok) return Failure(ok.error());
  return merged;
}

}  // namespace

Result<Merged> merge(const Model& base, std::span<const Model> parts, const MergeOptions& options) {
  std::vector<const Model*> inputs{&base};
  for (const Model& part : parts) inputs.push_back(&part);
  return merge(Inputs(inputs), options);
}

}  // namespace meshgraft
