#include "remesh/local_mesh.hpp"

#include <algorithm>

#include "geometry/quality.hpp"

namespace meshgraft {

LocalMesh::LocalMesh(const Complex& complex, const Brep& brep, const std::vector<std::uint8_t>& in_zone)
    : brep_(brep), n_original_vertices_(complex.n_vertices()) {
  vertices_.resize(complex.n_vertices());
  star_.resize(complex.n_vertices());
  stirred_.assign(complex.n_vertices(), 1);
  faces_.resize(complex.n_faces());
  for (std::size_t v = 0; v < complex.n_vertices(); ++v) {
    vertices_[v].position = complex.position[v];
    vertices_[v].dimension = brep.dimension[v];
    vertices_[v].fixed = brep.dimension[v] == Dimension::kCorner || complex.state[v] != VertexState::kOpen;
  }
  for (std::size_t f = 0; f < complex.n_faces(); ++f) {
    LocalFace& face = faces_[f];
    face.v = complex.face[f], face.curve = brep.curve_of_edge[f], face.sheet = brep.sheet_of_face[f];
    face.in_zone = in_zone[f] != 0;
    link(FaceId(f));
    if (face.in_zone) face.q = quality(face);
    for (const VertexId v : face.v) {
      if (!face.in_zone) vertices_[v.value].fixed = true;
      if (vertices_[v.value].dimension != Dimension::kSheet) continue;
      vertices_[v.value].sheet = face.sheet, vertices_[v.value].beneath = FaceId(f);
    }
  }
}

std::array<Vec3, 3> LocalMesh::corners(FaceId f) const {
  const auto& v = faces_[f.value].v;
  return {position(v[0]), position(v[1]), position(v[2])};
}

bool LocalMesh::has_edge(VertexId a, VertexId b) const {
  return std::ranges::any_of(star_[a.value], [&](FaceId f) { return faces_[f.value].has(b); }) ||
         is_elsewhere(std::array{a, b});
}

bool LocalMesh::has_face(const std::array<VertexId, 3>& v) const {
  return std::ranges::any_of(star_[v[0].value],
                             [&](FaceId f) { return faces_[f.value].has(v[1]) && faces_[f.value].has(v[2]); }) ||
         is_elsewhere(v);
}

FacesOfEdge LocalMesh::faces_at(VertexId a, VertexId b) const {
  FacesOfEdge found;
  for (const FaceId f : star_[a.value])
    if (faces_[f.value].has(b)) found.push_back(f);
  return found;
}

CurveId LocalMesh::curve_at(VertexId a, VertexId b) const {
  for (const FaceId f : star_[a.value]) {
    const LocalFace& face = faces_[f.value];
    const std::size_t k = face.corner_of(a);
    if (face.v[(k + 1) % 3] == b) return face.curve[k];
    if (face.v[(k + 2) % 3] == b) return face.curve[(k + 2) % 3];
  }
  return {};
}

std::array<VertexId, 2> LocalMesh::curve_neighbours(VertexId v) const {
  std::array<VertexId, 2> found;
  std::size_t n = 0;
  const auto add = [&](VertexId u) {
    if ((n > 0 && found[0] == u) || (n > 1 && found[1] == u)) return;
    if (n < 2) found[n] = u;
    ++n;
  };
  for (const FaceId f : star_[v.value]) {
    const LocalFace& face = faces_[f.value];
    const std::size_t k = face.corner_of(v);
    if (face.curve[k].valid()) add(face.v[(k + 1) % 3]);
    if (face.curve[(k + 2) % 3].valid()) add(face.v[(k + 2) % 3]);
  }
  return n == 2 ? found : std::array<VertexId, 2>{};
}

std::vector<Fan> LocalMesh::fans(VertexId v) const {
  struct Spoke {
    FaceId face;
    VertexId from, to;               // the face is v, from, to
    bool curve_before, curve_after;  // edges v from, to v
    bool used = false;
  };
  Few<Spoke, 8> spokes;
  for (const FaceId f : star_[v.value]) {
    const LocalFace& face = faces_[f.value];
    if (!face.in_zone) return {};
    const std::size_t k = face.corner_of(v);
    spokes.push_back(
        {f, face.v[(k + 1) % 3], face.v[(k + 2) % 3], face.curve[k].valid(), face.curve[(k + 2) % 3].valid()});
  }
  std::vector<Fan> result;
  const auto follow = [&](std::size_t first) {
    Fan fan;
    fan.sheet = faces_[spokes[first].face.value].sheet;
    std::size_t at = first;
    while (true) {
      Spoke& spoke = spokes[at];
      spoke.used = true;
      fan.faces.push_back(spoke.face), fan.link.push_back(spoke.from);
      if (spoke.curve_after) {
        fan.link.push_back(spoke.to);
        break;
      }
      std::size_t next = spokes.size();
      for (std::size_t k = 0; k < spokes.size(); ++k)
        if (spokes[k].from == spoke.to && !spokes[k].curve_before) next = k;
      if (next == first) {
        fan.closed = true;
        break;
      }
      if (next == spokes.size() || spokes[next].used || faces_[spokes[next].face.value].sheet != fan.sheet)
        return false;
      at = next;
    }
    result.push_back(std::move(fan));
    return true;
  };
  for (std::size_t k = 0; k < spokes.size(); ++k)
    if (spokes[k].curve_before && !follow(k)) return {};
  for (std::size_t k = 0; k < spokes.size(); ++k)
    if (!spokes[k].used && !follow(k)) return {};
  return result;
}

void LocalMesh::stir(FaceId f) {
  for (const VertexId v : faces_[f.value].v) stirred_[v.value] = 1;
}

void LocalMesh::link(FaceId f) {
  for (const VertexId v : faces_[f.value].v) star_[v.value].push_back(f);
  stir(f);
}

void LocalMesh::unlink(FaceId f) {
  for (const VertexId v : faces_[f.value].v) {
    auto& star = star_[v.value];
    *std::ranges::find(star, f) = star.back();
    star.pop_back();
  }
}

VertexId LocalMesh::add_vertex(const LocalVertex& v) {
  const VertexId id(vertices_.size());
  vertices_.push_back(v);
  star_.emplace_back();
  stirred_.push_back(1);
  history_.push_back({Step::kAddVertex, id.value});
  return id;
}

FaceId LocalMesh::add_face(const LocalFace& f) {
  const FaceId id(faces_.size());
  faces_.push_back(f);
  faces_.back().q = quality(f), faces_.back().deviation = LocalFace::kUnknown, faces_.back().is_new = true;
  link(id);
  history_.push_back({Step::kAddFace, id.value});
  return id;
}

void LocalMesh::remove_face(FaceId f) {
  unlink(f);
  faces_[f.value].alive = false;
  history_.push_back({Step::kRemoveFace, f.value});
}

void LocalMesh::set_vertex(VertexId v, const LocalVertex& to) {
  history_.push_back({Step::kSetVertex, v.value});
  old_places_.push_back(vertices_[v.value]);
  vertices_[v.value] = to;
  vertices_[v.value].moved = true;
  measure_star(v);
}

void LocalMesh::measure_star(VertexId v) {
  for (const FaceId f : star_[v.value]) {
    LocalFace& face = faces_[f.value];
    face.q = quality(face), face.deviation = LocalFace::kUnknown;
    stir(f);
  }
}

void LocalMesh::undo(Mark to) {
  while (history_.size() > to) {
    const Change change = history_.back();
    history_.pop_back();
    switch (change.step) {
      case Step::kAddVertex:
        vertices_.pop_back();
        star_.pop_back();
        stirred_.pop_back();
        break;
      case Step::kAddFace:
        unlink(FaceId(std::size_t{change.id}));
        faces_.pop_back();
        break;
      case Step::kRemoveFace:
        faces_[change.id].alive = true;
        link(FaceId(std::size_t{change.id}));
        faces_[change.id].q = quality(faces_[change.id]);
        faces_[change.id].deviation = LocalFace::kUnknown;
        break;
      case Step::kSetVertex:
        vertices_[change.id] = old_places_.back();
        old_places_.pop_back();
        measure_star(VertexId(std::size_t{change.id}));
        break;
    }
  }
}

std::vector<FaceId> LocalMesh::faces_since(Mark mark) const {
  std::vector<FaceId> made;
  for (std::size_t k = mark; k < history_.size(); ++k)
    if (history_[k].step == Step::kAddFace && faces_[history_[k].id].alive)
      made.emplace_back(std::size_t{history_[k].id});
  return made;
}

bool LocalMesh::is_changed(FaceId f) const {
  return is_new(f) || std::ranges::any_of(face(f).v, [&](VertexId v) { return vertex(v).moved; });
}

double LocalMesh::mean_quality() const {
  double sum = 0;
  std::size_t n = 0;
  for (std::size_t k = 0; k < n_faces(); ++k)
    if (const FaceId f(k); face(f).alive && is_changed(f)) sum += face(f).q, ++n;
  return n > 0 ? sum / static_cast<double>(n) : 1;
}

double LocalMesh::quality(const LocalFace& f) const {
  const Triangle t{position(f.v[0]), position(f.v[1]), position(f.v[2])};
  const Sheet& s = brep_.sheets[f.sheet.value];
  return s.planar ? signed_aspect_ratio(t, s.normal) : aspect_ratio(t);
}

double LocalMesh::quality(const LocalFace& f, VertexId v, Vec3 p) const {
  Triangle t{position(f.v[0]), position(f.v[1]), position(f.v[2])};
  const Sheet& s = brep_.sheets[f.sheet.value];
  const Vec3 normal = s.planar ? s.normal : area_vector(t);
  t[f.corner_of(v)] = p;
  return signed_aspect_ratio(t, normal);
}

}  // namespace meshgraft
