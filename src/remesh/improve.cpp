#include "remesh/improve.hpp"

#include <algorithm>
#include <tuple>

#include "core/distinct.hpp"

namespace meshgraft {
namespace {

constexpr double kShort = 0.65;   // an edge shorter than this share of the wanted size loses an end
constexpr double kLong = 1.45;    // an edge longer than this share is split
constexpr double kTooLong = 1.7;  // no removal may leave an edge longer than this share
constexpr double kUsable = 0.05;  // least Q a removal for size may leave, to be mended later
constexpr double kGood = 0.5;     // faces of the inputs better than this are left alone

double shortest_share(Editor& editor, VertexId v) {
  double least = std::numeric_limits<double>::infinity();
  for (const FaceId f : editor.mesh().star(v))
    for (const VertexId u : editor.mesh().face(f).v)
      if (u != v) least = std::min(least, editor.length(u, v) / editor.size(u, v));
  return least;
}

bool usable(Editor& editor, std::span<const FaceId> faces) {
  for (const FaceId f : faces) {
    const LocalFace& face = editor.mesh().face(f);
    if (face.q < kUsable) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = face.v[k], b = face.v[(k + 1) % 3];
      if (editor.length(a, b) > kTooLong * editor.size(a, b)) return false;
    }
  }
  return true;
}

void remove_crowded(Editor& editor) {
  std::vector<std::pair<double, VertexId>> crowded;
  for (std::size_t k = 0; k < editor.mesh().n_vertices(); ++k) {
    const VertexId v(k);
    const LocalVertex& vertex = editor.mesh().vertex(v);
    if (vertex.fixed || vertex.curve.valid() || editor.mesh().star(v).empty()) continue;
    const double share = shortest_share(editor, v);
    if (share < kShort) crowded.emplace_back(share, v);
  }
  std::ranges::sort(crowded);
  for (const auto& [share, v] : crowded) {
    if (editor.mesh().star(v).empty() || shortest_share(editor, v) >= kShort) continue;
    const auto start = editor.mark();
    if (editor.remove(v) && !usable(editor, editor.mesh().faces_since(start))) editor.undo(start);
  }
}

void split_long(Editor& editor) {
  std::vector<std::tuple<double, VertexId, VertexId>> edges;
  for (std::size_t k = 0; k < editor.mesh().n_faces(); ++k) {
    const LocalFace& face = editor.mesh().face(FaceId(k));
    if (!face.alive || !face.in_zone) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId a = face.v[i], b = face.v[(i + 1) % 3];
      if (a > b || face.curve[i].valid()) continue;
      const double share = editor.length(a, b) / editor.size(a, b);
      if (share > kLong) edges.emplace_back(-share, a, b);
    }
  }
  std::ranges::sort(edges);
  for (const auto& [share, a, b] : edges)
    if (editor.mesh().has_edge(a, b)) (void)editor.split(a, b);
}

void flip_all(Editor& editor) {
  const std::size_t limit = 4 * editor.mesh().n_faces();  // faces made by flips come later in the loop
  for (std::size_t k = 0; k < editor.mesh().n_faces() && k < limit; ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      const LocalFace& face = editor.mesh().face(FaceId(k));
      if (!face.alive || !face.in_zone || is_settled(editor, FaceId(k))) break;
      const VertexId a = face.v[i], b = face.v[(i + 1) % 3];
      if (a < b && !face.curve[i].valid() && editor.flip_gains(a, b) && editor.flip(a, b)) break;
    }
}

template <class Which>
void relax(Editor& editor, Which&& which) {
  for (std::size_t k = 0; k < editor.mesh().n_vertices(); ++k) {
    const VertexId v(k);
    const LocalVertex& vertex = editor.mesh().vertex(v);
    if (vertex.fixed || editor.mesh().star(v).empty() || !which(vertex) || is_settled(editor, v)) continue;
    editor.relax(v);
  }
  editor.forget();
}

}  // namespace

bool is_settled(const Editor& editor, FaceId f) { return !editor.mesh().is_new(f) && editor.mesh().face(f).q >= kGood; }

bool is_settled(const Editor& editor, VertexId v) {
  return std::ranges::all_of(editor.mesh().star(v), [&](FaceId f) { return is_settled(editor, f); });
}

void fit_to_size(Editor& editor) {
  remove_crowded(editor);
  split_long(editor);
  editor.forget();
}

void relax_all(Editor& editor) {
  flip_all(editor);
  relax(editor, [](const LocalVertex&) { return true; });
}

void relax_curves(Editor& editor) {
  relax(editor, [](const LocalVertex& v) { return v.curve.valid(); });
}

std::vector<VertexId> release_poor(Editor& editor, double target) {
  std::vector<VertexId> around;
  for (std::size_t k = 0; k < editor.mesh().n_faces(); ++k) {
    const LocalFace& face = editor.mesh().face(FaceId(k));
    if (!face.alive || !face.in_zone || face.q >= target || is_settled(editor, FaceId(k))) continue;
    for (const VertexId v : face.v)
      for (const FaceId f : editor.mesh().star(v))
        for (const VertexId u : editor.mesh().face(f).v)
          if (editor.mesh().vertex(u).held) around.push_back(u);
  }
  make_distinct(around);
  for (const VertexId v : around) editor.hold(v, false);
  return around;
}

}  // namespace meshgraft
