#include "merge/outcome.hpp"

#include <algorithm>

#include "geometry/quality.hpp"
#include "merge/labels.hpp"

namespace meshgraft {

std::int64_t Outcome::label(FaceId f) const {
  const std::uint32_t position = stitched.new_element[f.value];
  const ElementRef element =
      is_new(f) ? ElementRef{kNew, ElementId(std::size_t{position})} : final_complex.parent[f.value];
  return label_of(inputs, labels, element);
}

std::string Outcome::text(FaceId f) const {
  return (is_new(f) ? "new element " : "element ") + std::to_string(label(f)) + " at " +
         text_of(centroid(final_complex.corners(f)));
}

double Outcome::input_edge_length(FaceId f) const {
  const ElementRef parent = final_complex.parent[f.value];
  return mean_edge_length(inputs[parent.input]->corners(parent.element));
}

Place Outcome::parent_place(FaceId f) const {
  const ElementRef parent = final_complex.parent[f.value];
  return place_of(*inputs[parent.input], parent.element);
}

std::vector<std::uint8_t> changed_vertices(const Outcome& outcome) {
  std::vector<NodeRef> of_removed;  // ascending
  for (std::uint32_t k = 0; k < outcome.inputs.size(); ++k)
    for (const ElementId e : outcome.graft.removed_elements[k])
      for (const NodeId n : outcome.inputs[k]->nodes_of(e)) of_removed.push_back({k, n});
  std::sort(of_removed.begin(), of_removed.end());
  of_removed.erase(std::unique(of_removed.begin(), of_removed.end()), of_removed.end());

  const Complex& complex = outcome.final_complex;
  std::vector<std::uint8_t> changed(complex.n_vertices());
  for (std::size_t v = 0; v < changed.size(); ++v)
    changed[v] = complex.node[v].valid() && std::ranges::binary_search(of_removed, complex.node[v]) ? 1 : 0;
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    if (outcome.is_changed(FaceId(f)))
      for (const VertexId v : complex.face[f]) changed[v.value] = 1;
  return changed;
}

}  // namespace meshgraft
