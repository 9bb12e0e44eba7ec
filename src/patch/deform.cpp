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
    find_neighbours();
  }

  Deformed run() {
    Deformed result;
    double last = std::numeric_limits<double>::infinity();
    for (int round = 0; round < options_.most_rounds && !free_.empty(); ++round) {
      const double length = mean_length();
      const auto wanted = solution(length);
      if (!wanted) {
        if (round == 0) result.left = std::numeric_limits<double>::infinity();
        break;
      }
      const Move move = moved(*wanted);
      result.left = move.left.way / length, result.left_at = position_[move.left.node];
      const double way = move.gone.way, stalls = move.left.way == 0 && way < kNear * length ? kStall * last : way;
      if (way <= options_.settled * length || way > stalls) break;
      if (way > length) solver_.reset();  // too far for its factor
      last = move.left.way == 0 ? way : std::numeric_limits<double>::infinity();
    }
    if (!free_.empty()) result.moved = farthest(problem_.position, position_).way / mean_length();
    result.position = std::move(position_);
    return result;
  }

 private:
  static constexpr int kFixed = -1;
  static constexpr double kLeastShare = 0.05;    // of a way; less is not gone at all
  static constexpr int kMostTrials = 30;         // of shortening ways, each of which may spoil faces beside it
  static constexpr int kMoreWithOldFactor = 10;  // iterations than with a new one, which costs as much
  static constexpr double kSolved = 1e-7;        // of the mean edge length: error of a solution
  static constexpr double kStall = 0.5;          // of the move before: moves that fall less will not fall any more,
  static constexpr double kNear = 0.1;           // if they are within this many mean edge lengths

  /// Of a node across the surface; ways along it do not change the shape.
  struct Way {
    double way = 0;
    std::size_t node = 0;
  };

  struct Move {
    Way gone;  // the farthest
    Way left;  // the farthest that was not gone, as faces would not be sound there
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
    const int most = std::exchange(options.most_iterations, with_new_factor_ + kMoreWithOldFactor);
    std::optional<PowerSolver::Solution> solved;
    if (solver_) solved = solver_->solution(s.rows, s.right, start, options);
    if (!solved) {
      options.most_iterations = most;
      solver_.emplace(problem_.faces, position_, unknown_, power(blend_));
      solved = solver_->solution(s.rows, s.right, start, options);
      if (solved) with_new_factor_ = solved->iterations;
    }
    const auto x = solved ? std::optional(std::move(solved->x)) : direct_solution(s);
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
    for (const auto& f : problem_.faces) sum += mean_edge_length(corners(f, position_));
    return sum / static_cast<double>(problem_.faces.size());
  }

  using Face = std::array<std::uint32_t, 3>;
  static Triangle corners(const Face& f, const std::vector<Vec3>& position) {
    return {position[f[0]], position[f[1]], position[f[2]]};
  }

  /// Moves the free nodes there; those of faces that would not be sound go part of the way.
  Move moved(const std::vector<Vec3>& wanted) {
    const std::vector<Vec3> before = position_;
    std::vector<double> share(free_.size(), 1);
    std::vector<std::size_t> held;
    bool all_the_way = true;
    for (int trial = 0; trial < kMostTrials; ++trial) {
      for (std::size_t k = 0; k < free_.size(); ++k) position_[free_[k]] = lerp(before[free_[k]], wanted[k], share[k]);
      held = nodes_of_unsound(before);
      if (held.empty()) break;
      all_the_way = false;
      for (const std::size_t k : held) share[k] = share[k] > 2 * kLeastShare ? share[k] / 2 : 0;
    }
    if (!held.empty()) position_ = before;
    if (all_the_way) return {farthest(before, position_), {}};
    std::vector<Vec3> goal = position_;
    for (std::size_t k = 0; k < free_.size(); ++k) goal[free_[k]] = wanted[k];
    return {farthest(before, position_), farthest(position_, goal)};
  }

  [[nodiscard]] Way farthest(const std::vector<Vec3>& from, const std::vector<Vec3>& to) const {
    const std::vector<Vec3> normals = normals_of_nodes();
    Way most{0, free_.front()};
    for (const std::size_t v : free_)
      if (const double way = std::abs(dot(to[v] - from[v], normals[v])); way > most.way) most = {way, v};
    return most;
  }

  [[nodiscard]] std::vector<Vec3> normals_of_nodes() const {
    std::vector<Vec3> normals(position_.size());
    for (const auto& f : problem_.faces)
      for (const std::uint32_t v : f) normals[v] += area_vector(corners(f, position_));
    for (Vec3& n : normals) n = normalized(n);
    return normals;
  }

  /// Free nodes, by position in free_, of faces that have been made flat or folded back on a neighbour.
  [[nodiscard]] std::vector<std::size_t> nodes_of_unsound(const std::vector<Vec3>& before) const {
    std::vector<std::size_t> nodes;
    const auto add = [&](std::uint32_t f) {
      for (const std::uint32_t v : problem_.faces[f])
        if (unknown_[v] != kFixed) nodes.push_back(static_cast<std::size_t>(unknown_[v]));
    };
    for (std::uint32_t f = 0; f < problem_.faces.size(); ++f) {
      const double now = aspect_ratio(corners(problem_.faces[f], position_));
      if (!(now >= options_.least_quality || now >= aspect_ratio(corners(problem_.faces[f], before)))) add(f);
    }
    for (const auto& [f, g] : neighbours_)
      if (const double now = cosine(f, g, position_); !(now >= 0 || now >= cosine(f, g, before))) add(f), add(g);
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  [[nodiscard]] double cosine(std::uint32_t f, std::uint32_t g, const std::vector<Vec3>& position) const {
    return dot(unit_normal(corners(problem_.faces[f], position)), unit_normal(corners(problem_.faces[g], position)));
  }

  /// Faces that share an edge and are turned alike, one of them with a free node.
  void find_neighbours() {
    using Edge = std::array<std::uint32_t, 2>;
    std::vector<std::pair<Edge, std::uint32_t>> sides;
    const auto for_sides = [&](auto&& what) {
      for (std::uint32_t f = 0; f < problem_.faces.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) what(problem_.faces[f][k], problem_.faces[f][(k + 1) % 3], f);
    };
    for_sides([&](std::uint32_t a, std::uint32_t b, std::uint32_t f) { sides.push_back({{a, b}, f}); });
    std::ranges::sort(sides);
    for_sides([&](std::uint32_t a, std::uint32_t b, std::uint32_t f) {
      for (const auto& [edge, g] :
           std::ranges::equal_range(sides, Edge{b, a}, {}, &std::pair<Edge, std::uint32_t>::first))
        if (f < g && (moves(f) || moves(g))) neighbours_.push_back({f, g});
    });
  }

  [[nodiscard]] bool moves(std::uint32_t f) const {
    return std::ranges::any_of(problem_.faces[f], [&](std::uint32_t v) { return unknown_[v] != kFixed; });
  }

  const DeformProblem& problem_;
  Blend blend_;
  const DeformOptions& options_;
  std::vector<Vec3> position_;
  std::vector<int> unknown_;                              // by node: its position in free_, or kFixed
  std::vector<std::size_t> free_;                         // ascending
  std::vector<std::array<std::uint32_t, 2>> neighbours_;  // faces
  std::optional<PowerSolver> solver_;
  int with_new_factor_ = 0;  // iterations, the last time
};

}  // namespace

Deformed deformed(const DeformProblem& problem, Blend blend, const DeformOptions& options) {
  return Deformer(problem, blend, options).run();
}

}  // namespace meshgraft
