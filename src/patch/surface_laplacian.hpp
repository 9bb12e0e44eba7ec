// The Laplacian of a function on a triangulated surface and its powers, as matrices.
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshgraft/vec3.hpp"

namespace meshgraft {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// All matrices have a row and a column for each node.
class SurfaceLaplacian {
 public:
  /// Both are kept by reference.
  SurfaceLaplacian(std::span<const std::array<std::uint32_t, 3>> faces, const std::vector<Vec3>& position);

  /// Cotangent weights: the Laplacian integrated over the cell of the node. Symmetric.
  [[nodiscard]] SparseRows cotangents() const;
  /// One over the area of the cell of each node.
  [[nodiscard]] Eigen::VectorXd inverse_areas() const;
  /// 1: the cotangent Laplacian. 2, 3: the same applied once or twice to the Laplacian of the cubic fit at the nodes
  /// around. Next to an open border, where the cells of nodes are cut off, 2 stands for 3.
  [[nodiscard]] SparseRows power(int n) const;

 private:
  /// The node and the weight of the value there.
  using Weights = std::vector<std::pair<std::size_t, double>>;

  [[nodiscard]] bool is_on_border(std::size_t node) const { return neighbours_[node].size() != faces_at_[node].size(); }
  [[nodiscard]] SparseRows fits() const;
  /// Of the polynomial through two rings of nodes in the tangent plane, by least squares; of second degree, or
  /// the mean of the neighbours, where there are too few nodes.
  [[nodiscard]] Weights fit(std::size_t node) const;
  [[nodiscard]] std::vector<std::size_t> two_rings(std::size_t node) const;

  std::span<const std::array<std::uint32_t, 3>> faces_;
  const std::vector<Vec3>& position_;
  std::vector<std::vector<std::uint32_t>> faces_at_;  // by node
  std::vector<std::vector<std::size_t>> neighbours_;  // by node, ascending
};

}  // namespace meshgraft
