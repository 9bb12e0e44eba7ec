// One of two complexes that are about to be made conforming: its faces near the other, with their
// edges and with what counts as a feature there.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/buckets.hpp"
#include "core/complex.hpp"

namespace meshgraft {

/// Positions in the lists of one Side.
using LocalFace = std::uint32_t;
using LocalEdge = std::uint32_t;
inline constexpr std::uint32_t kNowhere = 0xFFFFFFFF;

/// What counts as a feature besides free and non-manifold edges.
struct FeatureRule {
  double sharp_angle;      // radians; edges folded more
  bool borders_of_layers;  // borders of what lies on the mesh
};

class Side {
 public:
  /// `near`: the faces of this side that may meet the other, ascending. `own[f]` tells which faces
  /// of the complex belong to this side.
  Side(const Complex& complex, std::vector<FaceId> near, std::span<const std::uint8_t> own, const FeatureRule& rule);

  [[nodiscard]] std::size_t n_faces() const { return faces_.size(); }
  [[nodiscard]] std::size_t n_edges() const { return ends_.size(); }
  [[nodiscard]] FaceId face(LocalFace f) const { return faces_[f]; }
  [[nodiscard]] const std::array<VertexId, 3>& corners(LocalFace f) const { return corners_[f]; }
  /// The edge from corner k to the next corner.
  [[nodiscard]] const std::array<LocalEdge, 3>& edges(LocalFace f) const { return edges_[f]; }
  /// (smaller, larger) vertex.
  [[nodiscard]] const std::array<VertexId, 2>& ends(LocalEdge e) const { return ends_[e]; }
  [[nodiscard]] LocalFace find(FaceId f) const;
  /// kNowhere if no face near the other side has this edge.
  [[nodiscard]] LocalEdge find(VertexId a, VertexId b) const;

  [[nodiscard]] std::span<const LocalFace> faces_at(VertexId v) const { return at_vertex_[v.value]; }
  [[nodiscard]] std::span<const LocalFace> faces_at_edge(LocalEdge e) const {
    return std::span(at_edge_).subspan(first_at_edge_[e], first_at_edge_[e + 1] - first_at_edge_[e]);
  }

  /// All faces of this side at the edge, far ones too.
  [[nodiscard]] std::uint32_t n_faces_at(LocalEdge e) const { return n_at_edge_[e]; }

  /// One face in all, unless both ends are frozen, where others may be missing.
  [[nodiscard]] bool is_free(LocalEdge e) const { return n_at_edge_[e] == 1 && edge_feature_[e] != 0; }

  /// Free, sharp or non-manifold edges, and borders of what lies on the mesh; their ends; pinned vertices.
  [[nodiscard]] bool is_feature(VertexId v) const { return vertex_feature_[v.value]; }
  [[nodiscard]] bool is_feature_edge(LocalEdge e) const { return edge_feature_[e]; }
  /// Features, and what stays a line of the mesh besides: borders between groups or attributes, edges with 1D elements;
  /// their ends. They end nowhere, but what ends beside them ends on them: no good face fits between.
  [[nodiscard]] bool is_line(VertexId v) const { return vertex_line_[v.value]; }
  [[nodiscard]] bool is_line_edge(LocalEdge e) const { return edge_line_[e]; }
  /// A place of its own: a pinned vertex, or one where feature edges end, branch or turn sharply.
  [[nodiscard]] bool is_corner(VertexId v) const { return vertex_corner_[v.value]; }

 private:
  void find_edges(const Complex& complex, std::span<const std::uint8_t> own, const FeatureRule& rule);
  void find_corners(const Complex& complex, double sharp_angle, std::vector<std::array<VertexId, 2>> feature_edges);
  void find_faces_at_vertices(std::size_t n_vertices);

  std::vector<FaceId> faces_;
  std::vector<std::array<VertexId, 3>> corners_;
  std::vector<std::array<LocalEdge, 3>> edges_;
  std::vector<std::array<VertexId, 2>> ends_;  // ascending
  Buckets<LocalFace> at_vertex_;
  std::vector<std::uint32_t> first_at_edge_, n_at_edge_;
  std::vector<LocalFace> at_edge_;
  std::vector<std::uint8_t> edge_feature_, vertex_feature_, vertex_corner_, edge_line_, vertex_line_;
};

}  // namespace meshgraft
