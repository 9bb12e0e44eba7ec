// Everything that is known of a merge once it is stitched; what the checks and summaries look at.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/complex.hpp"
#include "core/components.hpp"
#include "intersect/corefine.hpp"
#include "merge/dropped.hpp"
#include "merge/group_table.hpp"
#include "merge/node_places.hpp"
#include "merge/operation_kind.hpp"
#include "merge/stitch.hpp"
#include "meshgraft/graft.hpp"

namespace meshgraft {

/// Outcome::changed_vertex.
[[nodiscard]] std::vector<std::uint8_t> changed_vertices(Inputs inputs, const Complex& final_complex,
                                                         const Stitched& stitched, const Graft& graft);

struct Outcome {
  Inputs inputs;
  const Components& components;
  const Complex& original;       // the workpiece
  const Corefined& corefined;    // the same, cut along the junction
  NodePlaces places;             // of the nodes of the inputs in it
  const Complex& final_complex;  // remeshed
  const Stitched& stitched;
  const Graft& graft;
  const Labels& labels;
  const Dropped& dropped;
  bool all_layers = false;  // of faces stay, on the same nodes, where inputs lie on each other
  /// LaidOut::beneath: of the last faces of the final complex.
  std::span<const FaceId> beneath_last = {};
  OperationKind kind = OperationKind::kMerge;
  /// By vertex of the final complex: 1 where a face changed or was removed. Whatever changed has all
  /// its corners marked.
  std::vector<std::uint8_t> changed_vertex = changed_vertices(inputs, final_complex, stitched, graft);

  [[nodiscard]] bool is_new(FaceId f) const { return stitched.new_element[f.value] != Stitched::kKept; }
  /// New, or kept with a corner at another place.
  [[nodiscard]] bool is_changed(FaceId f) const { return stitched.changed[f.value] != 0; }
  /// Mean edge length of the parent of a face: the fineness of the input there.
  [[nodiscard]] double input_edge_length(FaceId f) const;
  /// Place of a vertex of the workpiece, nodes having been moved to close gaps.
  [[nodiscard]] Vec3 moved(VertexId original_vertex) const { return places.of(original.node[original_vertex.value]); }
  /// The face on whose nodes a face was laid as a further layer; invalid if it is none.
  [[nodiscard]] FaceId beneath(FaceId f) const {
    const std::size_t first = final_complex.n_faces() - beneath_last.size();
    return f.value < first ? FaceId() : beneath_last[f.value - first];
  }
  /// Label in the merged model.
  [[nodiscard]] std::int64_t label(FaceId f) const;
  /// "new element 57 at (1, 2, 0.5)", the place being the centroid.
  [[nodiscard]] std::string text(FaceId f) const;
  /// Where the parent of a face stands in the file of the user.
  [[nodiscard]] Place parent_place(FaceId f) const;
};

}  // namespace meshgraft
