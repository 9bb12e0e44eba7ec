// A straight beam between two nodes.
#pragma once

#include "shell.hpp"

namespace meshgraft::validation {

/// Of square section, after Euler and Bernoulli. Freedoms of each node: three translations, three rotations, in the
/// global system.
[[nodiscard]] Eigen::Matrix<double, 12, 12> square_beam_stiffness(Vec3 a, Vec3 b, double width,
                                                                  const Elasticity& elasticity);
/// Lumped.
[[nodiscard]] Eigen::Matrix<double, 12, 12> square_beam_mass(Vec3 a, Vec3 b, double width, double density);

}  // namespace meshgraft::validation
