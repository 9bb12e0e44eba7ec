// The shell triangle of the study, and what it gives for plates with known answers.
#include "shell.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>

#include "beam.hpp"
#include "solve.hpp"
#include "support/scenes.hpp"

namespace meshgraft::validation {
namespace {

constexpr Elasticity kSteel{210000, 0.3};

Vec3 any_vector() {
  const auto coordinate = [] { return static_cast<double>(*rc::gen::inRange(-1000, 1000)) / 100; };
  const double x = coordinate(), y = coordinate(), z = coordinate();
  return {x, y, z};
}

/// Anywhere in space, any shape that is not too thin.
Triangle any_triangle() {
  const Triangle t{any_vector(), any_vector(), any_vector()};
  RC_PRE(aspect_ratio(t) > 0.05);
  return t;
}

/// The freedoms of a field of displacements and rotations.
template <class Displacement, class Rotation>
ShellTriangle::Vector freedoms(const Triangle& t, Displacement displacement, Rotation rotation) {
  ShellTriangle::Vector u;
  for (int n = 0; n < 3; ++n) {
    const Vec3 d = displacement(t[n]), r = rotation(t[n]);
    u.segment<6>(6 * n) << d.x, d.y, d.z, r.x, r.y, r.z;
  }
  return u;
}

double energy(const ShellTriangle& shell, const ShellTriangle::Vector& u) { return u.dot(shell.stiffness() * u) / 2; }

RC_GTEST_PROP(ShellTriangle, OnlyRigidMotionsNeedNoForce, ()) {
  const Triangle t = any_triangle();
  const ShellTriangle shell(t, 0.1 * mean_edge_length(t), kSteel);
  const Vec3 push = any_vector(), turn = any_vector();
  const auto rigid = freedoms(
      t, [&](Vec3 p) { return push + cross(turn, p); }, [&](Vec3) { return turn; });
  const ShellTriangle::Matrix k = shell.stiffness();
  RC_ASSERT((k * rigid).norm() <= 1e-10 * k.norm() * rigid.norm());
  const Eigen::SelfAdjointEigenSolver<ShellTriangle::Matrix> modes(k);
  RC_ASSERT(modes.eigenvalues()[5] < 1e-12 * modes.eigenvalues()[17]);
  RC_ASSERT(modes.eigenvalues()[6] > 1e-9 * modes.eigenvalues()[17]);
}

/// In the plane z = 0, with a corner at the origin: large rigid motions would cost digits.
Triangle any_flat_triangle() {
  Triangle t = any_triangle();
  const Vec3 origin = t[0];
  for (Vec3& p : t) p -= origin, p.z = 0;
  RC_PRE(area_vector(t).z > 0 && aspect_ratio(t) > 0.05);
  return t;
}

RC_GTEST_PROP(ShellTriangle, EvenStrainInThePlaneIsExact, ()) {
  const Triangle t = any_flat_triangle();
  const double thickness = 0.3;
  const ShellTriangle shell(t, thickness, kSteel);
  const Vec3 a = any_vector(), b = any_vector();
  const auto u = freedoms(
      t,
      [&](Vec3 p) {
        return Vec3{a.x * p.x + a.y * p.y, b.x * p.x + b.y * p.y, 0};
      },
      [&](Vec3) {
        return Vec3{0, 0, (b.x - a.y) / 2};
      });
  const Eigen::Vector3d strain(a.x, b.y, a.y + b.x);
  const Eigen::Vector3d stress = kSteel.plane_stress() * strain;
  const double expected = strain.dot(stress) / 2 * area(t) * thickness;
  RC_ASSERT(std::abs(energy(shell, u) - expected) <= 1e-9 * expected);
  const double mises =
      std::sqrt(stress[0] * stress[0] - stress[0] * stress[1] + stress[1] * stress[1] + 3 * stress[2] * stress[2]);
  RC_ASSERT(std::abs(shell.von_mises(u) - mises) <= 1e-9 * mises);
}

RC_GTEST_PROP(ShellTriangle, EvenCurvatureIsExact, ()) {
  const Triangle t = any_flat_triangle();
  const double thickness = 0.3;
  const ShellTriangle shell(t, thickness, kSteel);
  const Vec3 c = any_vector();  // w = c.x x^2 / 2 + c.y y^2 / 2 + c.z x y
  const auto u = freedoms(
      t,
      [&](Vec3 p) {
        return Vec3{0, 0, c.x * p.x * p.x / 2 + c.y * p.y * p.y / 2 + c.z * p.x * p.y};
      },
      [&](Vec3 p) {
        return Vec3{c.y * p.y + c.z * p.x, -(c.x * p.x + c.z * p.y), 0};
      });
  const Eigen::Vector3d curvature(-c.x, -c.y, -2 * c.z);
  const double expected = curvature.dot(kSteel.plane_stress() * curvature) / 2 * std::pow(thickness, 3) / 12 * area(t);
  RC_ASSERT(std::abs(energy(shell, u) - expected) <= 1e-9 * expected);
}

RC_GTEST_PROP(ShellTriangle, MassIsThatOfThePlate, ()) {
  const Triangle t = any_triangle();
  const ShellTriangle shell(t, 0.2, kSteel);
  const auto push = freedoms(
      t,
      [](Vec3) {
        return Vec3{0, 1, 0};
      },
      [](Vec3) { return Vec3{}; });
  RC_ASSERT(std::abs(push.dot(shell.mass(7.85) * push) - 7.85 * 0.2 * area(t)) <= 1e-10 * area(t));
}

TEST(SquareBeam, BendsLikeACantilever) {
  const Vec3 a{1, 2, 3}, b{1, 2, 8};
  const double width = 0.4, length = 5, force = 7;
  const Eigen::Matrix<double, 6, 6> k = square_beam_stiffness(a, b, width, kSteel).bottomRightCorner<6, 6>();
  Eigen::Matrix<double, 6, 1> load = Eigen::Matrix<double, 6, 1>::Zero();
  load[1] = force;
  const Eigen::Matrix<double, 6, 1> u = k.ldlt().solve(load);
  const double rigidity = kSteel.young * std::pow(width, 4) / 12;
  EXPECT_NEAR(u[1], force * std::pow(length, 3) / (3 * rigidity), 1e-9);
  EXPECT_NEAR(u[3], -force * length * length / (2 * rigidity), 1e-9);  // turns around -x
}

/// A square plate of side 1000 and thickness 5, held along its border.
struct ClampedPlate {
  static constexpr double kSide = 1000, kThickness = 5;
  Study study;
  Structure structure;

