#include "core/summary.hpp"

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
  std::vector<std::uint64_t> by_attributes(model.attributes.size());
  for (const AttributesId a : model.element_attributes) ++by_attributes[a.value];
  for (std::size_t a = 0; a < by_attributes.size(); ++a)
    if (by_attributes[a] > 0) s.elements_by_kind[name(model.attributes[a].shape)] += by_attributes[a];
  return s;
}

}  // namespace meshgraft
