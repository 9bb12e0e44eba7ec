#include "search/face_runs.hpp"

#include <algorithm>

namespace meshgraft {

namespace {

/// Nothing if the element is not a face or has not all its nodes.
void add_face(const Model& model, ElementId e, Box& box) {
  const auto nodes = model.nodes_of(e);
  if (!model.is_face(e) || !std::ranges::all_of(nodes, [](NodeId v) { return v.valid(); })) return;
  for (const NodeId v : nodes) box.add(model.position[v.value]);
}

}  // namespace

Box box_of_face(const Model& model, ElementId element) {
  Box box;
  add_face(model, element, box);
  return box;
}

FaceRuns::FaceRuns(std::span<const Model* const> inputs) : of_input_(inputs.size()) {
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const Model& model = *inputs[k];
    const std::size_t n = model.n_elements();
    of_input_[k].resize((n + kRun - 1) / kRun);
    for_blocks(
        of_input_[k].size(),
        [&](std::size_t first, std::size_t last) {
          for (std::size_t run = first; run < last; ++run) {
            Box box;
            for (std::size_t i = run * kRun, end = std::min(n, i + kRun); i < end; ++i)
              add_face(model, ElementId(i), box);
            of_input_[k][run] = box;
          }
        },
        kBlock / kRun);
  }
}

}  // namespace meshgraft
