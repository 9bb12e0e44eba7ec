// The Laplacian of a function on a triangulated surface, as weights of its values at nodes.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "meshgraft/vec3.hpp"

namespace meshgraft {

/// Weight of the value at each node; the weights of a derivative sum to 0.
using NodeWeights = std::map<std::size_t, double>;

/// Inner rows are made when asked for, and kept.
class SurfaceLaplacian {
 public:
  /// Both are kept by reference.
  SurfaceLaplacian(std::span<const std::array<std::uint32_t, 3>> faces, const std::vector<Vec3>& position);

  /// 1: the cotangent Laplacian, integrated over the cell of the node. 2, 3: the same applied once or twice to the
  /// Laplacian of the cubic fit at the nodes around. Next to an open border, where the cells of nodes are cut off, 2
  /// stands for 3.
  [[nodiscard]] NodeWeights power(std::size_t node, int n);

 private:
  [[nodiscard]] bool is_on_border(std::size_t node) const { return neighbours_[node].size() != faces_at_[node].size(); }
  [[nodiscard]] NodeWeights cotangents(std::size_t node) const;
  /// Of the polynomial through two rings of nodes in the tangent plane, by least squares; of second degree, or
  /// the mean of the neighbours, where there are too few nodes.
  [[nodiscard]] NodeWeights of_fit(std::size_t node) const;
  [[nodiscard]] std::vector<std::size_t> two_rings(std::size_t node) const;
  /// Weights per unit of area of the n-th power with the inner operator of the fit.
  const NodeWeights& density(std::size_t node, int n);

  std::span<const std::array<std::uint32_t, 3>> faces_;
  const std::vector<Vec3>& position_;
  std::vector<std::vector<std::uint32_t>> faces_at_;           // by node
  std::vector<std::vector<std::size_t>> neighbours_;           // by node, ascending
  std::array<std::map<std::size_t, NodeWeights>, 2> density_;  // of power 1 and 2
};

}  // namespace meshgraft
