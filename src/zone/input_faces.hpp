// The input faces of a corefined complex and which of them are neighbours.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "intersect/corefine.hpp"
#include "zone/edge_table.hpp"
#include "zone/parents.hpp"

namespace meshgraft {

/// Input faces by the dense number of Parents.
class InputFaces {
 public:
  explicit InputFaces(const Corefined& corefined);

  [[nodiscard]] std::size_t size() const { return parents_.size(); }
  [[nodiscard]] std::uint32_t of(FaceId f) const { return parents_.of_face[f.value]; }
  [[nodiscard]] std::span<const FaceId> pieces(std::uint32_t i) const { return parents_.faces_of(i); }
  [[nodiscard]] std::uint32_t component(std::uint32_t i) const { return complex_.component[pieces(i).front().value]; }
  [[nodiscard]] bool touched(std::uint32_t i) const { return touched_[i] != 0; }
  /// Neither cut nor in part taken out.
  [[nodiscard]] bool is_whole(std::uint32_t i) const { return pieces(i).size() == 1 && !has_lost(i); }
  /// Whole, and made poor by nodes that were moved; see find_spoiled().
  [[nodiscard]] bool is_spoiled(std::uint32_t i) const { return spoiled_[i] != 0; }
  /// A part of it is taken out: what is left may be much smaller than it was.
  [[nodiscard]] bool has_lost(std::uint32_t i) const { return has_lost_[i] != 0; }
  /// May not be remeshed: a vertex of it is kFrozen, or it lies on the vertices of another one.
  [[nodiscard]] bool frozen(std::uint32_t i) const { return frozen_[i] != 0; }
  /// It lies in an area of contact that stays as it is: not cut, and not in the neighbourhoods of a face there that
  /// had to be cut or was released.
  [[nodiscard]] bool kept(std::uint32_t i) const { return kept_[i] != 0; }
  /// Tells which whole faces have a Q below the given one, and below what they have in the complex as it was.
  void find_spoiled(const Complex& original, double min_quality);
  /// Those at the vertices of nodes (ascending) are not kept any longer, nor are their neighbourhoods. Returns these.
  std::vector<std::uint32_t> release(std::span<const NodeRef> nodes);
  [[nodiscard]] double mean_edge_length(std::uint32_t i) const { return mean_edge_length_[i]; }
  [[nodiscard]] Vec3 centre(std::uint32_t i) const;

  /// Calls f(j) for every j of the same mesh with a vertex of i, with repeats.
  template <class F>
  void each_neighbour(std::uint32_t i, F&& f) const {
    each_at_vertices(i, f, [&](FaceId, FaceId g) { return mesh_of(component(of(g))) == mesh_of(component(i)); });
  }

  /// The same, of each mesh that i stands for: where faces of several became one, each goes on beside it.
  template <class F>
  void each_neighbour_of_layers(std::uint32_t i, F&& f) const {
    each_at_vertices(i, f, [&](FaceId piece, FaceId g) { return share_a_mesh(piece, g); });
  }

  /// Number of the neighbourhood each is in, of any of its layers: 1 for touched ones; 0 for those beyond `last`.
  [[nodiscard]] std::vector<int> rings(int last) const;

 private:
  template <class F, class Counts>
  void each_at_vertices(std::uint32_t i, F&& f, Counts&& counts) const {
    for (const FaceId piece : pieces(i))
      for (const VertexId v : complex_.face[piece.value])
        for (const FaceId g : faces_at_[v])
          if (counts(piece, g)) f(of(g));
  }
  [[nodiscard]] std::uint32_t mesh_of(std::uint32_t component) const { return complex_.joins.mesh_of(component); }
  [[nodiscard]] bool share_a_mesh(FaceId f, FaceId g) const;
  [[nodiscard]] double contour_length(std::uint32_t i) const;
  void freeze_doubled();
  /// These and the neighbourhoods around them, as far as they are kept. Returns these.
  std::vector<std::uint32_t> release_around(std::vector<std::uint32_t> front);

  const Complex& complex_;
  Parents parents_;
  VertexFaces faces_at_;
  std::vector<std::uint8_t> touched_, frozen_, kept_, has_lost_, spoiled_;
  std::vector<double> mean_edge_length_;
};

}  // namespace meshgraft
