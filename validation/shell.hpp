// A flat shell triangle with three translations and three rotations at each node.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "geometry/quality.hpp"

namespace meshgraft::validation {

struct Elasticity {
  double young = 0, poisson = 0;
  /// Stress from strain in a plate under plane stress; shear strain is the engineering one.
  [[nodiscard]] Eigen::Matrix3d plane_stress() const;
};

/// Bending by the discrete Kirchhoff triangle (Batoz, Bathe and Ho 1980), membrane by the optimal triangle with
/// drilling freedoms (Felippa 2003). Where plates meet at an angle the drilling freedom of one is the bending rotation
/// of the other, so that junctions need no special treatment.
///
/// Freedoms, node by node in the global system: u, v, w, and the rotations around x, y, z.
class ShellTriangle {
 public:
  using Matrix = Eigen::Matrix<double, 18, 18>;
  using Vector = Eigen::Matrix<double, 18, 1>;

  /// REQUIRES: an area and a thickness above zero.
  ShellTriangle(const Triangle& corners, double thickness, const Elasticity& elasticity);

  [[nodiscard]] Matrix stiffness() const;
  /// Half way between consistent and lumped, whose leading errors in a frequency are opposite; rotations carry the
  /// inertia of the plate. `density` in mass per volume.
  [[nodiscard]] Matrix mass(double density) const;
  /// The larger von Mises stress of the two surfaces above the centroid.
  [[nodiscard]] double von_mises(const Vector& freedoms) const;

 private:
  using Membrane = Eigen::Matrix<double, 9, 9>;  // u, v, rotation around the normal; node by node
  using MembraneStrain = Eigen::Matrix<double, 3, 9>;
  using BendingStrain = Eigen::Matrix<double, 3, 9>;  // of w, rotations around x, y; node by node

  [[nodiscard]] MembraneStrain mean_strain() const;
  [[nodiscard]] Membrane membrane() const;
  [[nodiscard]] BendingStrain curvature(const std::array<double, 3>& weight) const;
  [[nodiscard]] Eigen::Matrix<double, 9, 9> bending() const;
  [[nodiscard]] Matrix to_local() const;

  Eigen::Matrix3d axes_;             // rows: local x, y, normal
  std::array<double, 3> x_{}, y_{};  // corners in local axes
  double area_, thickness_;
  Elasticity elasticity_;
};

}  // namespace meshgraft::validation
