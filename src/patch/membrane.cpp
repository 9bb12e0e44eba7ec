#include "patch/membrane.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseLU>
#include <algorithm>

namespace meshgraft {
namespace {

constexpr double kMostTangent = 1e4;  // of half an angle: that of a flat face is infinite

}  // namespace

std::vector<Vec3> on_membrane(std::span<const std::array<std::uint32_t, 3>> faces, std::vector<Vec3> position,
                              std::span<const std::uint8_t> is_free) {
  std::vector<int> unknown(position.size(), -1);
  int n = 0;
  for (std::size_t v = 0; v < position.size(); ++v)
    if (is_free[v] != 0) unknown[v] = n++;
  if (n == 0) return position;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(n, 3);
  const auto weigh = [&](std::uint32_t v, std::uint32_t u, double weight) {
    entries.emplace_back(unknown[v], unknown[v], weight);
    if (unknown[u] >= 0)
      entries.emplace_back(unknown[v], unknown[u], -weight);
    else
      right.row(unknown[v]) += weight * Eigen::RowVector3d(position[u].x, position[u].y, position[u].z);
  };
  for (const auto& f : faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = f[k], a = f[(k + 1) % 3], b = f[(k + 2) % 3];
      if (unknown[v] < 0) continue;
      const Vec3 to_a = position[a] - position[v], to_b = position[b] - position[v];
      const double lengths = norm(to_a) * norm(to_b), opposite = norm(cross(to_a, to_b));
      const double adjacent = std::max(lengths + dot(to_a, to_b), opposite / kMostTangent);
      const double tangent = adjacent > 0 ? opposite / adjacent : 0;  // of half the angle
      if (!(tangent > 0)) continue;
      weigh(v, a, tangent / norm(to_a));
      weigh(v, b, tangent / norm(to_b));
    }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success) return position;
  const Eigen::MatrixX3d x = solver.solve(right);
  if (!x.allFinite()) return position;
  for (std::size_t v = 0; v < position.size(); ++v)
    if (unknown[v] >= 0) position[v] = {x(unknown[v], 0), x(unknown[v], 1), x(unknown[v], 2)};
  return position;
}

}  // namespace meshgraft