  explicit ClampedPlate(double size) {
    study.young = kSteel.young, study.poisson = kSteel.poisson, study.density = 7.85e-9;
    study.pressure = 0.001;
    study.n_modes = 3;
    const Model model = scenes::staggered_plate({0, 0, 0}, {kSide, 0, 0}, {0, kSide, 0}, size, "PLATE", 0.15);
    structure.position = model.position;
    for (std::size_t e = 0; e < model.n_elements(); ++e) {
      const auto v = model.nodes_of(ElementId(e));
      structure.faces.push_back({v[0].value, v[1].value, v[2].value});
    }
    structure.thickness.assign(structure.faces.size(), kThickness);
    structure.pressed.assign(structure.faces.size(), true);
    for (std::uint32_t n = 0; n < model.n_nodes(); ++n) {
      const Vec3 p = model.position[n];
      if (std::min({p.x, p.y, kSide - p.x, kSide - p.y}) < 1e-9) structure.clamped.push_back(n);
    }
  }
  [[nodiscard]] double rigidity() const {
    return study.young * std::pow(kThickness, 3) / 12 / (1 - study.poisson * study.poisson);
  }
};

TEST(Solve, AClampedPlateHasTheFrequenciesOfTheTables) {
  const ClampedPlate plate(50);
  const auto response = solve(plate.structure, plate.study);
  ASSERT_TRUE(response);
  // Leissa 1969: 35.99, and 73.41 twice.
  const double unit = std::sqrt(plate.rigidity() / (plate.study.density * plate.kThickness)) /
                      (2 * std::numbers::pi * plate.kSide * plate.kSide);
  ASSERT_EQ(response->frequency.size(), 3U);
  EXPECT_NEAR(response->frequency[0] / unit, 35.99, 0.01 * 35.99);
  EXPECT_NEAR(response->frequency[1] / unit, 73.41, 0.01 * 73.41);
  EXPECT_NEAR(response->frequency[2] / unit, 73.41, 0.01 * 73.41);
}

TEST(Solve, AClampedPlateSagsAsInTheTables) {
  const ClampedPlate plate(50);
  const auto response = solve(plate.structure, plate.study);
  ASSERT_TRUE(response);
  double sag = 0;
  for (const Vec3 u : response->displacement) sag = std::max(sag, u.z);
  // Timoshenko and Woinowsky-Krieger 1959, table 35.
  const double expected = 0.00126 * plate.study.pressure * std::pow(plate.kSide, 4) / plate.rigidity();
  EXPECT_NEAR(sag, expected, 0.02 * expected);
}

TEST(Solve, SaysThatAPlateFloats) {
  ClampedPlate plate(250);
  plate.structure.clamped.clear();
  const auto response = solve(plate.structure, plate.study);
  EXPECT_FALSE(response);
}

}  // namespace
}  // namespace meshgraft::validation
