#include "merge/node_places.hpp"

#include <algorithm>

namespace meshgraft {

NodePlaces::NodePlaces(Inputs inputs, const Corefined& corefined) : inputs_(inputs) {
  const auto add = [&](NodeRef node, Vec3 to) {
    if (to != inputs[node.input]->position[node.node.value]) moved_.emplace_back(node, to);
  };
  for (const Corefined::Move& m : corefined.moves) add(m.node, m.to);
  for (const Corefined::Replaced& r : corefined.replaced) add(r.node, corefined.complex.position[r.by.value]);
  std::ranges::sort(moved_, {}, &std::pair<NodeRef, Vec3>::first);
}

const Vec3* NodePlaces::moved_to(NodeRef node) const {
  const auto at = std::ranges::lower_bound(moved_, node, {}, &std::pair<NodeRef, Vec3>::first);
  return at != moved_.end() && at->first == node ? &at->second : nullptr;
}

Triangle NodePlaces::of(ElementRef face) const {
  const auto nodes = inputs_[face.input]->nodes_of(face.element);
  return {of(NodeRef{face.input, nodes[0]}), of(NodeRef{face.input, nodes[1]}), of(NodeRef{face.input, nodes[2]})};
}

bool NodePlaces::is_moved(ElementRef face) const {
  return std::ranges::any_of(inputs_[face.input]->nodes_of(face.element), [&](NodeId n) {
    return moved_to({face.input, n}) != nullptr;
  });
}

}  // namespace meshgraft
