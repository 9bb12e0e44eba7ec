// The scenes of the benchmarks: a plate and a stiffener that passes through it.
#pragma once

#include <cstddef>

#include "meshgraft/model.hpp"

namespace meshgraft::bench {

struct Scene {
  Model base, part;
  double size = 0;  // edge length of both
};

/// A plate of about `n_faces` faces; the stiffener has the same edge length and is as long in every
/// scene, so that the zone grows with the square root of the model.
[[nodiscard]] Scene growing_zone(std::size_t n_faces);

/// A plate of about `n_faces` faces; edge length and stiffener, hence the zone, are the same in every scene.
[[nodiscard]] Scene constant_zone(std::size_t n_faces);

}  // namespace meshgraft::bench
