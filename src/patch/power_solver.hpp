// Linear systems of powers of the Laplacian on a piece of surface.
#pragma once

#include <Eigen/SparseCholesky>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "patch/surface_laplacian.hpp"

namespace meshgraft {

/// Solves systems of the rows of SurfaceLaplacian::power, which are not symmetric, by iteration (BiCGSTAB, van der
/// Vorst 1992). Its preconditioner is the n-th power of the cotangent Laplacian L with lumped areas M, L (M^-1
/// L)^(n-1): symmetric, of the same order and with the same conditions at the rim, so that the number of iterations
/// does not grow with the mesh. That operator is factored once, and serves as long as the nodes have not moved far.
class PowerSolver {
 public:
  struct Options {
    double settled = 0;        // a length: a solution is taken that is about as near as this,
    double share = 1e-4;       // or as this share of the distance of the start
    int most_iterations = 40;  // a dozen is usual
  };

  /// Factors the operator at these positions.
  ///
  ///   unknown   by node: its row, or negative where the value is given
  PowerSolver(std::span<const std::array<std::uint32_t, 3>> faces, const std::vector<Vec3>& position,
              std::span<const int> unknown, int n);

  struct Solution {
    Eigen::MatrixX3d x;
    int iterations = 0;  // the most of the columns
  };

  /// Nothing if the operator has no factor or the iteration does not settle.
  [[nodiscard]] std::optional<Solution> solution(const SparseRows& rows, const Eigen::MatrixX3d& right,
                                                 const Eigen::MatrixX3d& start, const Options& options) const;

 private:
  struct Column;
  void precondition(std::array<Eigen::VectorXd, 3>& columns) const;

  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace meshgraft
