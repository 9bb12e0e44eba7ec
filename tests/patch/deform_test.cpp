// Deformation of filled areas against surfaces that are known.
#include "patch/deform.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <Eigen/SparseLU>
#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>

#include "geometry/quality.hpp"
#include "patch/power_solver.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

/// A surface over the square [-0.5, 0.5]^2, and the nearest point of it.
struct Shape {
  std::function<Vec3(double u, double v)> at;
  std::function<Vec3(Vec3)> nearest;
};

/// A jittered mesh around the origin of a surface with edges `size`, whose nodes within `width` edges are free and
/// have been pulled into the plane of their neighbourhood's rim.
struct Hole {
  DeformProblem problem;
  Shape shape;
  double size = 0;

  Hole(const Shape& s, double edge, double width) : shape(s), size(edge) {
    constexpr double kAround = 5;  // edges of surroundings
    scenes::Surface grid;
    const double half = (width + kAround) * edge;
    grid.at = [&](double u, double v) { return s.at(half * (2 * u - 1), half * (2 * v - 1)); };
    grid.nu = grid.nv = static_cast<std::size_t>(2 * (width + kAround));
    grid.jitter = 0.2;
    const Model model = scenes::surface(grid);
    problem.position = model.position;
    for (std::size_t f = 0; f < model.n_elements(); ++f) {
      const auto n = model.nodes_of(ElementId(f));
      problem.faces.push_back({n[0].value, n[1].value, n[2].value});
    }
    const Vec3 centre = s.at(0, 0);
    double lowest = 0;
    for (Vec3& p : problem.position) {
      const bool free = distance(p, centre) < width * edge;
      problem.is_free.push_back(free ? 1 : 0);
      if (free) lowest = std::min(lowest, p.z);
    }
    for (std::size_t v = 0; v < problem.position.size(); ++v)
      if (problem.is_free[v] != 0) problem.position[v].z = lowest;
  }
};

struct Errors {
  double distance = 0;  // of nodes from the surface
  double normal = 0;    // radians, of faces from the same faces with their nodes on the surface
};

Errors errors_of(const Hole& hole, Blend blend) {
  const std::vector<Vec3> position = deformed(hole.problem, blend).position;
  Errors worst;
  for (std::size_t v = 0; v < position.size(); ++v)
    if (hole.problem.is_free[v] != 0)
      worst.distance = std::max(worst.distance, distance(position[v], hole.shape.nearest(position[v])));
  for (const auto& f : hole.problem.faces) {
    const Triangle t{position[f[0]], position[f[1]], position[f[2]]};
    const Triangle on{hole.shape.nearest(t[0]), hole.shape.nearest(t[1]), hole.shape.nearest(t[2])};
    worst.normal = std::max(worst.normal, norm(cross(unit_normal(t), unit_normal(on))));
  }
  return worst;
}

Shape sphere() {
  return {[](double u, double v) {
            return Vec3{u, v, std::sqrt(1 - u * u - v * v) - 1};
          },
          [](Vec3 p) {
            return normalized(p + Vec3{0, 0, 1}) - Vec3{0, 0, 1};
          }};
}
Shape cylinder() {
  return {[](double u, double v) {
            return Vec3{std::sin(u), v, std::cos(u) - 1};
          },
          [](Vec3 p) {
            const Vec3 d = normalized({p.x, 0, p.z + 1});
            return Vec3{d.x, p.y, d.z - 1};
          }};
}
Shape torus() {  // around the y axis, radii 2 and 1; outermost at the origin
  return {[](double u, double v) {
            const double r = 2 + std::cos(v);
            return Vec3{r * std::sin(u / 3), std::sin(v), r * std::cos(u / 3) - 3};
          },
          [](Vec3 p) {
            const Vec3 ring = 2 * normalized({p.x, 0, p.z + 3});
            return ring + normalized(p + Vec3{0, 0, 3} - ring) - Vec3{0, 0, 3};
          }};
}
/// z = (x^2 - y^2) / 2 + x^3 / 6: the vertical distance over the slope is the distance up to higher order.
Shape saddle() {
  const auto z = [](double x, double y) { return 0.5 * (x * x - y * y) + x * x * x / 6; };
  return {[z](double u, double v) {
            return Vec3{u, v, z(u, v)};
          },
          [z](Vec3 p) {
            const Vec3 n = normalized({-(p.x + p.x * p.x / 2), p.y, 1});
            return p - dot(Vec3{0, 0, p.z - z(p.x, p.y)}, n) * n;
          }};
}

