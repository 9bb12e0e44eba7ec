#include "search/face_runs.hpp"

#include <algorithm>

namespace meshgraft {

Box box_of_face(const Model& model, ElementId e) {
  Box box;
  const auto nodes = model.nodes_of(e);
  if (!model.is_face(e) || !std::ranges::all_of(nodes, [](NodeId v) { return v.valid(); })) return box;
  for (const NodeId v : nodes) box.add(model.position[v.value]);
  return box;
}

FaceRuns::FaceRuns(std::span<const Model* const> inputs) : of_input_(inputs.size()) {
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const Model& model = *inputs[k];
    of_input_[k].resize((model.n_elements() + kRun - 1) / kRun);
    for_blocks(model.n_elements(), [&](std::size_t begin, std::size_t end) {
      for (ElementId e(begin); e.value < end; ++e.value)
        if (const Box box = box_of_face(model, e); !box.empty()) of_input_[k][e.value / kRun].add(box);
    });
  }
}

}  // namespace meshgraft
