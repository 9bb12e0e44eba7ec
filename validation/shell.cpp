#include "shell.hpp"

#include <cmath>

namespace meshgraft::validation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d vector(Vec3 a) { return {a.x, a.y, a.z}; }

constexpr std::size_t next(std::size_t k) { return (k + 1) % 3; }
constexpr std::size_t previous(std::size_t k) { return (k + 2) % 3; }

double von_mises(const Vector3d& s) { return std::sqrt(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3 * s[2] * s[2]); }

/// Where the freedoms of the membrane and of the plate are among the six of a node.
constexpr std::array<int, 3> kMembrane{0, 1, 5}, kPlate{2, 3, 4};

int freedom(std::size_t k, const std::array<int, 3>& of_node) { return static_cast<int>(6 * (k / 3)) + of_node[k % 3]; }

}  // namespace

Matrix3d Elasticity::plane_stress() const {
  const double e = young / (1 - poisson * poisson);
  Matrix3d d;
  d << e, poisson * e, 0, poisson * e, e, 0, 0, 0, (1 - poisson) / 2 * e;
  return d;
}

ShellTriangle::ShellTriangle(const Triangle& corners, double thickness, const Elasticity& elasticity)
    : area_(meshgraft::area(corners)), thickness_(thickness), elasticity_(elasticity) {
  const Vector3d along = vector(normalized(corners[1] - corners[0])), normal = vector(unit_normal(corners));
  axes_.row(0) = along;
  axes_.row(1) = normal.cross(along);
  axes_.row(2) = normal;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d p = axes_ * vector(corners[k] - corners[0]);
    x_[k] = p[0], y_[k] = p[1];
  }
}

/// Mean strain over the triangle: the force lumping matrix of the basic stiffness, divided by the area.
ShellTriangle::MembraneStrain ShellTriangle::mean_strain() const {
  constexpr double kDrillingShare = 1.5;  // alpha_b of Felippa 2003, section 3.1
  MembraneStrain strain;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = next(i), k = previous(i);
    const double yjk = y_[j] - y_[k], xkj = x_[k] - x_[j];
    const double xij = x_[i] - x_[j], yij = y_[i] - y_[j], xki = x_[k] - x_[i], yki = y_[k] - y_[i];
    const double d = kDrillingShare / 6;
    strain.col(3 * i) << yjk, 0, xkj;
    strain.col(3 * i + 1) << 0, xkj, yjk;
    strain.col(3 * i + 2) << d * yjk * (yij - yki), d * xkj * (xki - xij), 2 * d * (xij * yij - xki * yki);
  }
  return strain / (2 * area_);
}

/// Basic stiffness plus the higher-order one of the optimal template (Felippa 2003, section 5).
ShellTriangle::Membrane ShellTriangle::membrane() const {
  const Matrix3d e = elasticity_.plane_stress();
  const double nu = elasticity_.poisson;
  const double higher_order_share = (1 - 4 * nu * nu) / 2;  // beta_0, best for bending in the plane

  Eigen::Matrix<double, 3, 9> hierarchical_rotation;  // of the nodes, less that of the triangle as a whole
  Matrix3d to_strain;                                 // from natural strains, along the sides 12, 23, 31
  Vector3d inverse_squares;                           // of the lengths of these sides
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = next(a), c = previous(a);
    const double xcb = x_[c] - x_[b], ybc = y_[b] - y_[c], xca = x_[c] - x_[a], yac = y_[a] - y_[c];
    for (std::size_t row = 0; row < 3; ++row)
      hierarchical_rotation.block<1, 3>(row, 3 * a) << xcb, -ybc, row == a ? 4 * area_ : 0;
    const double l2 = std::pow(x_[b] - x_[a], 2) + std::pow(y_[b] - y_[a], 2);
    to_strain.col(a) << ybc * yac * l2, xcb * xca * l2, (ybc * xca + xcb * yac) * l2;
    inverse_squares[a] = 1 / l2;
  }
  hierarchical_rotation /= 4 * area_;
  to_strain /= 4 * area_ * area_;

  // Natural strains at the corners from the hierarchical rotations: beta_1 to beta_9 of the optimal element.
  Matrix3d q1, q2, q3;
  q1 << 1, 2, 1, 0, 1, -1, -1, -1, -2;
  q2 << -2, -1, -1, 1, 1, 2, -1, 0, 1;
  q3 << 1, -1, 0, -1, -2, -1, 2, 1, 1;
  const Matrix3d scale = 2 * area_ / 3 * Matrix3d(inverse_squares.asDiagonal());
  const Matrix3d natural = to_strain.transpose() * e * to_strain;
  Matrix3d rotational = Matrix3d::Zero();
  for (const Matrix3d& middle : {Matrix3d(q1 + q2), Matrix3d(q2 + q3), Matrix3d(q3 + q1)}) {
    const Matrix3d q = scale * middle / 2;
    rotational += q.transpose() * natural * q;
  }
  const MembraneStrain mean = mean_strain();
  const double volume = area_ * thickness_;
  return volume * (mean.transpose() * e * mean +
                   0.75 * higher_order_share * hierarchical_rotation.transpose() * rotational * hierarchical_rotation);
}

