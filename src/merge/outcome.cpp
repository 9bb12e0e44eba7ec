#include "merge/outcome.hpp"

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

std::vector<std::uint8_t> changed_vertices(Inputs inputs, const Complex& final_complex, const Stitched& stitched,
                                           const Graft& graft) {
  std::vector<std::vector<bool>> of_removed(inputs.size());  // by input and node
  for (std::uint32_t k = 0; k < inputs.size(); ++k) {
    of_removed[k].resize(inputs[k]->n_nodes());
    for (const ElementId e : graft.removed_elements[k])
      for (const NodeId n : inputs[k]->nodes_of(e))
        if (n.valid()) of_removed[k][n.value] = true;
  }

  std::vector<std::uint8_t> changed(final_complex.n_vertices());
  for (std::size_t v = 0; v < changed.size(); ++v) {
    const NodeRef node = final_complex.node[v];
    changed[v] = node.valid() && of_removed[node.input][node.node.value] ? 1 : 0;
  }
  for (std::size_t f = 0; f < final_complex.n_faces(); ++f)
    if (stitched.changed[f] != 0)
      for (const VertexId v : final_complex.face[f]) changed[v.value] = 1;
  return changed;
}

}  // namespace meshgraft
