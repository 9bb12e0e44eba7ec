#include "meshgraft/fill.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "core/components.hpp"
#include "core/summary.hpp"
#include "fill/patched.hpp"
#include "geometry/quality.hpp"
#include "merge/compatibility.hpp"
#include "merge/conclude.hpp"
#include "search/workpiece.hpp"
#include "zone/edge_table.hpp"

namespace meshgraft {
namespace {

std::string number_of(std::size_t k) { return "contour " + std::to_string(k + 1); }

Place place_of_contour(const Model& base, const Contour& c) { return place_of(base, c.nodes.front()); }

/// The contours to fill, ascending; warnings for those that are not.
Result<std::vector<std::size_t>> chosen(const Model& base, std::span<const Contour> all, const FillOptions& options,
                                        std::vector<Warning>& warnings) {
  std::vector<std::size_t> result = options.contours;
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  for (const std::size_t k : result) {
    if (k >= all.size())
      return failure(ErrorCode::kUsage,
                     "there is no " + number_of(k) + " in " + base.path + "; it has " + std::to_string(all.size()),
                     "list them with meshgraft fill FILE --list", {});
    if (!all[k].is_fillable)
      return failure(ErrorCode::kUnsupportedElement,
                     number_of(k) + " runs along elements that are not linear triangles",
                     "fill it before these are made, or leave it out", place_of_contour(base, all[k]));
  }
  if (!result.empty()) return result;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].is_hole && all[k].is_fillable)
      result.push_back(k);
    else
      warnings.push_back({"left-open",
                          number_of(k) + " around " + text_of(all[k].centre) + " is left open: " +
                              (all[k].is_hole ? "elements along it are not linear triangles"
                                              : "it is an outer border, or the end of a pipe; name it to fill it"),
                          place_of_contour(base, all[k])});
  if (result.empty())
    return failure(ErrorCode::kUsage, "nothing to fill in " + base.path,
                   all.empty() ? "it has no free edges"
                               : "its contours are outer borders or run along other elements; name one with --contour",
                   {});
  return result;
}

/// Faces with a node of one of the contours, ascending.
std::vector<ElementId> faces_at(const Model& base, std::span<const Contour> all, std::span<const std::size_t> which) {
  std::vector<std::uint8_t> marked(base.n_nodes(), 0);
  for (const std::size_t k : which)
    for (const NodeId n : all[k].nodes) marked[n.value] = 1;
  std::vector<ElementId> faces;
  for (std::size_t e = 0; e < base.n_elements(); ++e)
    if (base.is_face(ElementId(e)) &&
        std::ranges::any_of(base.nodes_of(ElementId(e)), [&](NodeId n) { return marked[n.value] != 0; }))
      faces.emplace_back(e);
  return faces;
}

std::vector<Rim> rims_of(const Complex& complex, std::span<const Contour> all, std::span<const std::size_t> which) {
  std::map<NodeId, VertexId> vertex;
  for (std::size_t v = 0; v < complex.n_vertices(); ++v)
    if (complex.node[v].valid()) vertex[complex.node[v].node] = VertexId(v);
  const EdgeTable edges(complex);
  std::vector<Rim> rims;
  for (const std::size_t k : which) {
    Rim& rim = rims.emplace_back();
    for (const NodeId n : all[k].nodes) rim.vertices.push_back(vertex.at(n));
    for (std::size_t i = 0; i < rim.vertices.size(); ++i)
      rim.faces.push_back(
          edges.uses(edges.find(rim.vertices[i], rim.vertices[(i + 1) % rim.vertices.size()])).front().face);
  }
  return rims;
}

/// New vertices are in the node groups that all vertices of the rims next to them are in.
void give_node_groups(const Complex& around, std::span<const Rim> rims, Complex& complex, GroupSets& sets) {
  for (std::size_t v = 0; v < complex.n_vertices(); ++v) {
    if (complex.node[v].valid()) continue;
    const auto distance_to = [&](const Rim& rim) {
      double least = std::numeric_limits<double>::infinity();
      for (const VertexId u : rim.vertices)
        least = std::min(least, distance(around.position[u.value], complex.position[v]));
      return least;
    };
    const Rim& rim = *std::ranges::min_element(rims, {}, distance_to);
    GroupSetId common = around.vertex_groups[rim.vertices.front().value];
    for (const VertexId u : rim.vertices) common = sets.intersect(common, around.vertex_groups[u.value]);
    complex.vertex_groups[v] = common;
  }
}

