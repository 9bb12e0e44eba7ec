// Where the nodes of the inputs are once gaps have been closed.
#pragma once

#include <utility>
#include <vector>

#include "core/complex.hpp"
#include "geometry/quality.hpp"
#include "intersect/corefine.hpp"
#include "merge/inputs.hpp"

namespace meshgraft {

/// Nodes of parts may be moved onto another mesh, or be replaced by a node of it (Corefined::moves,
/// replaced); all others are where they were.
class NodePlaces {
 public:
  NodePlaces(Inputs inputs, const Corefined& corefined);

  [[nodiscard]] Vec3 of(NodeRef node) const {
    const Vec3* to = moved_to(node);
    return to != nullptr ? *to : inputs_[node.input]->position[node.node.value];
  }
  [[nodiscard]] Triangle of(ElementRef face) const;
  /// Whether a corner of the face is not where it was.
  [[nodiscard]] bool is_moved(ElementRef face) const;
  /// The nodes that are not where they were and where they are, ascending.
  [[nodiscard]] const std::vector<std::pair<NodeRef, Vec3>>& moved() const { return moved_; }

 private:
  [[nodiscard]] const Vec3* moved_to(NodeRef node) const;

  Inputs inputs_;
  std::vector<std::pair<NodeRef, Vec3>> moved_;
};

}  // namespace meshgraft
