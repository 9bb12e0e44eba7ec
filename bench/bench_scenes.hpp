// The scenes of the benchmarks: a plate and stiffeners that pass through it.
#pragma once

#include <cstddef>
#include <vector>

#include "meshgraft/model.hpp"

namespace meshgraft::bench {

struct Scene {
  Model base;
  std::vector<Model> parts;
  double size = 0;  // edge length of all
};

/// A plate of about `n_faces` faces; the stiffener has the same edge length and is as long in every
/// scene, so that the zone grows with the square root of the model.
[[nodiscard]] Scene growing_zone(std::size_t n_faces);

/// A plate of about `n_faces` faces; edge length and stiffener, hence the zone, are the same in every scene.
[[nodiscard]] Scene constant_zone(std::size_t n_faces);

/// The same with a stiffener of 250 edges, at which CGAL remeshes some 7,600 faces; `n_faces` of 200,000 at least.
[[nodiscard]] Scene long_zone(std::size_t n_faces);

/// A plate of about `n_faces` faces and `n` stiffeners in each of two directions; each crosses all of the other
/// direction. They are 12 edges high whatever the size of the plate.
[[nodiscard]] Scene grid(std::size_t n_faces, int n);

}  // namespace meshgraft::bench
