#include "core/summary.hpp"

#include "core/blocks.hpp"

namespace meshgraft {

const char* name(Shape shape) {
  switch (shape) {
    case Shape::kPoint:
      return "point";
    case Shape::kLine:
      return "line";
    case Shape::kLine3:
      return "line3";
    case Shape::kTriangle:
      return "triangle";
    case Shape::kTriangle6:
      return "triangle6";
    case Shape::kQuad:
      return "quad";
    case Shape::kQuad8:
      return "quad8";
    case Shape::kSolid:
      return "solid";
    case Shape::kOther:
      break;
  }
  return "other";
}

InputSummary counts_of(const Model& model) {
  InputSummary s;
  s.path = model.path;
  s.nodes = model.n_nodes(), s.elements = model.n_elements(), s.groups = model.groups.size();
  const std::size_t n = model.attributes.size();
  const auto of_block = collected_by_block<std::uint64_t>(
      model.n_elements(), [&](std::size_t first, std::size_t last, std::vector<std::uint64_t>& by_attributes) {
        by_attributes.resize(n);
        for (std::size_t e = first; e < last; ++e) ++by_attributes[model.element_attributes[e].value];
      });
  for (std::size_t i = 0; i < of_block.size(); ++i)
    if (of_block[i] > 0) s.elements_by_kind[name(model.attributes[i % n].shape)] += of_block[i];
  return s;
}

}  // namespace meshgraft
