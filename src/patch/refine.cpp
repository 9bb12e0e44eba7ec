#include "patch/refine.hpp"

#include <algorithm>
#include <limits>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr double kLeastGain = 1e-6;  // of Q; keeps equal diagonals from swapping for ever
constexpr int kMostSweeps = 20;      // of swaps between two rounds of insertion

class Refiner {
 public:
  Refiner(Editor& editor, const std::vector<std::uint8_t>& filled, const RefineOptions& options)
      : editor_(editor), filled_(filled), options_(options) {}

  void run() {
    swap_all();
    for (int round = 0; round < options_.most_rounds && insert_all(); ++round) swap_all();
  }

 private:
  [[nodiscard]] const LocalMesh& mesh() const { return editor_.mesh(); }

  [[nodiscard]] bool is_filled(FaceId f) const {
    const LocalFace& face = mesh().face(f);
    return face.alive && face.in_zone && mesh().is_new(f) && filled_[face.sheet.value] != 0;
  }

  bool insert_all() {
    bool any = false;
    const std::size_t n = mesh().n_faces();
    for (std::size_t k = 0; k < n; ++k)
      if (const FaceId f(k); is_filled(f) && is_too_large(f) && insert(f)) any = true;
    return any;
  }

  [[nodiscard]] bool is_too_large(FaceId f) {
    const LocalFace face = mesh().face(f);
    const Triangle t = mesh().corners(f);
    const Vec3 c = centroid(t);
    const double wanted = editor_.size(face.sheet, c);
    for (std::size_t k = 0; k < 3; ++k) {
      const double reach = options_.density * distance(t[k], c);
      if (reach <= wanted || reach <= editor_.size(face.v[k])) return false;
    }
    return true;
  }

  bool insert(FaceId f) {
    const Vec3 c = centroid(mesh().corners(f));
    Foot at = editor_.reference().project(mesh().face(f).sheet, c, {});
    at.point = c;
    return editor_.insert(f, at).has_value();
  }

  void swap_all() {
    bool any = true;
    for (int sweep = 0; sweep < kMostSweeps && any; ++sweep) {
      any = false;
      for (std::size_t k = 0; k < mesh().n_faces(); ++k)
        for (std::size_t i = 0; i < 3 && is_filled(FaceId(k)); ++i) any = swap(FaceId(k), i) || any;
    }
  }

  /// Each edge once, from the face with the smaller id.
  bool swap(FaceId f, std::size_t i) {
    const LocalFace& face = mesh().face(f);
    const VertexId a = face.v[i], b = face.v[(i + 1) % 3], c = face.v[(i + 2) % 3];
    if (face.curve[i].valid()) return false;
    const FacesOfEdge faces = mesh().faces_at(a, b);
    if (faces.size() != 2) return false;
    const FaceId g = faces[0] == f ? faces[1] : faces[0];
    if (g < f || !is_filled(g)) return false;
    const LocalFace& other = mesh().face(g);
    const VertexId d = other.v[(other.corner_of(b) + 2) % 3] == a ? other.v[(other.corner_of(b) + 1) % 3]
                                                                  : other.v[(other.corner_of(b) + 2) % 3];
    const double before = std::min(face.q, other.q);
    LocalFace first = face, second = face;
    first.v = {c, a, d}, second.v = {d, b, c};
    if (!(std::min(mesh().quality(first), mesh().quality(second)) > before + kLeastGain)) return false;
    return !folds(face, other, first, second) && editor_.flip(a, b);
  }

  /// Whether two faces that replace two others would be folded back on each other or on a neighbour, more than those.
  [[nodiscard]] bool folds(const LocalFace& f, const LocalFace& g, const LocalFace& first,
                           const LocalFace& second) const {
    const double now = std::min(dot(normal(first), normal(second)), least_cosine(f, g, first, second));
    return now < 0 && now < std::min(dot(normal(f), normal(g)), least_cosine(f, g, f, g));
  }

  /// With the faces of the sheet beyond the edges of f and g that these do not share.
  [[nodiscard]] double least_cosine(const LocalFace& f, const LocalFace& g, const LocalFace& first,
                                    const LocalFace& second) const {
    double least = 1;
    for (const LocalFace& made : {first, second})
      for (std::size_t k = 0; k < 3; ++k) {
        const VertexId a = made.v[k], b = made.v[(k + 1) % 3];
        for (const FaceId beyond : mesh().faces_at(a, b)) {
          const LocalFace& other = mesh().face(beyond);
          if (is_filled(beyond) && other.sheet == f.sheet && other.v != f.v && other.v != g.v)
            least = std::min(least, dot(normal(made), normal(other)));
        }
      }
    return least;
  }

  [[nodiscard]] Vec3 normal(const LocalFace& f) const {
    return unit_normal({mesh().position(f.v[0]), mesh().position(f.v[1]), mesh().position(f.v[2])});
  }

  Editor& editor_;
  const std::vector<std::uint8_t>& filled_;
  const RefineOptions& options_;
};

}  // namespace

void refine(Editor& editor, const std::vector<std::uint8_t>& filled, const RefineOptions& options) {
  editor.set_leeway(std::numeric_limits<double>::infinity());
  Refiner(editor, filled, options).run();
}

}  // namespace meshgraft
