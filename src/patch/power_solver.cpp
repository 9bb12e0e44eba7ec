#include "patch/power_solver.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "core/blocks.hpp"

namespace meshgraft {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// A column for each unknown: 1 at its node.
Matrix selection(std::span<const int> unknown) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t v = 0; v < unknown.size(); ++v)
    if (unknown[v] >= 0) entries.emplace_back(static_cast<int>(v), unknown[v], 1.0);
  Matrix matrix(static_cast<Eigen::Index>(unknown.size()), static_cast<Eigen::Index>(entries.size()));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

PowerSolver::PowerSolver(std::span<const std::array<std::uint32_t, 3>> faces, const std::vector<Vec3>& position,
                         std::span<const int> unknown, int n) {
  const SurfaceLaplacian surface(faces, position);
  const Matrix laplacian = surface.cotangents(), selected = selection(unknown);
  const Matrix columns = laplacian * selected;
  const Matrix weighted = surface.inverse_areas().asDiagonal() * columns;
  Matrix power;
  if (n == 1) power = selected.transpose() * columns;
  if (n == 2) power = columns.transpose() * weighted;
  if (n == 3) power = weighted.transpose() * Matrix(laplacian * weighted);
  factor_.compute(power);
}

std::optional<Eigen::MatrixX3d> PowerSolver::solution(const SparseRows& rows, const Eigen::MatrixX3d& right,
                                                      const Eigen::MatrixX3d& start, const Options& options) const {
  if (factor_.info() != Eigen::Success) return std::nullopt;
  std::array<std::optional<Eigen::VectorXd>, 3> columns;
  for_blocks(
      columns.size(),
      [&](std::size_t k, std::size_t) {
        const auto j = static_cast<Eigen::Index>(k);
        columns[k] = column(rows, right.col(j), start.col(j), options);
      },
      1);
  Eigen::MatrixX3d x(start.rows(), 3);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (!columns[k]) return std::nullopt;
    x.col(static_cast<Eigen::Index>(k)) = *columns[k];
  }
  return x;
}

std::optional<Eigen::VectorXd> PowerSolver::column(const SparseRows& rows, const Eigen::VectorXd& right,
                                                   Eigen::VectorXd x, const Options& options) const {
  using Vector = Eigen::VectorXd;
  Vector r = factor_.solve(right - rows * x);  // about the distance from the solution
  const Vector shadow = r;
  const double settled = std::max(options.settled, options.share * r.lpNorm<Eigen::Infinity>());
  Vector direction = r;
  double rho = shadow.dot(r);
  for (int iteration = 0; iteration < options.most_iterations; ++iteration) {
    if (!r.allFinite()) return std::nullopt;
    if (r.lpNorm<Eigen::Infinity>() <= settled) return x;
    const Vector image = factor_.solve(rows * direction);
    const double step = rho / shadow.dot(image);
    const Vector half = r - step * image;
    const Vector second = factor_.solve(rows * half);
    const double squared = second.squaredNorm();
    const double damping = squared > 0 ? second.dot(half) / squared : 0;
    x += step * direction + damping * half;
    r = half - damping * second;
    const double next = shadow.dot(r);
    direction = r + (next / rho * step / damping) * (direction - damping * image);
    rho = next;
  }
  return std::nullopt;
}

}  // namespace meshgraft
