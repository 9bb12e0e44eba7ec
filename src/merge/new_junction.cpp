#include "merge/new_junction.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "merge/segments.hpp"

namespace meshgraft {
namespace {

using List = std::vector<std::uint32_t>;  // of components, ascending

/// What components share in the input, by the components.
class SharedBefore {
 public:
  explicit SharedBefore(const Complex& before) {
    const Junction junction = junction_of(before);
    std::map<List, std::vector<Segment>> segments;
    for (const JunctionEdge& e : junction.edges) {
      segments[e.components].push_back({before.position[e.ends[0].value], before.position[e.ends[1].value]});
      for (const VertexId v : e.ends) nodes_[e.components].insert(before.node[v.value]);
    }
    for (const JunctionPoint& p : junction.points) nodes_[p.components].insert(before.node[p.vertex.value]);
    for (auto& [components, all] : segments) edges_.try_emplace(components, std::move(all));
  }

  [[nodiscard]] bool has(const List& components, const Segment& s, double max_distance) const {
    return std::ranges::any_of(edges_, [&](const auto& entry) {
      return std::ranges::includes(entry.first, components) &&
             entry.second.cover(s, max_distance * distance(s[0], s[1]));
    });
  }
  [[nodiscard]] bool has(const List& components, NodeRef node) const {
    return std::ranges::any_of(nodes_, [&](const auto& entry) {
      return std::ranges::includes(entry.first, components) && entry.second.contains(node);
    });
  }

 private:
  std::map<List, Segments> edges_;
  std::map<List, std::set<NodeRef>> nodes_;
};

}  // namespace

Junction new_junction(const Outcome& outcome, double max_distance) {
  const Complex& after = outcome.final_complex;
  Junction junction = junction_of(after);
  if (outcome.original.joins.kind.empty()) return junction;  // only meshes of their own are joined
  const SharedBefore before(outcome.original);
  std::erase_if(junction.edges, [&](const JunctionEdge& e) {
    const Segment s{after.position[e.ends[0].value], after.position[e.ends[1].value]};
    return before.has(e.components, s, max_distance);
  });
  std::erase_if(junction.points, [&](const JunctionPoint& p) {
    return before.has(p.components, outcome.stitched.node[p.vertex.value]);
  });
  return junction;
}

}  // namespace meshgraft
