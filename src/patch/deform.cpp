#include "patch/deform.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/quality.hpp"
#include "patch/power_solver.hpp"
#include "patch/surface_laplacian.hpp"

namespace meshgraft {
namespace {

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
    double last = std::numeric_limits<double>::infinity();
    for (int round = 0; round < options_.most_rounds; ++round) {
      const double length = mean_length();
      const auto wanted = solution(length);
      if (!wanted) break;
      const Move move = moved(*wanted);
      if (move.across <= options_.settled * length || (move.share == 1 && move.across > kStall * last)) break;
      if (move.across > length) solver_.reset();  // too far for its factor
      last = move.share == 1 ? move.across : std::numeric_limits<double>::infinity();
    }
    return position_;
  }

 private:
  static constexpr int kFixed = -1;
  static constexpr int kMostHalvings = 4;
  static constexpr int kMostWithOldFactor = 15;  // iterations; a new factor costs as much
  static constexpr double kSolved = 1e-7;        // of the mean edge length: error of a solution
  static constexpr double kStall = 0.5;          // of the move before: moves that fall less will not fall any more

  struct Move {
    double across = 0;  // the largest across the surface; moves along it do not change the shape
    double share = 0;   // of the way to where nodes should be; 0 if no part of it is sound
  };

  struct System {
    SparseRows rows;
    Eigen::MatrixX3d right;
  };

  /// The operator at the free nodes, and what the fixed ones give to it.
  System system() const {
    const SparseRows all = SurfaceLaplacian(problem_.faces, position_).power(power(blend_));
    std::vector<Eigen::Triplet<double>> entries;
    const auto n = static_cast<Eigen::Index>(free_.size());
    System s{SparseRows(n, n), Eigen::MatrixX3d::Zero(n, 3)};
    for (Eigen::Index k = 0; k < n; ++k)
      for (SparseRows::InnerIterator it(all, static_cast<Eigen::Index>(free_[static_cast<std::size_t>(k)])); it; ++it) {
        const auto node = static_cast<std::size_t>(it.col());
        if (unknown_[node] != kFixed)
          entries.emplace_back(static_cast<int>(k), unknown_[node], it.value());
        else
          s.right.row(k) -= it.value() * row(position_[node]);
      }
    s.rows.setFromTriplets(entries.begin(), entries.end());
    return s;
  }

  static Eigen::RowVector3d row(Vec3 p) { return {p.x, p.y, p.z}; }

  /// Where the free nodes should be.
  std::optional<std::vector<Vec3>> solution(double length) {
    const System s = system();
    Eigen::MatrixX3d start(s.right.rows(), 3);
    for (std::size_t k = 0; k < free_.size(); ++k) start.row(static_cast<Eigen::Index>(k)) = row(position_[free_[k]]);
    PowerSolver::Options options{.settled = kSolved * length};
    const int most = std::exchange(options.most_iterations, kMostWithOldFactor);
    std::optional<Eigen::MatrixX3d> x;
    if (solver_) x = solver_->solution(s.rows, s.right, start, options);
    if (!x) {
      options.most_iterations = most;
      solver_.emplace(problem_.faces, position_, unknown_, power(blend_));
      x = solver_->solution(s.rows, s.right, start, options);
    }
    if (!x) x = direct_solution(s);
    if (!x) return std::nullopt;
    std::vector<Vec3> wanted;
    for (const auto& p : x->rowwise()) wanted.push_back({p[0], p[1], p[2]});
    return wanted;
  }

  /// For systems that are far from symmetric.
  static std::optional<Eigen::MatrixX3d> direct_solution(const System& s) {
    const Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(s.rows);
    if (solver.info() != Eigen::Success) return std::nullopt;
    Eigen::MatrixX3d x = solver.solve(s.right);
    if (solver.info() != Eigen::Success || !x.allFinite()) return std::nullopt;
    return x;
  }

  [[nodiscard]] double mean_length() const {
    double sum = 0;
    for (const auto& f : problem_.faces) sum += mean_edge_length(corners(f));
    return sum / static_cast<double>(problem_.faces.size());
  }

  [[nodiscard]] Triangle corners(const std::array<std::uint32_t, 3>& f) const {
    return {position_[f[0]], position_[f[1]], position_[f[2]]};
  }

  /// Moves the free nodes there, or part of the way.
  Move moved(const std::vector<Vec3>& wanted) {
    const std::vector<Vec3> before = position_;
    Move move{.share = 1};
    for (int halvings = 0; halvings <= kMostHalvings; ++halvings, move.share *= 0.5) {
      for (std::size_t k = 0; k < free_.size(); ++k)
        position_[free_[k]] = lerp(before[free_[k]], wanted[k], move.share);
      if (!is_sound(before)) continue;
      const std::vector<Vec3> normals = normals_of_nodes();
      for (const std::size_t v : free_)
        move.across = std::max(move.across, std::abs(dot(position_[v] - before[v], normals[v])));
      return move;
    }
    position_ = before;
    return {};
  }

  [[nodiscard]] std::vector<Vec3> normals_of_nodes() const {
    std::vector<Vec3> normals(position_.size());
    for (const auto& f : problem_.faces)
      for (const std::uint32_t v : f) normals[v] += area_vector(corners(f));
    for (Vec3& n : normals) n = normalized(n);
    return normals;
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
  std::optional<PowerSolver> solver_;
};

}  // namespace

std::vector<Vec3> deformed(const DeformProblem& problem, Blend blend, const DeformOptions& options) {
  return Deformer(problem, blend, options).run();
}

}  // namespace meshgraft