/// At barycentric coordinates `weight`, from the rotations of the normal: quadratic, with Kirchhoff's hypothesis at the
/// corners and at the middles of the sides, and w cubic along the sides.
ShellTriangle::BendingStrain ShellTriangle::curvature(const std::array<double, 3>& weight) const {
  std::array<Vector2d, 3> gradient;  // of the barycentric coordinates
  for (std::size_t i = 0; i < 3; ++i)
    gradient[i] = Vector2d(y_[next(i)] - y_[previous(i)], x_[previous(i)] - x_[next(i)]) / (2 * area_);

  using Rotation = Eigen::Matrix<double, 2, 9>;  // of the normal towards x and y
  BendingStrain strain = BendingStrain::Zero();
  const auto add = [&](const Vector2d& slope, const Rotation& rotation) {
    strain.row(0) += slope[0] * rotation.row(0);
    strain.row(1) += slope[1] * rotation.row(1);
    strain.row(2) += slope[1] * rotation.row(0) + slope[0] * rotation.row(1);
  };
  std::array<Rotation, 3> at_corner;
  for (std::size_t i = 0; i < 3; ++i) {
    at_corner[i].setZero();
    at_corner[i](0, 3 * i + 2) = 1;
    at_corner[i](1, 3 * i + 1) = -1;
    add((4 * weight[i] - 1) * gradient[i], at_corner[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = next(i);
    const Vector2d side(x_[j] - x_[i], y_[j] - y_[i]);
    const double length = side.norm();
    const Vector2d s = side / length;
    Rotation middle = (0.5 * Eigen::Matrix2d::Identity() - 0.75 * s * s.transpose()) * (at_corner[i] + at_corner[j]);
    middle.col(3 * i) += 1.5 / length * s;
    middle.col(3 * j) -= 1.5 / length * s;
    add(4 * (weight[i] * gradient[j] + weight[j] * gradient[i]), middle);
  }
  return strain;
}

Eigen::Matrix<double, 9, 9> ShellTriangle::bending() const {
  const Matrix3d rigidity = std::pow(thickness_, 3) / 12 * elasticity_.plane_stress();
  Eigen::Matrix<double, 9, 9> k = Eigen::Matrix<double, 9, 9>::Zero();
  // The integrand is quadratic; the middles of the sides integrate it exactly.
  for (const std::array<double, 3>& middle : {std::array{0.5, 0.5, 0.0}, {0.0, 0.5, 0.5}, {0.5, 0.0, 0.5}}) {
    const BendingStrain b = curvature(middle);
    k += area_ / 3 * b.transpose() * rigidity * b;
  }
  return k;
}

ShellTriangle::Matrix ShellTriangle::to_local() const {
  Matrix t = Matrix::Zero();
  for (int k = 0; k < 6; ++k) t.block<3, 3>(3 * k, 3 * k) = axes_;
  return t;
}

ShellTriangle::Matrix ShellTriangle::stiffness() const {
  const Membrane in_plane = membrane();
  const Eigen::Matrix<double, 9, 9> across = bending();
  Matrix k = Matrix::Zero();
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t j = 0; j < 9; ++j) {
      k(freedom(i, kMembrane), freedom(j, kMembrane)) = in_plane(i, j);
      k(freedom(i, kPlate), freedom(j, kPlate)) = across(i, j);
    }
  const Matrix t = to_local();
  return t.transpose() * k * t;
}

ShellTriangle::Matrix ShellTriangle::mass(double density) const {
  const double total = density * area_ * thickness_;
  const double consistent_own = total / 6, consistent_other = total / 12, lumped = total / 3;
  const double rotary = lumped * thickness_ * thickness_ / 12;
  Matrix m = Matrix::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      m.block<3, 3>(6 * i, 6 * j).diagonal().setConstant(i == j ? (consistent_own + lumped) / 2 : consistent_other / 2);
    m(6 * i + 3, 6 * i + 3) = m(6 * i + 4, 6 * i + 4) = rotary;
  }
  const Matrix t = to_local();
  return t.transpose() * m * t;
}

double ShellTriangle::von_mises(const Vector& freedoms) const {
  const Vector local = to_local() * freedoms;
  Eigen::Matrix<double, 9, 1> in_plane, across;
  for (std::size_t k = 0; k < 9; ++k) {
    in_plane[k] = local[freedom(k, kMembrane)];
    across[k] = local[freedom(k, kPlate)];
  }
  const Matrix3d d = elasticity_.plane_stress();
  const Vector3d middle = d * (mean_strain() * in_plane);
  const Vector3d bent = thickness_ / 2 * d * (curvature({1.0 / 3, 1.0 / 3, 1.0 / 3}) * across);
  return std::max(validation::von_mises(middle + bent), validation::von_mises(middle - bent));
}

}  // namespace meshgraft::validation