struct Case {
  const char* name;
  Shape (*shape)();
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

class Deform : public testing::TestWithParam<Case> {};

/// A hole of a fixed number of edges: its width falls with the edge length h. A surface that meets the true one with
/// its derivatives up to order k around the hole is within h^(k + 2) of it, and its normals within h^(k + 1).
TEST_P(Deform, ErrorAndNormalsFallWithTheOrderOfTheContinuity) {
  constexpr double kHalvings = 2, kSlack = 0.6;  // of the order, for three irregular meshes
  const Shape shape = GetParam().shape();
  const std::array<double, 3> sizes{0.08, 0.04, 0.02};
  for (const Blend blend : {Blend::kPosition, Blend::kTangency, Blend::kCurvature}) {
    std::array<Errors, 3> e;
    for (std::size_t k = 0; k < 3; ++k) e[k] = errors_of(Hole(shape, sizes[k], 4), blend);
    const double order = std::log2(e[0].distance / e[2].distance) / kHalvings;
    const double normal_order = std::log2(e[0].normal / e[2].normal) / kHalvings;
    const int k = static_cast<int>(blend);
    SCOPED_TRACE(testing::Message() << "continuity " << k << ": distances " << e[0].distance << " " << e[1].distance
                                    << " " << e[2].distance << ", normals " << e[0].normal << " " << e[1].normal << " "
                                    << e[2].normal);
    EXPECT_GE(order, k + 2 - kSlack);
    EXPECT_GE(normal_order, k + 1 - kSlack);
    if (k == 0) continue;
    EXPECT_LT(e[1].distance, 0.1 * errors_of(Hole(shape, sizes[1], 4), Blend::kPosition).distance);
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Deform,
                         testing::Values(Case{"SphereCap", sphere}, Case{"Cylinder", cylinder}, Case{"Torus", torus},
                                         Case{"Saddle", saddle}),
                         [](const auto& shape) { return shape.param.name; });

TEST(DeformLaws, SurfacesOfThirdDegreeComeBack) {
  // In the tangent frames of a nearly flat surface: then the frames do not turn.
  EXPECT_TRUE(rc::check([] {
    std::array<double, 7> c{};
    for (double& x : c) x = *rc::gen::inRange(-100, 100) * 1e-6;
    const auto z = [c](double x, double y) {
      return c[0] * x * x + c[1] * x * y + c[2] * y * y + c[3] * x * x * x + c[4] * x * x * y + c[5] * x * y * y +
             c[6] * y * y * y;
    };
    const Shape shape{[z](double u, double v) {
                        return Vec3{u, v, z(u, v)};
                      },
                      [z](Vec3 p) {
                        return Vec3{p.x, p.y, z(p.x, p.y)};
                      }};
    const Hole hole(shape, 1, 4);
    double height = 0;
    for (const Vec3 p : hole.problem.position) height = std::max(height, std::abs(p.z));
    for (const Blend blend : {Blend::kTangency, Blend::kCurvature})
      RC_ASSERT(errors_of(hole, blend).distance <= 1e-3 * height + 1e-12);
  }));
}

TEST(DeformLaws, FixedNodesStayAndAFlatAreaStaysFlat) {
  const Shape plane{[](double u, double v) { return Vec3{u, v, 0}; }, [](Vec3 p) { return Vec3{p.x, p.y, 0}; }};
  const Hole hole(plane, 0.1, 3);
  for (const Blend blend : {Blend::kPosition, Blend::kTangency, Blend::kCurvature}) {
    const auto position = deformed(hole.problem, blend).position;
    for (std::size_t v = 0; v < position.size(); ++v) {
      if (hole.problem.is_free[v] == 0) {
        EXPECT_EQ(position[v], hole.problem.position[v]);
      }
      EXPECT_NEAR(distance(position[v], hole.problem.position[v]), 0, 1e-9);
    }
  }
}

TEST(Deform, OnlyNodesOfFacesThatWouldBeSpoiltStayAndThatIsTold) {
  const Hole hole(sphere(), 0.05, 6);
  const Deformed whole = deformed(hole.problem, Blend::kTangency);
  EXPECT_EQ(whole.left, 0);
  EXPECT_GT(whole.moved, 0.5);

  DeformProblem wild = hole.problem;  // its surroundings go up and down, but for one side
  for (std::size_t v = 0; v < wild.position.size(); ++v)
    if (wild.is_free[v] == 0 && wild.position[v].x > 0.2) wild.position[v].z += v % 2 == 0 ? 0.2 : -0.2;
  const Deformed part = deformed(wild, Blend::kTangency);
  EXPECT_GT(part.left, 0);
  EXPECT_GT(part.moved, 0);
  EXPECT_GT(part.left_at.x, 0);
}

/// The hole as a system: rows and right sides of its free nodes for a power of the Laplacian.
struct HoleSystem {
  std::vector<int> unknown;
  Eigen::MatrixX3d start;
  SparseRows rows;
  Eigen::MatrixX3d right;

  HoleSystem(const Hole& hole, int power) {
    const auto& p = hole.problem;
    int n = 0;
    for (const std::uint8_t free : p.is_free) unknown.push_back(free != 0 ? n++ : -1);
    const SparseRows all = SurfaceLaplacian(p.faces, p.position).power(power);
    start.setZero(n, 3), right.setZero(n, 3);
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t v = 0; v < unknown.size(); ++v) {
      if (unknown[v] < 0) continue;
      start.row(unknown[v]) << p.position[v].x, p.position[v].y, p.position[v].z;
      for (SparseRows::InnerIterator it(all, static_cast<Eigen::Index>(v)); it; ++it) {
        const Vec3 q = p.position[static_cast<std::size_t>(it.col())];
        if (const int column = unknown[static_cast<std::size_t>(it.col())]; column >= 0)
          entries.emplace_back(unknown[v], column, it.value());
        else
          right.row(unknown[v]) -= it.value() * Eigen::RowVector3d(q.x, q.y, q.z);
      }
    }
    rows.resize(n, n);
    rows.setFromTriplets(entries.begin(), entries.end());
  }
};

TEST(PowerSolver, SolvesInABoundedNumberOfIterationsHoweverWideTheHole) {
  for (const int power : {1, 2, 3})
    for (const double width : {4.0, 12.0, 36.0}) {
      SCOPED_TRACE(testing::Message() << "power " << power << ", " << width << " edges wide");
      const double edge = 0.25 / width;
      const Hole hole(sphere(), edge, width);
      const HoleSystem s(hole, power);
      const PowerSolver solver(hole.problem.faces, hole.problem.position, s.unknown, power);
      const auto x =
          solver.solution(s.rows, s.right, s.start, {.settled = 1e-9 * edge, .share = 0, .most_iterations = 40});
      ASSERT_TRUE(x);
      const Eigen::MatrixX3d exact = Eigen::SparseLU<Eigen::SparseMatrix<double>>(s.rows).solve(s.right);
      EXPECT_LT((x->x - exact).cwiseAbs().maxCoeff(), 1e-7 * edge);
    }
}

TEST(DeformLaws, TheScaleAndTheFrameDoNotMatter) {
  EXPECT_TRUE(rc::check([] {
    const double scale = std::exp2(*rc::gen::inRange(-20, 20));  // a power of two rounds nothing
    const Hole hole(torus(), 0.05, 3);
    Hole other = hole;
    for (Vec3& p : other.problem.position) p = scale * Vec3{p.y, p.z, p.x};
    const Blend blend = static_cast<Blend>(*rc::gen::inRange(0, 3));
    const auto a = deformed(hole.problem, blend).position, b = deformed(other.problem, blend).position;
    for (std::size_t v = 0; v < a.size(); ++v)
      RC_ASSERT(distance(scale * Vec3{a[v].y, a[v].z, a[v].x}, b[v]) <= 1e-6 * scale);
  }));
}

}  // namespace
}  // namespace meshgraft
