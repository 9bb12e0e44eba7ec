#include "patch/blend.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr int kStepsAround = 9;  // from face to face: three rings of nodes

class Blender {
 public:
  Blender(Editor& editor, const Complex& complex, const std::vector<std::uint8_t>& filled, const BlendOptions& options)
      : editor_(editor), complex_(complex), filled_(filled), options_(options), steps_(editor.mesh().n_faces(), kFar) {}

  Blended run() {
    const std::size_t n = mesh().n_faces();
    for (std::size_t f = 0; f < n; ++f)
      if (steps_[f] == kFar && mesh().face(FaceId(f)).alive && moves(FaceId(f))) deform(area_around(FaceId(f)));
    return blended_;
  }

 private:
  static constexpr int kFar = kStepsAround + 1;

  [[nodiscard]] const LocalMesh& mesh() const { return editor_.mesh(); }

  [[nodiscard]] bool is_free(VertexId v) const {
    const LocalVertex& vertex = mesh().vertex(v);
    if (vertex.fixed || vertex.dimension != Dimension::kSheet) return false;
    return filled_[vertex.sheet.value] != 0 && !mesh().sheet(vertex.sheet).planar;
  }
  /// Whether a vertex of the face is free.
  [[nodiscard]] bool moves(FaceId f) const {
    return std::ranges::any_of(mesh().face(f).v, [&](VertexId v) { return is_free(v); });
  }

  /// Faces that are reached without crossing a fold, up to some steps from those that move.
  std::vector<FaceId> area_around(FaceId start) {
    std::vector<FaceId> area;
    std::deque<FaceId> open{start};
    steps_[start.value] = 0;
    while (!open.empty()) {
      const FaceId f = open.front();
      open.pop_front();
      area.push_back(f);
      for (std::size_t k = 0; k < 3; ++k) {
        const FaceId g = continued(f, k);
        if (!g.valid()) continue;
        const int steps = moves(g) ? 0 : steps_[f.value] + 1;
        if (steps >= steps_[g.value]) continue;
        steps_[g.value] = steps;
        steps == 0 ? open.push_front(g) : open.push_back(g);
      }
    }
    std::ranges::sort(area);
    area.erase(std::unique(area.begin(), area.end()), area.end());
    for (const FaceId f : area)
      if (!moves(f)) steps_[f.value] = kFar;  // may surround another area, too
    return area;
  }

  /// The face beyond an edge in which the surface goes on.
  FaceId continued(FaceId f, std::size_t k) {
    const LocalFace& face = mesh().face(f);
    const VertexId a = face.v[k], b = face.v[(k + 1) % 3];
    const Vec3 middle = midpoint(mesh().position(a), mesh().position(b));
    FaceId best;
    double flattest = std::cos(options_.smooth_angle);
    for (const FaceId g : mesh().faces_at(a, b)) {
      const LocalFace& other = mesh().face(g);
      if (g == f || component(f) != component(g) || other.v[(other.corner_of(b) + 1) % 3] != a) continue;
      if (!face.curve[k].valid() || (options_.rim_is_smooth && (face.in_zone || other.in_zone))) return g;
      if (const double cosine = dot(normal(f, middle), normal(g, middle)); cosine > flattest)
        best = g, flattest = cosine;
    }
    return best;
  }

  [[nodiscard]] std::uint32_t component(FaceId f) const {
    return complex_.component[mesh().sheet(mesh().face(f).sheet).faces.front().value];
  }

  /// Of the surface that was there, where the face is new.
  [[nodiscard]] Vec3 normal(FaceId f, Vec3 at) const {
    if (!mesh().is_new(f)) return unit_normal(mesh().corners(f));
    return editor_.reference().normal(editor_.reference().project(mesh().face(f).sheet, at, {}).face);
  }

  void deform(const std::vector<FaceId>& area) {
    DeformProblem problem;
    std::vector<VertexId> vertices;
    std::map<VertexId, std::uint32_t> node;
    for (const FaceId f : area) {
      auto& corners = problem.faces.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const VertexId v = mesh().face(f).v[k];
        const auto [it, is_new] = node.try_emplace(v, static_cast<std::uint32_t>(vertices.size()));
        corners[k] = it->second;
        if (!is_new) continue;
        vertices.push_back(v);
        problem.position.push_back(mesh().position(v));
        problem.is_free.push_back(is_free(v) ? 1 : 0);
      }
    }
    const Deformed shape = deformed(problem, options_.blend, options_.deform);
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if (problem.is_free[i] != 0) editor_.put(vertices[i], shape.position[i]);
    blended_.moved = std::max(blended_.moved, shape.moved);
    if (shape.left > blended_.left) blended_.left = shape.left, blended_.left_at = shape.left_at;
  }

  Editor& editor_;
  const Complex& complex_;
  const std::vector<std::uint8_t>& filled_;
  const BlendOptions& options_;
  std::vector<int> steps_;  // by face, from the faces that move
  Blended blended_;
};

}  // namespace

Blended blend_filled(Editor& editor, const Complex& complex, const std::vector<std::uint8_t>& filled,
                     const BlendOptions& options) {
  return Blender(editor, complex, filled, options).run();
}

}  // namespace meshgraft
