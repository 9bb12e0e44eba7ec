#include "merge/inputs.hpp"

namespace meshgraft {

std::string text_of(Inputs inputs, ElementRef element) {
  const Model& model = *inputs[element.input];
  const std::int64_t label = model.element_label[element.element.value];
  return label == kNoLabel ? model.path : "element " + std::to_string(label) + " of " + model.path;
}

std::string joined(std::span<const std::string> names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (k > 0) text += k + 1 == names.size() ? " and " : ", ";
    text += names[k];
  }
  return text;
}

namespace {

/// Every `step`-th node, as far as there are `wanted` of them and none is missing.
Corners every(std::span<const NodeId> nodes, std::size_t step, std::size_t wanted) {
  Corners c;
  if (nodes.size() < (wanted - 1) * step + 1) return c;
  for (std::size_t k = 0; k < wanted; ++k) {
    c.node[k] = nodes[k * step];
    if (!c.node[k].valid()) return {};
  }
  c.n = wanted;
  return c;
}

}  // namespace

Corners corners_of(Shape shape, std::span<const NodeId> nodes) {
  switch (shape) {
    case Shape::kLine:
      return every(nodes, 1, 2);
    case Shape::kLine3:
      return every(nodes, 2, 2);
    case Shape::kTriangle:
      return every(nodes, 1, 3);
    case Shape::kTriangle6:
      return every(nodes, 2, 3);
    case Shape::kQuad:
      return every(nodes, 1, 4);
    case Shape::kQuad8: {
      // Higher orders have more nodes per side; corners stand at the start of each.
      return nodes.size() < 8 ? Corners{} : every(nodes, nodes.size() == 9 ? 2 : nodes.size() / 4, 4);
    }
    default:
      return {};
  }
}

}  // namespace meshgraft
