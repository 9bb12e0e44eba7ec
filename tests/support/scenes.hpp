// Models made by formula, for tests and benchmarks.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "meshgraft/model.hpp"

namespace meshgraft::scenes {

struct Surface {
  std::function<Vec3(double u, double v)> at;  // u, v in [0, 1]
  std::size_t nu = 10, nv = 10;                // cells
  bool closed_u = false, closed_v = false;     // u = 0 and u = 1 are the same line
  double jitter = 0;                           // share of a cell by which inner nodes move, < 0.4
  std::uint32_t seed = 1;                      // of the jitter
  std::string group = "SURFACE";               // of all faces
};

/// Triangulated grid; the diagonals alternate, so that no direction is preferred.
[[nodiscard]] Model surface(const Surface& s);

/// Parallelogram with corner `origin` and sides `u`, `v`, edges about `size`.
[[nodiscard]] Model plate(Vec3 origin, Vec3 u, Vec3 v, double size, const std::string& group = "PLATE",
                          double jitter = 0);

/// The same of nearly equilateral triangles, in rows along u, as a mesher would leave it.
[[nodiscard]] Model staggered_plate(Vec3 origin, Vec3 u, Vec3 v, double size, const std::string& group = "PLATE",
                                    double jitter = 0);

/// Right triangle with its right angle at `corner` and the legs `u` and `v`, in `n` rows.
[[nodiscard]] Model triangle_plate(Vec3 corner, Vec3 u, Vec3 v, std::size_t n, const std::string& group = "GUSSET");

/// Open cylinder around the axis from `from` to `to`.
[[nodiscard]] Model cylinder(Vec3 from, Vec3 to, double radius, double size, const std::string& group = "CYLINDER");

/// Geodesic sphere: an icosahedron, each edge cut in `n`.
[[nodiscard]] Model sphere(Vec3 centre, double radius, std::size_t n, const std::string& group = "SPHERE");

/// The same model with every node at `to(position)`.
[[nodiscard]] Model moved(Model model, const std::function<Vec3(Vec3)>& to);

/// Several models in one, nothing joined.
[[nodiscard]] Model together(std::span<const Model> models);

/// The same model with nodes of equal coordinates made one.
[[nodiscard]] Model welded(const Model& model);

/// The nodes and triangles of a model with the same ids, without groups and properties, to be added to.
[[nodiscard]] ModelBuilder faces_of(const Model& model);

/// The triangles whose centroids do not go, with their attributes, and the nodes that they have, with labels and
/// groups.
[[nodiscard]] Model without_faces(const Model& model, const std::function<bool(Vec3 centroid)>& goes);

}  // namespace meshgraft::scenes
