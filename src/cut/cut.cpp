#include "meshgraft/cut.hpp"

#include <algorithm>
#include <array>

#include "core/append.hpp"
#include "core/components.hpp"
#include "core/summary.hpp"
#include "cut/base_pieces.hpp"
#include "cut/cut_complex.hpp"
#include "cut/cut_edges.hpp"
#include "cut/elements.hpp"
#include "cut/entries.hpp"
#include "cut/grazed.hpp"
#include "cut/round.hpp"
#include "cut/sides.hpp"
#include "cut/take_out.hpp"
#include "cut/tool_surface.hpp"
#include "geometry/triangle_surface.hpp"
#include "merge/compatibility.hpp"
#include "merge/conclude.hpp"
#include "merge/faults.hpp"
#include "merge/ground.hpp"
#include "merge/segments.hpp"
#include "merge/unsupported.hpp"
#include "search/workpiece.hpp"
#include "zone/ruler.hpp"

namespace meshgraft {
namespace {

/// What is wrong with the inputs before anything is cut, and the tool. One made from numbers has no units and no scale.
Result<ToolSurface> checked_tool(const Model& base, const CutTool& from, const CutOptions& options) {
  if (const auto ok = check_compatible(std::array{&base}, options.zone); !ok) return Failure(ok.error());
  auto tool = tool_surface(base, from);
  if (!tool || !std::holds_alternative<const Model*>(from)) return tool;
  if (const auto ok = check_compatible(std::array<const Model*, 2>{&base, &tool->model}, options.zone); !ok)
    return Failure(ok.error());
  return tool;
}

std::vector<Triangle> triangles_of(const Model& model) {
  std::vector<Triangle> triangles;
  for (std::size_t f = 0; f < model.n_elements(); ++f) triangles.push_back(model.corners(ElementId(f)));
  return triangles;
}

/// The base cut along the tool, with the pieces that go marked.
struct Incision {
  Complex original;  // the workpiece of the base
  MarkedCut marked;
  DroppedElements elements;
  std::vector<std::array<VertexId, 2>> border;  // of what goes and what stays
  std::vector<DroppedEntry> entries;
  std::vector<Warning> warnings;
};

/// The tolerance only spares slivers between the cut and what is near it. Where details of the base are
/// finer, it bends the tool more than its faces can follow, and where the base is nearly parallel to the tool, it takes
/// for one surface what crosses: then a smaller one is tried.
tl::expected<Corefined, JunctionFault> corefined_with_tool(const Complex& complex, GroupSets& sets,
                                                           const MergeOptions& zone) {
  constexpr int kMostAttempts = 3;
  constexpr double kNextShare = 0.1;
  CorefineOptions options;
  options.mode = Mode::kFaceEdge;  // faces of the base that lie on the tool are on neither side of it
  options.leaves_pockets = true;
  options.tolerance = zone.tolerance;
  options.contact_angle = zone.contact_angle;
  for (int attempt = 1;; ++attempt) {
    auto corefined = corefine(complex, sets, options);
    const bool settled =
        corefined || (corefined.error().code != ErrorCode::kJunctionNotResolved &&
                      corefined.error().code != ErrorCode::kOverlap && corefined.error().code != ErrorCode::kUsage);
    if (settled || attempt == kMostAttempts) return corefined;
    options.tolerance.value *= kNextShare;
  }
}

/// Where a mesh of the base crosses itself, two curves cross on a face of the tool without a common vertex.
std::string hint_for_cut(const JunctionFault& fault) {
  const std::string hint = hint_for_place(OperationKind::kCut);
  const bool of_tool =
      !fault.elements.empty() && std::ranges::all_of(fault.elements, [](ElementRef e) { return e.input == kTool; });
  if (!of_tool) return hint;
  return "if a mesh crosses or touches itself there, join it with itself first: meshgraft merge BASE --join "
         "GROUP_A:GROUP_B -o JOINED; else " +
         hint;
}

Result<Incision> incise(const Model& base, const ToolSurface& tool, const CutOptions& options, const GroupTable& table,
                        GroupSets& sets) {
  const std::vector<const Model*> with_tool{&base, &tool.model}, alone{&base};
  const std::vector<NearPair> near = near_tool(base, tool, options.zone.tolerance);
  const std::vector<std::vector<ElementId>> cut_faces{faces_of_base(near)};
  if (const auto ok = check_local_scale(alone, cut_faces, options.zone); !ok) return Failure(ok.error());
  WorkpieceOptions workpiece_options;
  if (options.zone.bandwidth)
    workpiece_options.reach = std::max(workpiece_options.reach, 1.0 + *options.zone.bandwidth);
  Incision out;
  out.original =
      workpiece(alone, FaceRuns(alone), one_for_each_input(1), cut_faces, table.of_input, sets, workpiece_options);
  Complex both = out.original;
  add_tools(tool.model, near, both);

  auto corefined = corefined_with_tool(both, sets, options.zone);
  if (!corefined) {
    Error error = to_error(with_tool, corefined.error());
    if (error.code == ErrorCode::kOverlap) error.hint = "the tool lies on faces of the base there; move it off them";
    if (error.code == ErrorCode::kJunctionNotResolved) error.hint = hint_for_cut(corefined.error());
    return Failure(std::move(error));
  }
  const std::uint32_t component = unite_components(corefined->complex);
  out.warnings = leave_grazed(base, component, options.zone.tolerance, *corefined);

  const Complex& complex = corefined->complex;
  const BasePieces pieces = base_pieces(base, complex, corefined->junction_edges, component);
  const TriangleSurface surface(triangles_of(tool.model));
  const auto sides = tool.closed ? Result<std::vector<ToolSide>>(sides_of_closed(pieces, surface))
                                 : sides_of_open(pieces, *corefined, component, tool.model.path);
  if (!sides) return Failure(sides.error());
  const auto goes = dropped_pieces(base, pieces, complex, *sides, tool.model.path, options.drop);
  if (!goes) return Failure(goes.error());
  auto elements = dropped_elements(base, complex, pieces, *goes, surface, tool.closed, options.drop);
  if (!elements) return Failure(elements.error());
  out.elements = std::move(*elements);

  std::vector<std::uint8_t> face_goes(complex.n_faces());
  for (std::size_t f = 0; f < face_goes.size(); ++f)
    face_goes[f] = pieces.of_face[f] != BasePieces::kNone ? (*goes)[pieces.of_face[f]] : 0;
  out.marked = without_tool(out.original, *corefined, face_goes, component);
  out.border = border_of(out.marked.corefined.complex, out.marked.goes);
  if (tool.round) round_border(out.original, out.border, *tool.round, out.marked.corefined.complex);
  out.entries = entries_of(base, complex, out.marked.corefined.complex.position, pieces, *goes);
  return out;
}

/// Takes out what is marked.
Dropped take_out(Incision& incision, const Graft& graft) {
  Corefined& corefined = incision.marked.corefined;
  Dropped dropped;
  std::erase_if(corefined.complex.lines, [&](const Complex::Line& line) {
    return std::ranges::binary_search(incision.elements.elements, line.parent.element);
  });
  drop_faces(corefined, incision.marked.goes, graft.group_sets, graft.groups.size(), dropped);
  dropped.elements = {incision.elements.elements};
  corefined.junction_edges = incision.border;
  return dropped;
}

/// Where the cut is now. On a face that the tool touches at a small angle it is far from where it was.
std::vector<Segment> segments_of(const Complex& complex, const Junction& cut) {
  std::vector<Segment> segments;
  for (const JunctionEdge& e : cut.edges)
    segments.push_back({complex.position[e.ends[0].value], complex.position[e.ends[1].value]});
  return segments;
}

/// Area between a curved border and its chords.
double slack_of(const Complex& complex, const Junction& cut) {
  constexpr double kSegment = 2.0 / 3.0;  // area of a flat segment over chord x sagitta
  double sum = 0;
  for (const JunctionEdge& e : cut.edges)
    sum += squared_norm(complex.position[e.ends[1].value] - complex.position[e.ends[0].value]);
  return kSegment * RulerOptions{}.max_sagitta * sum;
}

}  // namespace

Result<Merged> cut(const Model& base, const CutTool& from, const CutOptions& options) {
  Merged merged;
  Report& report = merged.report;
  Graft& graft = merged.graft;
  Stopwatch watch(options.zone.progress);

  watch.start("search", 0);
  const auto tool = checked_tool(base, from, options);
  if (!tool) return Failure(tool.error());
  const std::vector<const Model*> inputs{&base}, with_tool{&base, &tool->model};
  if (const auto ok = check_meeting_elements(with_tool, one_for_each_input(2), options.zone.tolerance); !ok)
    return Failure(ok.error());
  Ground ground(inputs, merged);
  if (const auto* model = std::get_if<const Model*>(&from)) report.inputs.push_back(counts_of(**model));

  watch.start("intersect", 0.2);
  auto incision = incise(base, *tool, options, ground.table, graft.group_sets);
  if (!incision) return Failure(incision.error());
  report.dropped = std::move(incision->entries);
  append(report.warnings, std::move(incision->warnings));
  append(report.warnings, std::move(incision->elements.warnings));
  Dropped dropped = take_out(*incision, graft);
  const Corefined& corefined = incision->marked.corefined;

  watch.start("remesh", 0.3);
  auto remeshed_zone = remesh_zone(incision->original, corefined, graft.group_sets, options.zone);
  if (!remeshed_zone) return Failure(to_error(inputs, remeshed_zone.error()));
  RemeshedZone& zone = *remeshed_zone;
  const Junction junction = cut_edges(zone.remeshed.complex, dropped.borders);
  if (tool->round) {
    round_nodes(incision->original, junction, *tool->round, zone.remeshed.complex);
    append(dropped.borders, segments_of(zone.remeshed.complex, junction));
  }
  dropped.slack = slack_of(zone.remeshed.complex, junction);

  const Components components = one_for_each_input(1);
  Operation operation{inputs, components, incision->original, corefined, zone, dropped, ground, options.zone};
  operation.kind = OperationKind::kCut;
  if (const auto ok = conclude(operation, watch, merged); !ok) return Failure(ok.error());
  report.junction = polylines_of(zone.remeshed.complex, junction, components);
  for (PolylineSummary& line : report.junction) line.kind = "cut";
  return merged;
}

}  // namespace meshgraft
