#include "meshgraft/fill.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "core/append.hpp"
#include "core/components.hpp"
#include "core/union_find.hpp"
#include "fill/chosen.hpp"
#include "fill/flaws.hpp"
#include "fill/rim_sizes.hpp"
#include "fill/shape.hpp"
#include "fill/size_reached.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/quality.hpp"
#include "merge/compatibility.hpp"
#include "merge/conclude.hpp"
#include "merge/ground.hpp"
#include "merge/quality_summary.hpp"
#include "search/workpiece.hpp"
#include "zone/edge_table.hpp"

namespace meshgraft {
namespace {

constexpr double kNoticed = 0.1;  // edge lengths: nodes that stop farther from where they should be are told of

/// Faces with a node of one of the contours, ascending.
std::vector<ElementId> faces_at(const Model& base, std::span<const Contour> all, const Openings& openings) {
  std::vector<std::uint8_t> marked(base.n_nodes(), 0);
  for (const OpeningContours& opening : openings)
    for (const std::size_t k : opening)
      for (const NodeId n : all[k].nodes) marked[n.value] = 1;
  std::vector<ElementId> faces;
  for (std::size_t e = 0; e < base.n_elements(); ++e)
    if (base.is_face(ElementId(e)) &&
        std::ranges::any_of(base.nodes_of(ElementId(e)), [&](NodeId n) { return marked[n.value] != 0; }))
      faces.emplace_back(e);
  return faces;
}

/// The size of the largest opening: what a filling may meet is not farther from its rim.
double span_of(const Model& base, std::span<const Contour> all, const Openings& openings) {
  double most = 0;
  for (const OpeningContours& opening : openings) {
    Box box;
    for (const std::size_t k : opening)
      for (const NodeId n : all[k].nodes) box.add(base.position[n.value]);
    most = std::max(most, box.diagonal());
  }
  return most;
}

std::vector<Hole> holes_of(const Complex& complex, std::span<const Contour> all, const Openings& openings) {
  std::map<NodeId, VertexId> vertex;
  for (std::size_t v = 0; v < complex.n_vertices(); ++v)
    if (complex.node[v].valid()) vertex[complex.node[v].node] = VertexId(v);
  const EdgeTable edges(complex);
  std::vector<Hole> holes;
  for (const OpeningContours& opening : openings) {
    Hole& hole = holes.emplace_back();
    for (const std::size_t k : opening) {
      Rim& rim = hole.emplace_back();
      for (const NodeId n : all[k].nodes) rim.vertices.push_back(vertex.at(n));
      for (std::size_t i = 0; i < rim.vertices.size(); ++i)
        rim.faces.push_back(
            edges.uses(edges.find(rim.vertices[i], rim.vertices[(i + 1) % rim.vertices.size()])).front().face);
    }
  }
  return holes;
}

/// New vertices are in the node groups that all vertices of the hole next to them are in.
void give_node_groups(const Complex& around, std::span<const Hole> holes, Complex& complex, GroupSets& sets) {
  std::vector<GroupSetId> common;    // by hole
  std::vector<std::size_t> hole_of;  // by vertex of a rim
  std::vector<Vec3> at;
  std::vector<Box> boxes;
  for (const Hole& hole : holes) {
    common.push_back(around.vertex_groups[hole.front().vertices.front().value]);
    for (const Rim& rim : hole)
      for (const VertexId u : rim.vertices) {
        common.back() = sets.intersect(common.back(), around.vertex_groups[u.value]);
        hole_of.push_back(common.size() - 1), at.push_back(around.position[u.value]);
        boxes.push_back({at.back(), at.back()});
      }
  }
  const BoxTree rims(boxes);
  for (std::size_t v = 0; v < complex.n_vertices(); ++v) {
    if (complex.node[v].valid()) continue;
    const Vec3 p = complex.position[v];
    complex.vertex_groups[v] =
        common[hole_of[rims.nearest(p, [&](std::uint32_t i) { return squared_norm(p - at[i]); }).item]];
  }
}

/// Free edges that go, and what groups grow by.
Dropped account(const Complex& around, std::span<const Hole> holes, const Complex& filled, std::size_t n_groups,
                const GroupSets& sets) {
  Dropped d;
  for (const Hole& hole : holes)
    for (const Rim& rim : hole)
      for (std::size_t i = 0; i < rim.vertices.size(); ++i)
        d.free_edges.push_back({around.position[rim.vertices[i].value],
                                around.position[rim.vertices[(i + 1) % rim.vertices.size()].value]});
  d.filled_area.assign(n_groups, 0);
  for (std::size_t f = around.n_faces(); f < filled.n_faces(); ++f)
    for (const GroupId g : sets.members(filled.face_groups[f]))
      d.filled_area[g.value] += area(filled.corners(FaceId(f)));
  return d;
}

/// Beams that no edge of the new faces runs along, each once, ascending.
std::vector<UnfollowedBeam> without_edge(std::vector<UnfollowedBeam> beams, const Model& base, const Complex& filled,
                                         std::size_t first) {
  std::set<NodePair> edges;
  for (std::size_t f = first; f < filled.n_faces(); ++f)
    for (std::size_t k = 0; k < 3; ++k) edges.insert(nodes_of(filled, filled.face[f][k], filled.face[f][(k + 1) % 3]));
  std::erase_if(beams, [&](const UnfollowedBeam& beam) {
    const auto ends = base.nodes_of(beam.element);
    return edges.contains({NodeRef{0, std::min(ends[0], ends[1])}, NodeRef{0, std::max(ends[0], ends[1])}});
  });
  std::ranges::sort(beams, {}, &UnfollowedBeam::element);
  const auto again = std::ranges::unique(beams, {}, &UnfollowedBeam::element);
  beams.erase(again.begin(), again.end());
  return beams;
}

std::vector<PolylineSummary> summaries(std::span<const Contour> all, const Openings& openings) {
  std::vector<PolylineSummary> lines;
  for (const OpeningContours& opening : openings)
    for (const std::size_t k : opening) {
      PolylineSummary& line = lines.emplace_back();
      line.kind = "filled", line.closed = true;
      line.length = all[k].length, line.nodes = all[k].nodes.size();
      line.inputs = {0};
    }
  return lines;
}

/// What is to be done, whatever 1D elements are followed.
struct Task {
  const Model& base;
  const FillOptions& options;
  std::span<const Contour> contours;
  const Openings& openings;
  const std::vector<Warning>& warnings;
};

/// A filling, and the 1D elements that may be what is wrong with it.
struct Attempt {
  Merged merged;
  std::set<NodePair> followed;
  std::set<NodePair> beside_poor;  // those of them that hang together with a node of a face that breaks a promise

