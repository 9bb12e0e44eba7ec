#include "fill/folds.hpp"

#include <map>

#include "geometry/quality.hpp"

namespace meshgraft {

std::vector<Vec3> folds(const Complex& complex, std::size_t first) {
  std::vector<Vec3> places;
  std::map<std::array<VertexId, 2>, FaceId> one_side;
  for (std::size_t f = first; f < complex.n_faces(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(complex.face[f][k], complex.face[f][(k + 1) % 3]);
      const auto [it, is_first] = one_side.try_emplace({a, b}, FaceId(f));
      if (!is_first && dot(area_vector(complex.corners(it->second)), area_vector(complex.corners(FaceId(f)))) < 0)
        places.push_back(midpoint(complex.position[a.value], complex.position[b.value]));
    }
  return places;
}

}  // namespace meshgraft
