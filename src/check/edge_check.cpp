#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "check/checks.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

/// One side of one face.
struct Use {
  std::uint32_t low, high, face;
  bool forward;  // the face runs from low to high
};

std::vector<Use> sorted_uses(const Faces& faces) {
  std::vector<Use> uses;
  uses.reserve(3 * faces.corner.size());
  for (std::uint32_t f = 0; f < faces.corner.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = faces.corner[f][k], b = faces.corner[f][(k + 1) % 3];
      if (a != b) uses.push_back({std::min(a, b), std::max(a, b), f, a < b});
    }
  tbb::parallel_sort(uses, [](const Use& a, const Use& b) {
    return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
  });
  return uses;
}

}  // namespace

void check_edges(const Model& model, const Faces& faces, const CheckOptions& options, CheckResult& result) {
  const std::vector<Use> uses = sorted_uses(faces);
  const auto normal = [&](const Use& use) {
    const Vec3 n = area_vector(model.corners(faces.element[use.face]));
    return use.forward ? n : -n;
  };
  double length = 0;
  std::size_t n_edges = 0;
  for (std::size_t i = 0, next = 0; i < uses.size(); i = next) {
    while (next < uses.size() && uses[next].low == uses[i].low && uses[next].high == uses[i].high) ++next;
    ++n_edges;
    length += distance(model.position[uses[i].low], model.position[uses[i].high]);
    if (next - i == 1) ++result.free_edges;
    if (next - i > 2) ++result.non_manifold_edges;
    if (next - i != 2) continue;
    const bool flipped = uses[i].forward == uses[i + 1].forward;
    if (flipped) ++result.flipped_edges;
    // Seen from one side of the surface, the faces at an edge run along it in opposite directions.
    const Vec3 a = normal(uses[i]), b = -normal(uses[i + 1]);
    if (std::atan2(norm(cross(a, b)), dot(a, b)) > options.sharp_angle) ++result.sharp_edges;
  }
  result.mean_edge_length = n_edges > 0 ? length / static_cast<double>(n_edges) : 0;
}

}  // namespace meshgraft