  [[nodiscard]] std::size_t n_broken() const { return merged.report.broken_promises.size(); }
};

/// Those that hang together with a node of faces that are poor without an excuse.
std::set<NodePair> beside_poor_faces(std::set<NodePair> beams, const Remeshed& remeshed) {
  std::map<NodeRef, std::uint32_t> number;
  for (const NodePair& beam : beams)
    for (const NodeRef n : beam) number.try_emplace(n, static_cast<std::uint32_t>(number.size()));
  UnionFind together(number.size());
  for (const auto& [a, b] : beams) together.unite(number.at(a), number.at(b));
  std::set<std::uint32_t> poor;
  for (const BadFace& bad : remeshed.bad)
    for (const VertexId v : remeshed.complex.face[bad.face.value])
      if (const auto it = number.find(remeshed.complex.node[v.value]); it != number.end() && !is_excused(bad))
        poor.insert(together.find(it->second));
  std::erase_if(beams, [&](const NodePair& beam) { return !poor.contains(together.find(number.at(beam[0]))); });
  return beams;
}

Result<Attempt> attempted(const Task& task, const LeftOut& left_out, Stopwatch& watch) {
  const auto& [base, options, all, openings, warnings] = task;
  Attempt made;
  Report& report = made.merged.report;
  Graft& graft = made.merged.graft;

  watch.start("search", 0);
  const std::vector<const Model*> inputs{&base};
  Ground ground(inputs, made.merged);
  append(report.warnings, warnings);
  const Components components = one_for_each_input(1);
  WorkpieceOptions workpiece_options;
  workpiece_options.least = span_of(base, all, openings);
  const std::vector<std::vector<ElementId>> faces{faces_at(base, all, openings)};
  if (const auto ok = check_local_scale(inputs, faces, options.zone); !ok) return Failure(ok.error());
  const Complex around = workpiece(inputs, FaceRuns(inputs), components, faces, ground.table.of_input, graft.group_sets,
                                   workpiece_options);
  const std::vector<Hole> holes = holes_of(around, all, openings);

  watch.start("fill", 0.2);  // paper 5.5
  auto coarse = patched(around, holes, left_out, graft.group_sets);
  if (!coarse) {
    const OpeningContours& opening = openings[coarse.error().hole];
    const Contour& first = all[opening.front()];
    return failure(ErrorCode::kContourNotFilled,
                   numbers_of(opening) + " around " + text_of(first.centre) +
                       " cannot be filled along the surface around: " + coarse.error().why,
                   "name other contours with --contour, or mend the faces along these", place_of_contour(base, first));
  }

  watch.start("remesh", 0.3);  // paper 5.6
  const RimSizing sizing = rim_sizing(around, holes, coarse->beams, options.zone.size);
  RemeshedZone zone;
  Shaped filling = shaped(*coarse, sizing, graft.group_sets, options.zone);
  if (filling.blended.left > kNoticed)
    report.warnings.push_back({"blend-not-reached",
                               "the filling around " + text_of(filling.blended.left_at) +
                                   " does not continue the surface as wanted: faces there would be folded or flat",
                               {base.path, 0}});
  made.followed = std::move(coarse->beams);
  made.beside_poor = beside_poor_faces(made.followed, filling.remeshed);
  zone.remeshed = std::move(filling.remeshed);
  zone.bandwidth = {0};
  give_node_groups(around, holes, zone.remeshed.complex, graft.group_sets);
  Corefined corefined;
  corefined.complex = std::move(coarse->complex);
  corefined.touched.assign(corefined.complex.n_faces(), 0);
  const Dropped dropped = account(around, holes, zone.remeshed.complex, graft.groups.size(), graft.group_sets);
  Operation operation{inputs, components, around, corefined, zone, dropped, ground, options.zone};
  operation.kind = OperationKind::kFill;
  if (const auto ok = conclude(operation, watch, made.merged); !ok) return Failure(ok.error());
  const auto unfollowed = without_edge(std::move(coarse->unfollowed), base, zone.remeshed.complex, around.n_faces());
  append(report.warnings, warnings_about(unfollowed, base));
  if (options.zone.size)
    if (auto warning = size_not_reached(zone.remeshed.complex, around.n_faces(), *options.zone.size, {base.path, 0}))
      report.warnings.push_back(std::move(*warning));
  FillingFlaws flaws = flaws_of(base, zone.remeshed.complex, around.n_faces(), unfollowed, options.zone.tolerance);
  append(report.broken_promises, std::move(flaws.broken));
  append(report.warnings, std::move(flaws.warnings));
  report.junction = summaries(all, openings);
  return made;
}

}  // namespace

Result<Merged> fill(const Model& base, const FillOptions& options) {
  Stopwatch watch(options.zone.progress);
  watch.start("search", 0);
  const std::vector<const Model*> inputs{&base};
  if (const auto ok = check_compatible(inputs, options.zone); !ok) return Failure(ok.error());
  const FreeEdges free_edges = free_edges_of(base);
  std::vector<Warning> warnings;
  const auto openings = chosen(base, free_edges, options, warnings);
  if (!openings) return Failure(openings.error());

  const Task task{base, options, free_edges.contours, *openings, warnings};
  Result<Attempt> best = attempted(task, {}, watch);
  if (!best) return Failure(best.error());
  LeftOut left_out;
  const auto try_without = [&](const std::set<NodePair>& beams) {
    const std::size_t n_before = left_out.size();
    for (const NodePair& beam : beams) left_out[beam] = Obstacle::kPoorFaces;
    if (left_out.size() == n_before) return;
    Result<Attempt> without = attempted(task, left_out, watch);
    if (without && without->n_broken() < best->n_broken()) best = std::move(without);
  };
  if (best->n_broken() > 0) try_without(best->beside_poor);
  if (best->n_broken() > 0) try_without(best->followed);
  best->merged.report.timings = watch.timings();
  return std::move(best->merged);
}

}  // namespace meshgraft
