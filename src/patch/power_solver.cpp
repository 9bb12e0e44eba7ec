#include "patch/power_solver.hpp"

#include <Eigen/Dense>
#include <algorithm>

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

/// One of the right sides, on its way.
struct PowerSolver::Column {
  using Vector = Eigen::VectorXd;
  Vector x, r, shadow, direction, image, half;
  double settled = 0, rho = 0, step = 0;
  bool is_open = true;

  Column(Vector start, Vector residual, const Options& options)
      : x(std::move(start)), r(std::move(residual)), shadow(r), direction(r) {
    settled = std::max(options.settled, options.share * r.lpNorm<Eigen::Infinity>());
    rho = shadow.dot(r);
  }
  void go_half(Vector new_image) {
    image = std::move(new_image);
    step = rho / shadow.dot(image);
    half = r - step * image;
  }
  void go_on(const Vector& second) {
    const double squared = second.squaredNorm();
    const double damping = squared > 0 ? second.dot(half) / squared : 0;
    x += step * direction + damping * half;
    r = half - damping * second;
    const double next = shadow.dot(r);
    direction = r + (next / rho * step / damping) * (direction - damping * image);
    rho = next;
  }
};

std::optional<PowerSolver::Solution> PowerSolver::solution(const SparseRows& rows, const Eigen::MatrixX3d& right,
                                                           const Eigen::MatrixX3d& start,
                                                           const Options& options) const {
  if (factor_.info() != Eigen::Success) return std::nullopt;
  std::array<Eigen::VectorXd, 3> work;
  for (std::size_t k = 0; k < 3; ++k) work[k] = right.col(k) - rows * start.col(k);
  precondition(work);  // about the distance from the solution
  std::vector<Column> columns;
  for (Eigen::Index k = 0; k < 3; ++k) columns.emplace_back(start.col(k), work[k], options);
  for (int iteration = 0; iteration < options.most_iterations; ++iteration) {
    for (Column& c : columns) {
      if (!c.r.allFinite()) return std::nullopt;
      c.is_open = c.is_open && c.r.lpNorm<Eigen::Infinity>() > c.settled;
    }
    if (std::ranges::none_of(columns, &Column::is_open)) {
      Solution solution{Eigen::MatrixX3d(start.rows(), 3), iteration};
      for (Eigen::Index k = 0; k < 3; ++k) solution.x.col(k) = columns[k].x;
      return solution;
    }
    for (std::size_t k = 0; k < 3; ++k)
      if (columns[k].is_open) work[k] = rows * columns[k].direction;
    precondition(work);
    for (std::size_t k = 0; k < 3; ++k)
      if (columns[k].is_open) columns[k].go_half(work[k]), work[k] = rows * columns[k].half;
    precondition(work);
    for (std::size_t k = 0; k < 3; ++k)
      if (columns[k].is_open) columns[k].go_on(work[k]);
  }
  return std::nullopt;
}

/// In one pass over the factor for all three: reading it is what takes the time.
void PowerSolver::precondition(std::array<Eigen::VectorXd, 3>& columns) const {
  const Matrix& lower = factor_.matrixL().nestedExpression();  // without its diagonal of ones
  const auto& place = factor_.permutationP().indices();
  const Eigen::Index n = lower.cols();
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> x(n, 3);
  for (Eigen::Index i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k) x(place[i], static_cast<Eigen::Index>(k)) = columns[k][i];
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::RowVector3d from = x.row(j);
    for (Matrix::InnerIterator it(lower, j); it; ++it) x.row(it.row()) -= it.value() * from;
  }
  x = factor_.vectorD().cwiseInverse().asDiagonal() * x;
  for (Eigen::Index j = n - 1; j >= 0; --j) {
    Eigen::RowVector3d to = x.row(j);
    for (Matrix::InnerIterator it(lower, j); it; ++it) to -= it.value() * x.row(it.row());
    x.row(j) = to;
  }
  for (Eigen::Index i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k) columns[k][i] = x(place[i], static_cast<Eigen::Index>(k));
}

}  // namespace meshgraft
