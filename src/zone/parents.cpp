#include "zone/parents.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "geometry/quality.hpp"

namespace meshgraft {

Parents::Parents(const Complex& complex) : of_face(complex.n_faces()) {
  faces.reserve(complex.n_faces());
  for (std::size_t f = 0; f < complex.n_faces(); ++f) faces.emplace_back(f);
  const auto parent = [&](FaceId f) { return complex.parent[f.value]; };
  if (!std::ranges::is_sorted(faces, {}, parent)) std::ranges::stable_sort(faces, {}, parent);
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    if (i == 0 || complex.parent[faces[i].value] != complex.parent[faces[i - 1].value]) first.push_back(i);
    of_face[faces[i].value] = static_cast<std::uint32_t>(first.size() - 1);
  }
  first.push_back(static_cast<std::uint32_t>(faces.size()));
}

std::vector<Vec3> area_vectors(const Parents& parents, const Complex& complex) {
  std::vector<Vec3> sum(parents.size());
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    sum[parents.of_face[f]] += area_vector(complex.corners(FaceId(f)));
  return sum;
}

double edge_length_of_area(double area) { return std::sqrt(4 / std::numbers::sqrt3 * area); }

}  // namespace meshgraft
