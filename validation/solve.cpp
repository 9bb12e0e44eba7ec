#include "solve.hpp"

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <numbers>
#include <random>

#include "beam.hpp"
#include "shell.hpp"

namespace meshgraft::validation {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr Eigen::Index kHeld = -1;

/// Stiffness and mass over the freedoms that are not held.
class System {
 public:
  System(const Structure& structure, const Study& study)
      : structure_(structure), elasticity_{study.young, study.poisson} {
    number_freedoms();
    for (std::size_t f = 0; f < structure.faces.size(); ++f) {
      const ShellTriangle shell = element(f);
      add(structure.faces[f], shell.stiffness(), shell.mass(study.density));
    }
    for (const auto& beam : structure.beams) {
      const Vec3 a = structure.position[beam[0]], b = structure.position[beam[1]];
      add(beam, square_beam_stiffness(a, b, study.beam_width, elasticity_),
          square_beam_mass(a, b, study.beam_width, study.density));
    }
    stiffness.resize(n_free_, n_free_), mass.resize(n_free_, n_free_);
    stiffness.setFromTriplets(in_stiffness_.begin(), in_stiffness_.end());
    mass.setFromTriplets(in_mass_.begin(), in_mass_.end());
    in_stiffness_ = {}, in_mass_ = {};
  }

  [[nodiscard]] VectorXd pressure_load(double pressure) const {
    VectorXd load = VectorXd::Zero(n_free_);
    for (std::size_t f = 0; f < structure_.faces.size(); ++f) {
      if (!structure_.pressed[f]) continue;
      const Vec3 share = pressure / 3 * area_vector(structure_.corners(f));
      for (const std::uint32_t node : structure_.faces[f])
        for (std::size_t axis = 0; axis < 3; ++axis)
          if (const Eigen::Index at = freedom(node, axis); at != kHeld) load[at] += share[axis];
    }
    return load;
  }

  [[nodiscard]] std::vector<Vec3> translations(const VectorXd& free) const {
    std::vector<Vec3> all(structure_.position.size());
    for (std::uint32_t node = 0; node < all.size(); ++node)
      for (std::size_t axis = 0; axis < 3; ++axis) all[node][axis] = value(free, node, axis);
    return all;
  }

  [[nodiscard]] std::vector<double> stresses(const VectorXd& free) const {
    std::vector<double> stress(structure_.faces.size());
    for (std::size_t f = 0; f < stress.size(); ++f) {
      ShellTriangle::Vector u;
      for (std::size_t k = 0; k < 18; ++k) u[k] = value(free, structure_.faces[f][k / 6], k % 6);
      stress[f] = element(f).von_mises(u);
    }
    return stress;
  }

  SparseMatrix stiffness, mass;

 private:
  void number_freedoms() {
    first_.assign(structure_.position.size(), 0);
    for (const std::uint32_t node : structure_.clamped) first_[node] = kHeld;
    for (Eigen::Index& f : first_)
      if (f != kHeld) f = n_free_, n_free_ += 6;
  }

  [[nodiscard]] ShellTriangle element(std::size_t f) const {
    return {structure_.corners(f), structure_.thickness[f], elasticity_};
  }
  [[nodiscard]] Eigen::Index freedom(std::uint32_t node, std::size_t k) const {
    return first_[node] == kHeld ? kHeld : first_[node] + static_cast<Eigen::Index>(k);
  }
  [[nodiscard]] double value(const VectorXd& free, std::uint32_t node, std::size_t k) const {
    const Eigen::Index at = freedom(node, k);
    return at == kHeld ? 0 : free[at];
  }

  template <class Nodes, class Matrix>
  void add(const Nodes& nodes, const Matrix& k, const Matrix& m) {
    for (Eigen::Index i = 0; i < k.rows(); ++i)
      for (Eigen::Index j = 0; j < k.cols(); ++j) {
        const Eigen::Index row = freedom(nodes[i / 6], i % 6), column = freedom(nodes[j / 6], j % 6);
        if (row == kHeld || column == kHeld) continue;
        in_stiffness_.emplace_back(row, column, k(i, j));
        if (m(i, j) != 0) in_mass_.emplace_back(row, column, m(i, j));
      }
  }

  const Structure& structure_;
  Elasticity elasticity_;
  std::vector<Eigen::Index> first_;  // by node, or kHeld
  Eigen::Index n_free_ = 0;
  std::vector<Eigen::Triplet<double>> in_stiffness_, in_mass_;
};

using Factor = Eigen::SimplicialLLT<SparseMatrix>;

/// Lowest modes by subspace iteration (Bathe 1971): inverse iteration of a block, projected onto its span.
struct Modes {
  VectorXd squared_frequency;  // of all vectors of the block, (rad/s)^2, ascending
  MatrixXd shape;              // a column each
};

Modes lowest_modes(const System& system, const Factor& factor, Eigen::Index wanted) {
  constexpr double kPrecision = 1e-9;  // relative, of the squared frequencies
  constexpr int kMostRounds = 60;
  const Eigen::Index block = 2 * wanted + 8;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Modes modes;
  modes.shape = MatrixXd::NullaryExpr(system.mass.rows(), block, [&] { return normal(random); });
  modes.squared_frequency = VectorXd::Zero(block);
  for (int round = 0; round < kMostRounds; ++round) {
    const MatrixXd load = system.mass * modes.shape;
    const MatrixXd next = factor.solve(load);
    const MatrixXd stiffness = next.transpose() * load;
    const MatrixXd mass = next.transpose() * (system.mass * next);
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> projected(stiffness, mass);
    const VectorXd before = modes.squared_frequency;
    modes.squared_frequency = projected.eigenvalues();
    modes.shape = next * projected.eigenvectors();
    const auto change =
        (modes.squared_frequency - before).head(wanted).array() / modes.squared_frequency.head(wanted).array();
    if (change.abs().maxCoeff() < kPrecision) break;
  }
  return modes;
}

}  // namespace

Result<Response> solve(const Structure& structure, const Study& study) {
  const System system(structure, study);
  const Factor factor(system.stiffness);
  if (factor.info() != Eigen::Success)
    return failure(ErrorCode::kMalformed, "the stiffness is not positive definite", "something is not held");

  Response response;
  const VectorXd statics = factor.solve(system.pressure_load(study.pressure));
  response.displacement = system.translations(statics);
  response.von_mises = system.stresses(statics);

  const auto wanted = static_cast<Eigen::Index>(study.n_modes + study.spare_modes);
  const Modes modes = lowest_modes(system, factor, wanted);
  for (Eigen::Index k = 0; k < wanted; ++k) {
    response.frequency.push_back(std::sqrt(modes.squared_frequency[k]) / (2 * std::numbers::pi));
    response.shape.push_back(system.translations(modes.shape.col(k)));
  }
  return response;
}

}  // namespace meshgraft::validation
