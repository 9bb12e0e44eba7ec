// The local operations of the remesher. Each checks first and leaves a valid mesh or an unchanged one.
#pragma once

#include <memory>
#include <optional>

#include "remesh/local_mesh.hpp"
#include "remesh/reference.hpp"
#include "remesh/remesh.hpp"
#include "remesh/sizing.hpp"
#include "remesh/star.hpp"

namespace meshgraft {

/// By how much the chord between two nodes of a curve may exceed the sagitta of the ruler, so that
/// nodes can slide a little.
inline constexpr double kSagittaSlack = 1.15;

/// A mesh is valid when every curve edge has one face per side of each sheet, every other edge has
/// two faces of one sheet, no two faces have the same corners, and each face faces like its sheet.
class Editor {
 public:
  Editor(const Complex& complex, const Brep& brep, const std::vector<std::uint8_t>& in_zone, Sizing sizing,
         const RemeshOptions& options);

  /// Of a piece of another's mesh; see LocalMesh.
  Editor(const Editor& whole, SheetId sheet, std::span<const FaceId> faces);
  [[nodiscard]] bool clashes_with(const Editor& piece) const { return mesh_.clashes_with(piece.mesh_); }
  void absorb(const Editor& piece) { mesh_.absorb(piece.mesh_); }

  [[nodiscard]] const LocalMesh& mesh() const { return mesh_; }
  [[nodiscard]] const Reference& reference() const { return *reference_; }
  [[nodiscard]] const RemeshOptions& options() const { return options_; }

  /// Wanted edge length at a vertex; the mean of both at an edge.
  double size(VertexId v) {
    const double known = mesh_.vertex(v).size;
    return known > 0 ? known : asked_size(v);
  }
  double size(VertexId a, VertexId b) { return 0.5 * (size(a) + size(b)); }
  /// At a point of a sheet.
  [[nodiscard]] double size(SheetId sheet, Vec3 p) const { return sizing_.in_sheet(sheet, p); }
  [[nodiscard]] double length(VertexId a, VertexId b) const { return distance(mesh_.position(a), mesh_.position(b)); }

  /// What a face costs, at most as much as a flat one. The remesher lowers the sum of this.
  double cost(FaceId f);
  double cost(std::span<const FaceId> faces);

  /// Distance of a face from the reference over what RemeshOptions::max_deviation allows; 10 and more if it
  /// does not face like the reference beneath; 0 in planar sheets. Up to 1 it may be more than the true one: what is
  /// allowed is not measured to the end. No change leaves a face with more than 1, unless the faces it replaces have
  /// more.
  double deviation(FaceId f);
  /// Lets every change go this far instead of 1.
  void set_leeway(double leeway) { leeway_ = leeway; }

  /// Replaces the edge a b between two faces of a sheet by the other diagonal.
  bool flip(VertexId a, VertexId b);
  /// Whether that would lower the cost.
  bool flip_gains(VertexId a, VertexId b);
  /// Removes a vertex of a sheet or of a curve and fills its star anew, as well as possible.
  bool remove(VertexId v);
  /// Puts a vertex into a face, at a point of its sheet.
  std::optional<VertexId> insert(FaceId f, const Foot& at);
  /// Puts a vertex in the middle of an edge (of the piece of its curve, if it lies on one).
  std::optional<VertexId> split(VertexId a, VertexId b);
  /// Puts a vertex at an arc length on the edge a b of a curve; the place must lie on that edge.
  std::optional<VertexId> split_curve(VertexId a, VertexId b, CurveId curve, double arc);
  /// Replaces faces by others with the same boundary, unchecked.
  void replace(std::span<const FaceId> faces, std::span<const LocalFace> by);
  /// Whether a vertex is to stay where it is for now.
  void hold(VertexId v, bool held);
  /// Puts a vertex of a sheet at a point, on its surface or not, unchecked.
  void put(VertexId v, Vec3 p);
  /// Moves a vertex in its sheet or along its curve to where its faces cost least.
  bool relax(VertexId v);
  /// The same, but for the best worst face.
  bool sharpen(VertexId v);

  using Mark = LocalMesh::Mark;
  [[nodiscard]] Mark mark() const { return mesh_.mark(); }
  void undo(Mark to) { mesh_.undo(to); }
  void forget() { mesh_.forget(); }

  /// Arc lengths of the neighbours of a curve vertex on either side of its own, unwrapped.
  struct Reach {
    double from, to;
    VertexId before, after;
  };
  [[nodiscard]] std::optional<Reach> reach(VertexId v) const;

 private:
  using Goal = double (Star::*)(Vec3 p, double enough) const;
  /// Asks for the wanted edge length at a vertex, and remembers it.
  double asked_size(VertexId v);
  double cost(const LocalFace& f);
  /// star_ becomes that of v.
  void gather(VertexId v);
  bool search(VertexId v, Goal goal);
  bool search_in_sheet(VertexId v, Goal goal);
  bool search_on_curve(VertexId v, Goal goal);
  bool place(VertexId v, const LocalVertex& to);
  bool fill(VertexId v, const Fan& fan, CurveId closing);
  bool close_gap(const Fan& fan, CurveId closing);
  /// Whether the chord between two arc lengths of a curve is as near to it as the ruler wants, and by the measure of
  /// the wanted size too.
  [[nodiscard]] bool follows(CurveId curve, double from, double to, double chord) const;
  [[nodiscard]] bool may_join_along_curve(VertexId v, const Reach& span, std::span<const Fan> fans) const;
  void split_faces(VertexId a, VertexId b, VertexId middle, std::span<const FaceId> faces);
  [[nodiscard]] std::optional<double> middle_arc(VertexId a, VertexId b, CurveId curve) const;
  [[nodiscard]] bool splittable(std::span<const FaceId> faces) const;
  [[nodiscard]] bool faces_right(const LocalFace& f) const;
  [[nodiscard]] double deviation(const LocalFace& f) const;
  /// Of faces that replace the given ones.
  double allowed_deviation(std::span<const FaceId> replaced);

  const Brep& brep_;
  std::shared_ptr<const Reference> reference_;  // the same for all pieces
  LocalMesh mesh_;
  Sizing sizing_;
  RemeshOptions options_;
  double leeway_ = 1;
  Star star_;  // of the vertex that is being moved
};

}  // namespace meshgraft
