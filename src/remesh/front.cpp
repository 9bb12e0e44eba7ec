#include "remesh/front.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "geometry/closest.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr double kGood = 0.5;       // a sheet all of whose faces are as in the input and better than this is left alone
constexpr double kAccepted = 1.25;  // circumradius of a final face, share of that of the wanted equilateral
constexpr double kNearest = 0.62;   // no new vertex nearer to another, share of the wanted size
constexpr double kNearestEdge = 0.5;                 // nor nearer to an edge that cannot be flipped
constexpr double kLeastApex = 0.6, kMostApex = 1.5;  // of the wanted size over the edge below: bounds of the apex
constexpr int kLongestWalk = 60;                     // faces crossed in looking for one
constexpr double kLeeway = 6;                        // of the deviation, while the room is empty
constexpr int kClearRounds = 2;                      // a removal may have to wait for its neighbours

class Front {
 public:
  explicit Front(Editor& editor) : editor_(editor) {}

  void run() {
    editor_.set_leeway(kLeeway);
    find_leaving();
    if (editor_.options().keeps_good) clear();
    legalise_all();
    start();
    do {
      while (!edges_.empty()) {
        const auto [a, b] = edges_.front();
        edges_.pop_front();
        advance(a, b);
      }
    } while (clear_rest());
    editor_.set_leeway(1);
    editor_.forget();
  }

 private:
  [[nodiscard]] const LocalMesh& mesh() const { return editor_.mesh(); }

  void find_leaving() {
    std::vector<std::uint8_t> disturbed(mesh().n_sheets(), editor_.options().keeps_good ? 0 : 1);
    for (std::size_t f = 0; f < mesh().n_faces(); ++f) {
      const LocalFace& face = mesh().face(FaceId(f));
      if (face.alive && face.in_zone && (mesh().is_new(FaceId(f)) || face.q < kGood)) disturbed[face.sheet.value] = 1;
    }
    is_leaving_.assign(mesh().n_vertices(), 0);
    for (std::size_t k = 0; k < mesh().n_vertices(); ++k) {
      const LocalVertex& v = mesh().vertex(VertexId(k));
      if (!v.fixed && !v.curve.valid() && v.sheet.valid() && disturbed[v.sheet.value] &&
          !mesh().star(VertexId(k)).empty())
        is_leaving_[k] = 1;
    }
  }

  [[nodiscard]] bool is_leaving(VertexId v) const { return v.value < is_leaving_.size() && is_leaving_[v.value] != 0; }

  /// Removes all that leave before the front starts; those that cannot be removed stay.
  void clear() {
    for (int round = 0; round < kClearRounds; ++round)
      for (std::size_t k = 0; k < is_leaving_.size(); ++k)
        if (is_leaving_[k] != 0 && editor_.remove(VertexId(k))) is_leaving_[k] = 0;
    std::ranges::fill(is_leaving_, std::uint8_t{0});
  }

  void legalise_all() {
    for (std::size_t f = 0; f < mesh().n_faces(); ++f)
      if (mesh().face(FaceId(f)).alive && (mesh().is_new(FaceId(f)) || !editor_.options().keeps_good))
        for (std::size_t k = 0; k < 3 && mesh().face(FaceId(f)).alive; ++k)
          legalise(mesh().face(FaceId(f)).v[k], mesh().face(FaceId(f)).v[(k + 1) % 3]);
  }

