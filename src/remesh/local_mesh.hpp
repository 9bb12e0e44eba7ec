// The mesh that the remesher works on: faces that may be replaced one by one, with an undo.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "remesh/few.hpp"
#include "zone/brep.hpp"

namespace meshgraft {

/// Vertices 0..n-1 are those of the complex, later ones are new.
struct LocalVertex {
  Vec3 position;
  Dimension dimension = Dimension::kCorner;
  bool fixed = true;   // may neither move nor be removed
  bool held = false;   // the same, as long as no poor face needs it
  bool moved = false;  // is no longer where the complex has it
  CurveId curve;       // dimension kCurve
  double arc = 0;      // dimension kCurve: arc length on the curve of the complex
  SheetId sheet;       // dimension kSheet
  FaceId beneath;      // dimension kSheet: a face of the complex at or near it
  double size = 0;     // wanted edge length at sized_at; 0 = not asked yet
  Vec3 sized_at;       // here, or so near that asking again is not worth it
};

/// Faces 0..m-1 are those of the complex, later ones are new.
struct LocalFace {
  static constexpr double kUnknown = -1;
  std::array<VertexId, 3> v;
  std::array<CurveId, 3> curve;  // of the edge from corner k to corner k+1, or none
  SheetId sheet;
  double q = 0;                 // aspect ratio; in planar sheets negative if it faces backwards
  double deviation = kUnknown;  // see Editor::deviation
  bool alive = true;
  bool in_zone = false;
  bool is_new = false;  // not as in the complex

  /// Corner at which v stands; REQUIRES: it does.
  [[nodiscard]] std::size_t corner_of(VertexId u) const { return v[0] == u ? 0 : v[1] == u ? 1 : 2; }
  [[nodiscard]] bool has(VertexId u) const { return v[0] == u || v[1] == u || v[2] == u; }
};

using FacesOfEdge = Few<FaceId, 4>;

/// The faces of one sheet around a vertex v, from curve to curve or all around: face i is
/// v, link[i], link[i+1] (cyclic if closed).
struct Fan {
  SheetId sheet;
  bool closed = false;
  std::vector<FaceId> faces;   // k
  std::vector<VertexId> link;  // k if closed, else k + 1
};

class LocalMesh {
 public:
  LocalMesh(const Complex& complex, const Brep& brep, const std::vector<std::uint8_t>& in_zone);

  /// A piece: faces of one sheet (ascending) by themselves, with ids of their own. Its curves and corners are fixed.
  /// `whole` is only asked for what other sheets have there, and must not change before absorb(), except by that.
  LocalMesh(const LocalMesh& whole, SheetId sheet, std::span<const FaceId> faces);
  /// By sheet, the faces of the zone and those of the same sheet that touch them.
  [[nodiscard]] std::vector<std::vector<FaceId>> faces_by_sheet() const;
  /// Whether a piece has made an edge or a face that another sheet has got since.
  [[nodiscard]] bool clashes_with(const LocalMesh& piece) const;
  /// Takes back what has become of a piece. Cannot be undone.
  void absorb(const LocalMesh& piece);

  [[nodiscard]] std::size_t n_vertices() const { return vertices_.size(); }
  [[nodiscard]] std::size_t n_faces() const { return faces_.size(); }
  [[nodiscard]] const LocalVertex& vertex(VertexId v) const { return vertices_[v.value]; }
  [[nodiscard]] const LocalFace& face(FaceId f) const { return faces_[f.value]; }
  [[nodiscard]] Vec3 position(VertexId v) const { return vertices_[v.value].position; }
  [[nodiscard]] std::array<Vec3, 3> corners(FaceId f) const;
  [[nodiscard]] std::size_t n_sheets() const { return brep_.sheets.size(); }
  [[nodiscard]] const Sheet& sheet(SheetId s) const { return brep_.sheets[s.value]; }
  /// Faces on a vertex, no order promised (but the same in every run).
  [[nodiscard]] std::span<const FaceId> star(VertexId v) const { return star_[v.value]; }
  [[nodiscard]] bool is_new(FaceId f) const { return faces_[f.value].is_new; }
  [[nodiscard]] bool is_new(VertexId v) const { return v.value >= n_original_vertices_; }
  /// Whether a face is new or a corner of it was moved.
  [[nodiscard]] bool is_changed(FaceId f) const;
  /// Mean Q of the faces that are not as in the complex; 1 if there are none.
  [[nodiscard]] double mean_quality() const;

