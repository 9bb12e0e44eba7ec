// Pieces of the working mesh: a sheet by itself, so that all of them can be worked on at the same time.
#include <algorithm>

#include "core/bits.hpp"
#include "remesh/local_mesh.hpp"

namespace meshgraft {

std::vector<std::vector<FaceId>> LocalMesh::faces_by_sheet() const {
  std::vector<std::vector<FaceId>> faces(n_sheets());
  std::vector<std::uint8_t> near_zone(vertices_.size(), 0);
  for (const LocalFace& face : faces_)
    if (face.alive && face.in_zone)
      for (const VertexId v : face.v) near_zone[v.value] = 1;
  const auto touches_zone = [&](const LocalFace& face) {
    return std::ranges::any_of(face.v, [&](VertexId v) {
      return near_zone[v.value] != 0 && std::ranges::any_of(star_[v.value], [&](FaceId f) {
               return faces_[f.value].in_zone && faces_[f.value].sheet == face.sheet;
             });
    });
  };
  for (std::size_t f = 0; f < faces_.size(); ++f)
    if (faces_[f].alive && (faces_[f].in_zone || touches_zone(faces_[f]))) faces[faces_[f].sheet.value].emplace_back(f);
  return faces;
}

LocalMesh::LocalMesh(const LocalMesh& whole, SheetId sheet, std::span<const FaceId> faces)
    : brep_(whole.brep_), whole_(&whole), sheet_(sheet), face_in_whole_(faces.begin(), faces.end()) {
  Bits used(whole.n_vertices());
  for (const FaceId f : faces)
    for (const VertexId v : whole.face(f).v) used.set(v.value);
  used.count();
  used.each([&](std::size_t v) {
    vertex_in_whole_.emplace_back(v);
    vertices_.push_back(whole.vertices_[v]);
    stirred_.push_back(whole.stirred_[v]);
    if (is_on_rim(VertexId(vertices_.size() - 1))) vertices_.back().fixed = true;
  });
  star_.resize(vertices_.size());
  faces_.reserve(faces.size());
  for (const FaceId f : faces) {
    faces_.push_back(whole.face(f));
    for (VertexId& v : faces_.back().v) {
      v = VertexId(used.rank(v.value));
      star_[v.value].emplace_back(faces_.size() - 1);
    }
  }
}

bool LocalMesh::is_elsewhere(std::span<const VertexId> v) const {
  if (whole_ == nullptr || !std::ranges::all_of(v, [&](VertexId u) { return is_on_rim(u); })) return false;
  return std::ranges::any_of(whole_->star(vertex_in_whole_[v[0].value]), [&](FaceId f) {
    const LocalFace& face = whole_->face(f);
    return face.sheet != sheet_ &&
           std::ranges::all_of(v, [&](VertexId u) { return face.has(vertex_in_whole_[u.value]); });
  });
}

bool LocalMesh::clashes_with(const LocalMesh& piece) const {
  return std::ranges::any_of(piece.faces_, [&](const LocalFace& face) {
    if (!face.alive || !face.is_new) return false;
    if (std::ranges::all_of(face.curve, [](CurveId c) { return c.valid(); })) return piece.is_elsewhere(face.v);
    for (std::size_t k = 0; k < 3; ++k)
      if (!face.curve[k].valid() && piece.is_elsewhere(std::array{face.v[k], face.v[(k + 1) % 3]})) return true;
    return false;
  });
}

void LocalMesh::absorb(const LocalMesh& piece) {
  for (std::size_t f = 0; f < piece.face_in_whole_.size(); ++f) {
    LocalFace& face = faces_[piece.face_in_whole_[f].value];
    if (piece.faces_[f].alive) {
      face.q = piece.faces_[f].q, face.deviation = piece.faces_[f].deviation;
    } else {
      unlink(piece.face_in_whole_[f]);
      face.alive = false;
    }
  }
  std::vector<VertexId> id = piece.vertex_in_whole_;
  for (std::size_t v = 0; v < piece.n_vertices(); ++v) {
    if (v == id.size()) id.emplace_back();
    if (piece.is_on_rim(VertexId(v))) continue;
    if (!id[v].valid()) {
      if (piece.star_[v].empty()) continue;
      id[v] = add_vertex(piece.vertices_[v]);
    }
    vertices_[id[v].value] = piece.vertices_[v];
  }
  for (std::size_t f = piece.face_in_whole_.size(); f < piece.faces_.size(); ++f) {
    if (!piece.faces_[f].alive) continue;
    faces_.push_back(piece.faces_[f]);
    for (VertexId& v : faces_.back().v) v = id[v.value];
    link(FaceId(faces_.size() - 1));
  }
  for (std::size_t v = 0; v < piece.n_vertices(); ++v)
    if (id[v].valid() && !piece.is_on_rim(VertexId(v))) stirred_[id[v].value] = piece.stirred_[v];
  forget();
}

}  // namespace meshgraft