  /// The front starts at curves and at faces that stay.
  void start() {
    for (std::size_t f = 0; f < mesh().n_faces(); ++f) {
      const LocalFace& face = mesh().face(FaceId(f));
      if (!face.alive || !face.in_zone || accepted(FaceId(f))) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const VertexId a = face.v[k], b = face.v[(k + 1) % 3];
        bool final = face.curve[k].valid();
        for (const FaceId g : mesh().faces_at(a, b))
          final = final || (g.value != f && (!mesh().face(g).in_zone || accepted(g)));
        if (final) edges_.emplace_back(a, b);
      }
    }
  }

  [[nodiscard]] double mean_size(const LocalFace& f) const {
    return (editor_.size(f.v[0]) + editor_.size(f.v[1]) + editor_.size(f.v[2])) / 3;
  }

  [[nodiscard]] bool accepted(FaceId f) const {
    if (std::ranges::any_of(mesh().face(f).v, [&](VertexId v) { return is_leaving(v); })) return false;
    const Triangle t = mesh().corners(f);
    const double a = distance(t[0], t[1]), b = distance(t[1], t[2]), c = distance(t[2], t[0]);
    const double radius = a * b * c / (4 * area(t));
    return radius * std::sqrt(3.0) <= kAccepted * mean_size(mesh().face(f));
  }

  /// The face with the edge in the direction from a to b, if it is in the zone.
  [[nodiscard]] FaceId face_on(VertexId a, VertexId b) const {
    for (const FaceId f : mesh().star(a)) {
      const LocalFace& face = mesh().face(f);
      if (face.in_zone && face.v[(face.corner_of(a) + 1) % 3] == b) return f;
    }
    return {};
  }

  void advance(VertexId a, VertexId b) {
    if (is_leaving(a) || is_leaving(b)) return;  // not final
    const FaceId base = face_on(a, b);           // on a curve with several sheets, each comes up in its turn
    if (!base.valid() || accepted(base)) return;
    const LocalFace face = mesh().face(base);
    const Vec3 p = mesh().position(a), q = mesh().position(b), middle = midpoint(p, q);
    const double edge = distance(p, q);
    const Vec3 inwards = normalized(cross(area_vector(mesh().corners(base)), q - p));
    const double size = std::clamp(editor_.size(a, b), kLeastApex * edge, kMostApex * edge);
    const double height = std::sqrt(std::max(size * size - 0.25 * edge * edge, 0.0));
    const Foot apex = editor_.reference().place(face.sheet, middle + height * inwards, FaceId{});
    FaceId at = locate(base, apex.point);
    while (at.valid() && make_room(at, apex.point, size)) at = locate(face_on(a, b), apex.point);
    if (!at.valid() || crowded(at, apex.point, size)) return;
    const auto v = editor_.insert(at, apex);
    if (!v) return;
    const std::vector<FaceId> star(mesh().star(*v).begin(), mesh().star(*v).end());
    for (const FaceId f : star) {
      const LocalFace piece = mesh().face(f);
      legalise(piece.v[0], piece.v[1]);
    }
    add_edges(mesh().star(*v));
  }

  void add_edges(std::span<const FaceId> faces) {
    for (const FaceId f : faces) {
      const auto& w = mesh().face(f).v;
      for (std::size_t k = 0; k < 3; ++k)
        edges_.emplace_back(w[k], w[(k + 1) % 3]), edges_.emplace_back(w[(k + 1) % 3], w[k]);
    }
  }

  /// Removes vertices that leave, in the face or beside it and nearer to p than a new one there would be to others.
  bool make_room(FaceId at, Vec3 p, double size) {
    std::vector<VertexId> near;
    for (const VertexId u : mesh().face(at).v)
      for (const FaceId f : mesh().star(u))
        for (const VertexId v : mesh().face(f).v)
          if (is_leaving(v) && distance(mesh().position(v), p) < size) near.push_back(v);
    for (const VertexId v : near) leave(v);
    return !near.empty();
  }

  /// Removes a vertex, or makes it one that stays if that cannot be.
  void leave(VertexId v) {
    if (!is_leaving(v)) return;
    is_leaving_[v.value] = 0;
    editor_.forget();
    if (!editor_.remove(v)) {
      add_edges(mesh().star(v));
      return;
    }
    for (const FaceId f : editor_.mesh().faces_since(0)) {
      const auto corners = mesh().face(f).v;
      add_edges(std::array{f});
      for (std::size_t k = 0; k < 3; ++k) legalise(corners[k], corners[(k + 1) % 3]);
    }
  }

  /// Removes all that the front has not reached; whether it has to go on there.
  bool clear_rest() {
    for (std::size_t k = 0; k < is_leaving_.size(); ++k) leave(VertexId(k));
    return !edges_.empty();
  }

  /// Walks from a face towards a point of its sheet; none if a curve or the zone ends before.
  [[nodiscard]] FaceId locate(FaceId from, Vec3 p) const {
    FaceId at = from;
    for (int step = 0; step < kLongestWalk; ++step) {
      const LocalFace& face = mesh().face(at);
      const Triangle t = mesh().corners(at);
      const Vec3 normal = area_vector(t);
      std::size_t out = 3;
      double worst = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 e = t[(k + 1) % 3] - t[k];
        const double side = dot(cross(e, p - t[k]), normal) / norm(e);
        if (side < worst) worst = side, out = k;
      }
      if (out == 3) return at;
      if (face.curve[out].valid()) return {};
      const FaceId next = face_on(face.v[(out + 1) % 3], face.v[out]);
      if (!next.valid() || mesh().face(next).sheet != face.sheet) return {};
      at = next;
    }
    return {};
  }

  /// Whether a vertex or an edge that cannot be flipped is too near to p, in the face or beside it.
  [[nodiscard]] bool crowded(FaceId at, Vec3 p, double size) const {
    const LocalFace& face = mesh().face(at);
    for (const VertexId u : face.v)
      for (const FaceId f : mesh().star(u)) {
        const LocalFace& near = mesh().face(f);
        if (near.sheet != face.sheet) continue;
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3 a = mesh().position(near.v[k]), b = mesh().position(near.v[(k + 1) % 3]);
          if (distance(a, p) < kNearest * size) return true;
          if ((near.curve[k].valid() || !near.in_zone) &&
              distance(closest_on_segment(p, a, b).point, p) < kNearestEdge * size)
            return true;
        }
      }
    return false;
  }

  /// Flips the edge, and those around it, until each is locally Delaunay.
  void legalise(VertexId a, VertexId b) {
    Few<std::array<VertexId, 2>, 16> todo{{a, b}};
    while (!todo.empty()) {
      const auto [u, v] = todo.back();
      todo.pop_back();
      const FacesOfEdge faces = mesh().faces_at(u, v);
      if (faces.size() != 2) continue;
      const auto opposite = [&](FaceId f) {
        for (const VertexId w : mesh().face(f).v)
          if (w != u && w != v) return w;
        return u;
      };
      const VertexId c = opposite(faces[0]), d = opposite(faces[1]);
      if (cotangent(c, u, v) + cotangent(d, u, v) >= -kLeastGain || !editor_.flip(u, v)) continue;
      todo.insert(todo.end(), {{u, c}, {c, v}, {v, d}, {d, u}});
    }
  }

  [[nodiscard]] double cotangent(VertexId at, VertexId a, VertexId b) const {
    const Vec3 e = mesh().position(a) - mesh().position(at), f = mesh().position(b) - mesh().position(at);
    return dot(e, f) / norm(cross(e, f));
  }

  static constexpr double kLeastGain = 1e-6;  // of the sum of cotangents; keeps squares from flipping for ever

  Editor& editor_;
  std::vector<std::uint8_t> is_leaving_;  // by vertex
  std::deque<std::pair<VertexId, VertexId>> edges_;
};

}  // namespace

void advance_front(Editor& editor) { Front(editor).run(); }

}  // namespace meshgraft
