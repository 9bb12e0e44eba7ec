// A merge whose geometric steps are played by the test: it edits the complex itself.
#pragma once

#include <numeric>
#include <vector>

#include "merge/group_table.hpp"
#include "merge/labels.hpp"
#include "merge/node_groups.hpp"
#include "merge/outcome.hpp"
#include "merge/stitch.hpp"
#include "meshgraft/graft.hpp"
#include "meshgraft/merge.hpp"
#include "search/workpiece.hpp"

namespace meshgraft::testing_support {

class HandMade {
 public:
  explicit HandMade(std::vector<Model> models)
      : models_(std::move(models)),
        inputs_(pointers(models_)),
        components(one_for_each_input(inputs_.size())),
        table(group_table(inputs_)),
        translated(inputs_, table, graft.group_sets) {
    graft.groups = table.groups;
    std::vector<std::vector<ElementId>> faces(models_.size());
    for (std::size_t k = 0; k < models_.size(); ++k)
      for (std::size_t e = 0; e < models_[k].n_elements(); ++e)
        if (models_[k].is_face(ElementId(e))) faces[k].emplace_back(e);
    original = workpiece(inputs_, FaceRuns(inputs_), components, faces, table.of_input, graft.group_sets);
    corefined.complex = original;
    final_complex = original;
  }
  HandMade(const HandMade&) = delete;
  HandMade& operator=(const HandMade&) = delete;

  [[nodiscard]] Inputs inputs() const { return inputs_; }
  [[nodiscard]] const Model& model(std::size_t k) const { return models_[k]; }
  [[nodiscard]] std::span<const Model> parts() const { return std::span(models_).subspan(1); }

  [[nodiscard]] VertexId vertex(std::uint32_t input, std::size_t node) const {
    for (std::size_t v = 0; v < final_complex.n_vertices(); ++v)
      if (final_complex.node[v] == NodeRef{input, NodeId(node)}) return VertexId(v);
    return {};
  }

  /// Replaces the face by three around its centroid.
  VertexId split_face(FaceId f) {
    const auto corners = final_complex.corners(f);
    const auto v = final_complex.face[f.value];
    const VertexId c =
        final_complex.add_vertex((corners[0] + corners[1] + corners[2]) / 3.0, {}, VertexState::kOpen, {});
    final_complex.vertex_groups.back() = GroupSets::kEmpty;
    final_complex.face[f.value] = {v[0], v[1], c};
    const Complex& like = final_complex;
    final_complex.add_face({v[1], v[2], c}, like, f);
    final_complex.add_face({v[2], v[0], c}, like, f);
    return c;
  }

  void remove_face(FaceId f) {
    const auto at = static_cast<std::ptrdiff_t>(f.value);
    const auto erase = [&](auto& v) { v.erase(v.begin() + at); };
    erase(final_complex.face), erase(final_complex.parent), erase(final_complex.component);
    erase(final_complex.face_groups), erase(final_complex.face_attributes);
  }

  const Stitched& stitch_now() {
    stitched = stitch(inputs_, original, corefined, final_complex, graft);
    assign_node_groups(inputs_, translated, final_complex, stitched, graft);
    labels = labels_of(inputs_);
    return stitched;
  }

  [[nodiscard]] Outcome outcome() const {
    return {inputs_,       components, original, corefined, NodePlaces(inputs_, corefined),
            final_complex, stitched,   graft,    labels,    dropped};
  }

  [[nodiscard]] Model result() const { return apply(models_[0], parts(), Merged{graft, labels, {}}); }

 private:
  static std::vector<const Model*> pointers(const std::vector<Model>& models) {
    std::vector<const Model*> all;
    for (const Model& m : models) all.push_back(&m);
    return all;
  }

  std::vector<Model> models_;
  std::vector<const Model*> inputs_;

 public:
  Components components;
  Graft graft;
  GroupTable table;
  SetTranslation translated;
  Complex original;
  Corefined corefined;
  Complex final_complex;
  Stitched stitched;
  Labels labels;
  Dropped dropped;
};

}  // namespace meshgraft::testing_support
