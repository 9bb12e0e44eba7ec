#include "merge/free_edges.hpp"

#include <algorithm>
#include <array>

#include "geometry/quality.hpp"
#include "merge/junction_summary.hpp"
#include "merge/segments.hpp"

namespace meshgraft {
namespace {

using NodePair = std::array<NodeRef, 2>;

std::vector<FaceOnEdge> free_edges(const Complex& complex, std::span<const std::uint8_t> wanted) {
  std::vector<FaceOnEdge> found;
  const std::vector<FaceOnEdge> uses = edge_uses(complex, wanted);
  for_each_edge(uses, [&](std::span<const FaceOnEdge> edge) {
    // Layers on the same nodes end together.
    const auto on_the_same = [&](const FaceOnEdge& use) {
      return std::ranges::is_permutation(complex.face[use.face.value], complex.face[edge[0].face.value]);
    };
    if (std::ranges::all_of(edge, on_the_same)) found.push_back(edge[0]);
  });
  return found;
}

Segment segment(const Complex& complex, VertexId a, VertexId b) {
  return {complex.position[a.value], complex.position[b.value]};
}

NodePair key(const Complex& complex, const FaceOnEdge& e) {
  const NodeRef a = complex.node[e.low.value], b = complex.node[e.high.value];
  return {std::min(a, b), std::max(a, b)};
}

std::vector<NodePair> keys(const Complex& complex, std::span<const FaceOnEdge> edges) {
  std::vector<NodePair> all;
  for (const FaceOnEdge& e : edges) all.push_back(key(complex, e));
  std::sort(all.begin(), all.end());
  return all;
}

/// Nodes at vertices of the final complex that did not change, ascending.
std::vector<NodeRef> unchanged_nodes(const Outcome& outcome, std::span<const std::uint8_t> changed) {
  std::vector<NodeRef> unchanged;
  for (std::size_t v = 0; v < changed.size(); ++v)
    if (changed[v] == 0) unchanged.push_back(outcome.stitched.node[v]);
  std::sort(unchanged.begin(), unchanged.end());
  return unchanged;
}

/// Vertices of the original complex whose nodes are at changed vertices of the final one, or are gone.
std::vector<std::uint8_t> changed_before(const Outcome& outcome, std::span<const NodeRef> unchanged) {
  std::vector<std::uint8_t> marked(outcome.original.n_vertices());
  for (std::size_t v = 0; v < marked.size(); ++v)
    marked[v] = std::ranges::binary_search(unchanged, outcome.original.node[v]) ? 0 : 1;
  return marked;
}

/// The node, or the one that it became one with.
NodeRef heir(const Outcome& outcome, NodeRef n) {
  const auto& replaced = outcome.corefined.replaced;
  const auto it = std::ranges::lower_bound(replaced, n, {}, &Corefined::Replaced::node);
  return it != replaced.end() && it->node == n ? outcome.corefined.complex.node[it->by.value] : n;
}

/// Its ends by the nodes that they are now.
NodePair heirs(const Outcome& outcome, const FaceOnEdge& e) {
  const NodePair nodes = key(outcome.original, e);
  const NodeRef a = heir(outcome, nodes[0]), b = heir(outcome, nodes[1]);
  return {std::min(a, b), std::max(a, b)};
}

/// Vertices of the final complex that changed, and those that nodes of others became one with.
std::vector<std::uint8_t> changed_or_heir(const Outcome& outcome) {
  std::vector<NodeRef> by;
  for (const Corefined::Replaced& r : outcome.corefined.replaced)
    by.push_back(outcome.corefined.complex.node[r.by.value]);
  std::ranges::sort(by);
  std::vector<std::uint8_t> marked = outcome.changed_vertex;
  for (std::size_t v = 0; v < marked.size(); ++v)
    if (std::ranges::binary_search(by, outcome.stitched.node[v])) marked[v] = 1;
  return marked;
}

/// A face that lay on another mesh and was deleted, or that another one stands for now, has left its
/// free edges to that mesh.
bool went_with_its_face(const Outcome& outcome, ElementRef face) {
  return std::ranges::binary_search(outcome.corefined.covered, face, {}, &Corefined::Covered::face);
}

}  // namespace

FreeEdgeChanges free_edge_changes(const Outcome& outcome, const Tolerance& tolerance, double max_distance) {
  const Complex &before = outcome.original, &after = outcome.final_complex;
  const std::vector<std::uint8_t>& changed = outcome.changed_vertex;
  const std::vector<NodeRef> unchanged = unchanged_nodes(outcome, changed);
  const std::vector<FaceOnEdge> old_edges = free_edges(before, changed_before(outcome, unchanged));
  const std::vector<FaceOnEdge> new_edges = free_edges(after, changed);
  const std::vector<NodePair> old_keys = keys(before, old_edges);
  const std::vector<NodePair> left_keys = keys(after, free_edges(after, changed_or_heir(outcome)));

  // What was dropped takes free edges with it and leaves new ones.
  std::vector<Segment> old_segments = outcome.dropped.borders, new_segments = outcome.dropped.free_edges;
  for (const FaceOnEdge& e : old_edges) old_segments.push_back({outcome.moved(e.low), outcome.moved(e.high)});
  for (const FaceOnEdge& e : new_edges) new_segments.push_back(segment(after, e.low, e.high));
  std::vector<Segment> joined;
  for (const JunctionEdge& e : junction_of(after).edges) joined.push_back(segment(after, e.ends[0], e.ends[1]));
  const Segments was_free(std::move(old_segments)), is_free(std::move(new_segments)), is_joined(std::move(joined)),
      is_sewn(outcome.corefined.sewn);

  const auto is_known = [](const NodePair& nodes, std::span<const NodePair> known) {
    return nodes[0].valid() && nodes[1].valid() && std::ranges::binary_search(known, nodes);
  };
  const auto allowed = [&](const Complex& complex, const FaceOnEdge& e, const Segment& s) {
    const ElementRef parent = complex.parent[e.face.value];
    const double input_length = mean_edge_length(outcome.inputs[parent.input]->corners(parent.element));
    return std::max(max_distance * distance(s[0], s[1]), tolerance.at(input_length));
  };
  const auto was_there = [&](const FaceOnEdge& e) {
    const Segment s = segment(after, e.low, e.high);
    return is_known(key(after, e), old_keys) || was_free.cover(s, allowed(after, e, s));
  };
  // A rim that is a junction now is as fine as that, which may be coarser.
  const auto is_covered = [&](const FaceOnEdge& e) {
    const Segment s{outcome.moved(e.low), outcome.moved(e.high)};
    const double near = allowed(before, e, s);
    return is_known(heirs(outcome, e), left_keys) || std::ranges::all_of(places_on(s), [&](Vec3 p) {
             return is_free.are_near(p, near) || is_joined.are_near(p, near, max_distance) || is_sewn.are_near(p, near);
           });
  };
  // An edge whose ends became one with others, where nothing else changed.
  const auto is_there = [&](const FaceOnEdge& e) {
    return std::ranges::all_of(key(before, e),
                               [&](NodeRef n) { return std::ranges::binary_search(unchanged, heir(outcome, n)); });
  };
  FreeEdgeChanges changes;
  for (const FaceOnEdge& e : new_edges)
    if (!was_there(e)) changes.cracks.push_back(e);
  for (const FaceOnEdge& e : old_edges)
    if (!is_covered(e) && !is_there(e) && !went_with_its_face(outcome, before.parent[e.face.value]))
      changes.closed.push_back(e);
  return changes;
}

}  // namespace meshgraft