/// Free edges that go, and what groups grow by.
Dropped account(const Complex& around, std::span<const Rim> rims, const Complex& filled, std::size_t n_groups,
                const GroupSets& sets) {
  Dropped d;
  for (const Rim& rim : rims)
    for (std::size_t i = 0; i < rim.vertices.size(); ++i)
      d.free_edges.push_back(
          {around.position[rim.vertices[i].value], around.position[rim.vertices[(i + 1) % rim.vertices.size()].value]});
  d.filled_area.assign(n_groups, 0);
  for (std::size_t f = around.n_faces(); f < filled.n_faces(); ++f)
    for (const GroupId g : sets.members(filled.face_groups[f]))
      d.filled_area[g.value] += area(filled.corners(FaceId(f)));
  return d;
}

std::vector<PolylineSummary> summaries(std::span<const Contour> all, std::span<const std::size_t> which) {
  std::vector<PolylineSummary> lines;
  for (const std::size_t k : which) {
    PolylineSummary& line = lines.emplace_back();
    line.kind = "filled", line.closed = true;
    line.length = all[k].length, line.nodes = all[k].nodes.size();
    line.inputs = {0};
  }
  return lines;
}

}  // namespace

Result<Merged> fill(const Model& base, const FillOptions& options) {
  Merged merged;
  Report& report = merged.report;
  Graft& graft = merged.graft;
  report.version = MESHGRAFT_VERSION;
  Stopwatch watch(options.zone.progress);

  watch.start("search", 0);
  const std::vector<const Model*> inputs{&base};
  if (const auto ok = check_compatible(inputs, options.zone); !ok) return Failure(ok.error());
  report.inputs.push_back(counts_of(base));
  report.warnings = base.warnings;
  const std::vector<Contour> all = contours_of(base);
  const auto which = chosen(base, all, options, report.warnings);
  if (!which) return Failure(which.error());
  const GroupTable table = group_table(inputs);
  graft.groups = table.groups;
  SetTranslation translated(inputs, table, graft.group_sets);
  const Components components = one_for_each_input(1);
  const Complex around = workpiece(inputs, components, std::vector<std::vector<ElementId>>{faces_at(base, all, *which)},
                                   table.of_input, graft.group_sets);
  const std::vector<Rim> rims = rims_of(around, all, *which);

  watch.start("fill", 0.2);  // paper 5.5
  auto coarse = patched(around, rims, graft.group_sets);
  if (!coarse) {
    const std::size_t k = (*which)[coarse.error()];
    return failure(ErrorCode::kJunctionNotResolved,
                   number_of(k) + " around " + text_of(all[k].centre) + " cannot be filled along the surface around it",
                   "leave it out with --contour, or mend the faces along it", place_of_contour(base, all[k]));
  }

  watch.start("remesh", 0.3);  // paper 5.6
  const Sizing sizing = rim_sizing(around, rims, options.zone.size);
  RemeshedZone zone;
  zone.remeshed = shaped(*coarse, sizing, graft.group_sets, options.zone);
  zone.bandwidth = {0};
  give_node_groups(around, rims, zone.remeshed.complex, graft.group_sets);
  Corefined corefined;
  corefined.complex = std::move(coarse->complex);
  corefined.touched.assign(corefined.complex.n_faces(), 0);
  const Dropped dropped = account(around, rims, zone.remeshed.complex, graft.groups.size(), graft.group_sets);
  Operation operation{inputs, components, around, corefined, zone, dropped, translated, options.zone};
  operation.fills = true;
  if (const auto ok = conclude(operation, watch, merged); !ok) return Failure(ok.error());
  report.junction = summaries(all, *which);
  return merged;
}

}  // namespace meshgraft
