#include "patch/deform.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/quality.hpp"
#include "patch/surface_laplacian.hpp"

namespace meshgraft {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Powers of the Laplacian for each continuity.
int power(Blend blend) { return blend == Blend::kPosition ? 1 : blend == Blend::kTangency ? 2 : 3; }

class Deformer {
 public:
  Deformer(const DeformProblem& problem, Blend blend, const DeformOptions& options)
      : problem_(problem), blend_(blend), options_(options), position_(problem.position) {
    unknown_.assign(position_.size(), kFixed);
    for (std::size_t v = 0; v < position_.size(); ++v)
      if (problem.is_free[v] != 0) unknown_[v] = static_cast<int>(free_.size()), free_.push_back(v);
  }

  std::vector<Vec3> run() {
    if (free_.empty()) return position_;
    for (int round = 0; round < options_.most_rounds; ++round) {
      const auto wanted = solution();
      if (!wanted) break;
      const double length = mean_length(), moved = move(*wanted);
      if (moved <= options_.settled * length) break;
    }
    return position_;
  }

 private:
  static constexpr int kFixed = -1;
  static constexpr int kMostHalvings = 4;

  /// Row of the operator at a free node.
  std::optional<std::vector<Vec3>> solution() const {
    SurfaceLaplacian laplacian(problem_.faces, position_);
    std::vector<Eigen::Triplet<double>> entries;
    const auto n = static_cast<Eigen::Index>(free_.size());
    Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(n, 3);
    for (Eigen::Index k = 0; k < n; ++k)
      for (const auto& [node, weight] : laplacian.power(free_[static_cast<std::size_t>(k)], power(blend_))) {
        const Vec3 p = position_[node];
        if (unknown_[node] != kFixed)
          entries.emplace_back(static_cast<int>(k), unknown_[node], weight);
        else
          right.row(k) -= weight * Eigen::RowVector3d(p.x, p.y, p.z);
      }
    Matrix matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseLU<Matrix> solver(matrix);
    if (solver.info() != Eigen::Success) return std::nullopt;
    const Eigen::MatrixX3d x = solver.solve(right);
    if (solver.info() != Eigen::Success || !x.allFinite()) return std::nullopt;
    std::vector<Vec3> wanted;
    for (Eigen::Index k = 0; k < n; ++k) wanted.push_back({x(k, 0), x(k, 1), x(k, 2)});
    return wanted;
  }

  [[nodiscard]] double mean_length() const {
    double sum = 0;
    for (const auto& f : problem_.faces) sum += mean_edge_length(corners(f));
    return sum / static_cast<double>(problem_.faces.size());
  }

  [[nodiscard]] Triangle corners(const std::array<std::uint32_t, 3>& f) const {
    return {position_[f[0]], position_[f[1]], position_[f[2]]};
  }

  /// Moves the free nodes there, or part of the way; the largest move.
  double move(const std::vector<Vec3>& wanted) {
    const std::vector<Vec3> before = position_;
    double share = 1;
    for (int halvings = 0; halvings <= kMostHalvings; ++halvings, share *= 0.5) {
      double largest = 0;
      for (std::size_t k = 0; k < free_.size(); ++k) {
        position_[free_[k]] = lerp(before[free_[k]], wanted[k], share);
        largest = std::max(largest, distance(position_[free_[k]], before[free_[k]]));
      }
      if (is_sound(before)) return largest;
    }
    position_ = before;
    return 0;
  }

  /// No face is turned over or made flat.
  [[nodiscard]] bool is_sound(const std::vector<Vec3>& before) const {
    return std::ranges::all_of(problem_.faces, [&](const std::array<std::uint32_t, 3>& f) {
      const Triangle old{before[f[0]], before[f[1]], before[f[2]]};
      const double least = std::min(options_.least_quality, aspect_ratio(old));
      return signed_aspect_ratio(corners(f), area_vector(old)) >= least;
    });
  }

  const DeformProblem& problem_;
  Blend blend_;
  const DeformOptions& options_;
  std::vector<Vec3> position_;
  std::vector<int> unknown_;       // by node: its position in free_, or kFixed
  std::vector<std::size_t> free_;  // ascending
};

}  // namespace

std::vector<Vec3> deformed(const DeformProblem& problem, Blend blend, const DeformOptions& options) {
  return Deformer(problem, blend, options).run();
}

}  // namespace meshgraft
