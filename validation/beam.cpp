#include "beam.hpp"

#include <array>
#include <cmath>

namespace meshgraft::validation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Share of width^4 that is the torsion constant of a square section.
constexpr double kSquareTorsion = 0.1406;

Matrix3d beam_axes(Vec3 a, Vec3 b) {
  const Vec3 direction = normalized(b - a);
  const Vector3d along(direction.x, direction.y, direction.z);
  Vector3d::Index least = 0;
  along.cwiseAbs().minCoeff(&least);
  Matrix3d axes;
  axes.row(0) = along;
  axes.row(1) = along.cross(Vector3d::Unit(least)).normalized();
  axes.row(2) = along.cross(axes.row(1).transpose());
  return axes;
}

}  // namespace

Eigen::Matrix<double, 12, 12> square_beam_stiffness(Vec3 a, Vec3 b, double width, const Elasticity& elasticity) {
  const double l = distance(a, b), ei = elasticity.young * std::pow(width, 4) / 12;
  const double gj = elasticity.young / (2 * (1 + elasticity.poisson)) * kSquareTorsion * std::pow(width, 4);
  Eigen::Matrix<double, 12, 12> k = Eigen::Matrix<double, 12, 12>::Zero();
  const auto spring = [&](int i, double stiffness) {
    k(i, i) += stiffness, k(i + 6, i + 6) += stiffness, k(i, i + 6) -= stiffness, k(i + 6, i) -= stiffness;
  };
  spring(0, elasticity.young * width * width / l);
  spring(3, gj / l);
  // Bending: of the deflection and the rotation that goes with its slope, by the sign of the latter.
  const auto bend = [&](int deflection, int rotation, double sign) {
    const std::array<int, 4> at{deflection, rotation, deflection + 6, rotation + 6};
    Eigen::Matrix4d m;
    m << 12, 6 * l, -12, 6 * l, 6 * l, 4 * l * l, -6 * l, 2 * l * l, -12, -6 * l, 12, -6 * l, 6 * l, 2 * l * l, -6 * l,
        4 * l * l;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) k(at[i], at[j]) += ei / (l * l * l) * m(i, j) * ((i + j) % 2 ? sign : 1);
  };
  bend(1, 5, 1);
  bend(2, 4, -1);
  Eigen::Matrix<double, 12, 12> t = Eigen::Matrix<double, 12, 12>::Zero();
  for (int n = 0; n < 4; ++n) t.block<3, 3>(3 * n, 3 * n) = beam_axes(a, b);
  return t.transpose() * k * t;
}

Eigen::Matrix<double, 12, 12> square_beam_mass(Vec3 a, Vec3 b, double width, double density) {
  Eigen::Matrix<double, 12, 12> m = Eigen::Matrix<double, 12, 12>::Zero();
  for (const int n : {0, 6}) m.diagonal().segment<3>(n).setConstant(density * width * width * distance(a, b) / 2);
  return m;
}

}  // namespace meshgraft::validation
