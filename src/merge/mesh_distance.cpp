#include "merge/mesh_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"

namespace meshgraft {
namespace {

std::vector<Vec3> corners_of(const Model& model, std::span<const ElementId> faces) {
  std::vector<Vec3> points;
  for (const ElementId f : faces)
    for (const Vec3& p : model.corners(f)) points.push_back(p);
  return points;
}

}  // namespace

std::vector<ElementId> faces_of(const Model& model, const std::function<bool(ElementId)>& wanted) {
  std::vector<ElementId> faces;
  for (std::size_t e = 0; e < model.n_elements(); ++e)
    if (model.is_face(ElementId(e)) && (!wanted || wanted(ElementId(e)))) faces.emplace_back(e);
  return faces;
}

double distance_to_faces(std::span<const Vec3> points, const Model& model, std::span<const ElementId> faces) {
  std::vector<Box> boxes(faces.size());
  for (std::size_t k = 0; k < faces.size(); ++k)
    for (const Vec3& p : model.corners(faces[k])) boxes[k].add(p);
  const BoxTree tree(boxes);
  double least = std::numeric_limits<double>::infinity();  // squared
  for (const Vec3& p : points) {
    const auto squared_distance = [&](std::uint32_t f) {
      return squared_norm(p - closest_on_triangle(p, model.corners(faces[f])).point);
    };
    least = std::min(least, tree.nearest(p, squared_distance, least).squared_distance);
  }
  return std::sqrt(least);
}

double distance_between(const Model& a, const Model& b) {
  const std::vector<ElementId> of_a = faces_of(a), of_b = faces_of(b);
  return std::min(distance_to_faces(corners_of(a, of_a), b, of_b), distance_to_faces(corners_of(b, of_b), a, of_a));
}

}  // namespace meshgraft
