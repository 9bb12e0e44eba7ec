#include "merge/conclude.hpp"

#include <tbb/parallel_invoke.h>

#include "core/append.hpp"
#include "geometry/quality.hpp"
#include "merge/coverage.hpp"
#include "merge/creases.hpp"
#include "merge/faults.hpp"
#include "merge/fidelity.hpp"
#include "merge/fine_zone.hpp"
#include "merge/labels.hpp"
#include "merge/ledger.hpp"
#include "merge/loose_pieces.hpp"
#include "merge/mended_faces.hpp"
#include "merge/near_misses.hpp"
#include "merge/node_groups.hpp"
#include "merge/outcome.hpp"
#include "merge/overlaps.hpp"
#include "merge/quality_summary.hpp"
#include "merge/removal.hpp"
#include "merge/report_summary.hpp"
#include "merge/result_check.hpp"
#include "merge/stitch.hpp"
#include "merge/trim.hpp"

namespace meshgraft {
namespace {

/// The largest bandwidth of the components of each input.
std::vector<int> by_input(const std::vector<int>& bandwidth, const Components& components) {
  std::vector<int> largest(components.input_order.size(), 0);
  for (std::size_t c = 0; c < bandwidth.size(); ++c)
    largest[components.input[c]] = std::max(largest[components.input[c]], bandwidth[c]);
  return largest;
}

/// The remesher's word on poor faces, also on those that were laid over them, and over poor ones of the input.
std::vector<BadFace> bad_faces(Inputs inputs, const Remeshed& remeshed, const LaidOut& laid_out, double min_quality) {
  std::vector<BadFace> all = remeshed.bad;
  const std::size_t first = remeshed.complex.n_faces();
  for (const BadFace& bad : remeshed.bad)
    for (std::size_t i = 0; i < laid_out.beneath.size(); ++i)
      if (laid_out.beneath[i] == bad.face) all.push_back({FaceId(first + i), bad.q, bad.cause});
  for (std::size_t i = 0; i < laid_out.beneath.size(); ++i) {
    const FaceId beneath = laid_out.beneath[i];
    const double q = aspect_ratio(remeshed.complex.corners(beneath));
    if (remeshed.in_zone[beneath.value] != 0 || q >= min_quality) continue;
    all.push_back(
        {FaceId(first + i),
         q,
         {Cause::Kind::kInputDetail,
          "on the nodes of " + text_of(inputs, remeshed.complex.parent[beneath.value]) + ", which stays as it is"}});
  }
  return all;
}

/// Areas that the method left as they were cut.
void tell(std::span<const Unfilled> unfilled, Report& report) {
  for (const Unfilled& u : unfilled)
    report.warnings.push_back({name(ErrorCode::kContourNotFilled),
                               "the area around " + text_of(u.at) + " is left as it was cut: " + u.why,
                               {}});
}

/// Everything that can be said against the result, and the figures that go with it.
void judge(const Outcome& outcome, std::span<const BadFace> bad, SetTranslation& translated,
           const MergeOptions& options, Report& report) {
  append(report.broken_promises, open_gap_errors(outcome.inputs, outcome.corefined.left_open));
  append(report.warnings, half_reached_warnings(outcome.inputs, outcome.corefined.half_reached));
  append(report.warnings, joined_seam_warnings(outcome.inputs, outcome.corefined.joined_seams));
  ResultVerdict result;
  QualityVerdict quality;
  FidelityVerdict fidelity;
  CoverageVerdict coverage;
  std::vector<Warning> loose_pieces, fine_zones, loose_ends, near_misses, creases, flat_faces;
  Tolerance drawn = options.tolerance;
  drawn.value *= static_cast<double>(gaps_in_a_row(outcome.corefined));
  tbb::parallel_invoke(
      [&] { result = check_result(outcome, translated, drawn); }, [&] { fidelity = fidelity_of(outcome, drawn); },
      [&] { coverage = coverage_of(outcome, options.tolerance); },
      [&] { loose_ends = loose_end_warnings(outcome, options.tolerance); },
      [&] { loose_pieces = loose_piece_warnings(outcome); }, [&] { flat_faces = flat_face_warnings(outcome); },
      [&] {
        if (!options.size && outcome.kind != OperationKind::kFill) fine_zones = fine_zone_warnings(outcome);
      },
      [&] { near_misses = near_miss_warnings(outcome, options.tolerance); },
      [&] { creases = crease_warnings(outcome); }, [&] { quality = quality_of(outcome, bad, options.min_quality); },
      [&] { summarise(outcome, report); });
  append(report.warnings, std::move(loose_pieces));
  append(report.warnings, mended_face_warnings(outcome));
  append(report.warnings, std::move(flat_faces));
  append(report.warnings, std::move(fine_zones));
  append(report.broken_promises, std::move(result.broken));
  append(report.warnings, std::move(result.warnings));
  append(report.warnings, std::move(loose_ends));
  append(report.warnings, std::move(near_misses));
  append(report.warnings, std::move(creases));
  report.quality = std::move(quality.summary);
  append(report.broken_promises, std::move(quality.broken));
  append(report.warnings, std::move(quality.warnings));
  if (outcome.kind != OperationKind::kFill) {
    report.fidelity = fidelity.figures;
    report.fidelity->removed = coverage.figures;
  }
  append(report.broken_promises, std::move(fidelity.broken));
  append(report.broken_promises, std::move(coverage.broken));
}

}  // namespace

Result<void> conclude(const Operation& operation, Stopwatch& watch, Merged& merged) {
  const auto& [inputs, components, original, corefined, zone, dropped, ground, options, kind] = operation;
  SetTranslation& translated = ground.translated;
  Report& report = merged.report;
  Graft& graft = merged.graft;
  report.zone.bandwidth = by_input(zone.bandwidth, components), report.zone.widened = zone.widened;
  const bool all_layers = options.overlap == Overlap::kProject && !zone.remeshed.complex.layers.empty();
  const LaidOut laid_out = all_layers ? with_layers(zone.remeshed.complex, inputs, translated) : LaidOut{};
  const Complex& final_complex = all_layers ? laid_out.complex : zone.remeshed.complex;

  watch.start("stitch", 0.8);
  const Stitched stitched = stitch(inputs, original, corefined, final_complex, graft);
  remove_elements(inputs, dropped.elements, graft);
  assign_node_groups(inputs, translated, final_complex, stitched, graft);
  merged.labels = ground.accounts.labels();
  if (const auto ok = check_room(merged.labels, graft); !ok) return Failure(ok.error());

  watch.start("check", 0.9);
  Outcome outcome{inputs, components,    original, corefined, NodePlaces(inputs, corefined), final_complex, stitched,
                  graft,  merged.labels, dropped,  all_layers};
  outcome.kind = kind, outcome.beneath_last = laid_out.beneath;
  tell(zone.unfilled, report);
  judge(outcome, bad_faces(inputs, zone.remeshed, laid_out, options.min_quality), translated, options, report);
  report.overlaps = overlap_entries(inputs, components, corefined, zone.remeshed.complex, all_layers);
  Dropped overlaid = dropped;
  add_losses(inputs, corefined, final_complex, all_layers, translated, graft, overlaid);
  add_stretch(original, corefined, outcome.places, graft.group_sets, graft.groups.size(), overlaid);
  add_facet_slack(corefined.complex, outcome.places, graft.group_sets, graft.groups.size(), overlaid);
  if (!all_layers) append(report.warnings, attribute_warnings(inputs, final_complex));
  Ledger ledger = ledger_of(inputs, ground.accounts.sums(), graft, overlaid);
  report.groups = std::move(ledger.groups);
  append(report.broken_promises, std::move(ledger.broken));
  append(report.warnings, std::move(ledger.warnings));

  if (!report.broken_promises.empty())
    if (auto flat = flat_face_error(inputs, graft)) return Failure(std::move(*flat));

  watch.stop();
  report.timings = watch.timings();
  report.peak_memory_bytes = peak_memory_bytes();
  return {};
}

}  // namespace meshgraft