  /// Also true of the edges that other sheets than that of a piece have.
  [[nodiscard]] bool has_edge(VertexId a, VertexId b) const;
  [[nodiscard]] bool has_face(const std::array<VertexId, 3>& v) const;
  /// Faces on the edge a b.
  [[nodiscard]] FacesOfEdge faces_at(VertexId a, VertexId b) const;
  /// The curve that the edge a b lies on, or none.
  [[nodiscard]] CurveId curve_at(VertexId a, VertexId b) const;
  /// The two neighbours of a curve vertex along its curve; invalid where there are not exactly two.
  [[nodiscard]] std::array<VertexId, 2> curve_neighbours(VertexId v) const;
  /// All fans of a vertex whose faces are all in the zone; empty if its star is not manifold
  /// between curves.
  [[nodiscard]] std::vector<Fan> fans(VertexId v) const;

  /// Completes what the complex says of a vertex; not a change.
  void describe(VertexId v, const LocalVertex& as) { vertices_[v.value] = as; }

  // Changes; all of them can be undone.
  VertexId add_vertex(const LocalVertex& v);
  FaceId add_face(const LocalFace& f);  // q is computed
  void remove_face(FaceId f);
  void set_vertex(VertexId v, const LocalVertex& to);  // new place; q of its faces follows
  void set_deviation(FaceId f, double deviation) { faces_[f.value].deviation = deviation; }
  void set_size(VertexId v, double size) { vertices_[v.value].size = size, vertices_[v.value].sized_at = position(v); }

  /// Whether a face on the vertex has changed since it was last called calm.
  [[nodiscard]] bool stirred(VertexId v) const { return stirred_[v.value] != 0; }
  void calm(VertexId v) { stirred_[v.value] = 0; }

  using Mark = std::size_t;
  [[nodiscard]] Mark mark() const { return history_.size(); }
  /// Takes back all changes since the mark.
  void undo(Mark to);
  /// Faces made since the mark that still exist.
  [[nodiscard]] std::vector<FaceId> faces_since(Mark mark) const;
  /// Drops the history; earlier marks become invalid.
  void forget() { history_.clear(), old_places_.clear(); }

  [[nodiscard]] double quality(const LocalFace& f) const;
  /// The same with vertex v at p.
  [[nodiscard]] double quality(const LocalFace& f, VertexId v, Vec3 p) const;

 private:
  enum class Step : std::uint8_t { kAddVertex, kAddFace, kRemoveFace, kSetVertex };
  struct Change {
    Step step;
    std::uint32_t id;
  };
  void stir(FaceId f);
  void measure_star(VertexId v);
  [[nodiscard]] bool is_on_rim(VertexId v) const { return vertices_[v.value].dimension != Dimension::kSheet; }
  /// Whether another sheet than that of the piece has a face with all of these vertices of the piece's rim.
  [[nodiscard]] bool is_elsewhere(std::span<const VertexId> v) const;
  void link(FaceId f);
  void unlink(FaceId f);

  const Brep& brep_;
  std::vector<LocalVertex> vertices_;
  std::vector<LocalFace> faces_;
  std::vector<Few<FaceId, 8>> star_;
  std::vector<std::uint8_t> stirred_;  // by vertex
  std::size_t n_original_vertices_ = 0;
  std::vector<Change> history_;
  std::vector<LocalVertex> old_places_;  // one per kSetVertex of the history

  // Of a piece:
  const LocalMesh* whole_ = nullptr;
  SheetId sheet_;
  std::vector<VertexId> vertex_in_whole_;  // by vertex at the start
  std::vector<FaceId> face_in_whole_;      // by face at the start
};

}  // namespace meshgraft
