#include "patch/surface_laplacian.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/blocks.hpp"
#include "geometry/angles.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr double kFitRadius = 1.5;      // of the mean distance of the neighbours: where weights have fallen to 1/e
constexpr double kSurplus = 1.2;        // nodes per coefficient of a fit, at least
constexpr double kWellPosed = 1e-6;     // least ratio of pivots of a fit
constexpr double kMostWeight = 40;      // sum over a fit, over h^-2; 3 to 10 is usual, 100 makes a system unstable
constexpr double kLeastSine = 1e-6;     // of an angle whose cotangent is taken
constexpr std::size_t kFitBlock = 256;  // nodes per task

/// u, v, uu, uv, vv, uuu, ...: 5 terms for the second degree, 9 for the third.
std::array<double, 9> terms(double u, double v) {
  return {u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v, v * v * v};
}

using Entry = Eigen::Triplet<double>;

SparseRows square(std::size_t size, const std::vector<Entry>& entries) {
  SparseRows matrix(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Entry entry(std::size_t row, std::size_t column, double value) {
  return {static_cast<int>(row), static_cast<int>(column), value};
}

}  // namespace

SurfaceLaplacian::SurfaceLaplacian(std::span<const std::array<std::uint32_t, 3>> faces,
                                   const std::vector<Vec3>& position)
    : faces_(faces), position_(position), faces_at_(position.size()), neighbours_(position.size()) {
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      faces_at_[faces[f][k]].push_back(f);
      for (const std::size_t j : {(k + 1) % 3, (k + 2) % 3}) neighbours_[faces[f][k]].push_back(faces[f][j]);
    }
  for (auto& list : neighbours_) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

SparseRows SurfaceLaplacian::cotangents() const {
  std::vector<Entry> entries;
  entries.reserve(12 * faces_.size());
  for (const auto& f : faces_)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = f[k], j = f[(k + 1) % 3], at = f[(k + 2) % 3];  // the angle opposite to the edge i-j
      const Vec3 u = position_[i] - position_[at], v = position_[j] - position_[at];
      const double sine = std::max(norm(cross(u, v)), kLeastSine * norm(u) * norm(v));
      const double half = 0.5 * dot(u, v) / sine;
      for (const auto& e : {entry(i, j, half), entry(i, i, -half), entry(j, i, half), entry(j, j, -half)})
        entries.push_back(e);
    }
  return square(position_.size(), entries);
}

Eigen::VectorXd SurfaceLaplacian::inverse_areas() const {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(position_.size()));
  for (const auto& f : faces_)
    for (const std::uint32_t v : f)
      areas[static_cast<Eigen::Index>(v)] += area({position_[f[0]], position_[f[1]], position_[f[2]]}) / 3;
  return areas.cwiseInverse();
}

std::vector<std::size_t> SurfaceLaplacian::two_rings(std::size_t node) const {
  std::vector<std::size_t> nodes = neighbours_[node];
  for (const std::size_t v : neighbours_[node]) nodes.insert(nodes.end(), neighbours_[v].begin(), neighbours_[v].end());
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::erase(nodes, node);
  return nodes;
}

SurfaceLaplacian::Weights SurfaceLaplacian::fit(std::size_t node) const {
  Vec3 normal;
  for (const std::uint32_t f : faces_at_[node]) {
    const auto& v = faces_[f];
    normal += area_vector({position_[v[0]], position_[v[1]], position_[v[2]]});
  }
  normal = normalized(normal);
  const auto [e, f] = directions_across(normal);
  const Vec3 origin = position_[node];
  double h = 0;  // unit of length, so that the fit does not depend on the scale
  for (const std::size_t v : neighbours_[node]) h += distance(position_[v], origin);
  h /= static_cast<double>(neighbours_[node].size());

  const std::vector<std::size_t> nodes = two_rings(node);
  const auto m = static_cast<Eigen::Index>(nodes.size());
  for (const Eigen::Index n : {9, 5}) {
    if (static_cast<double>(m) < kSurplus * static_cast<double>(n)) continue;
    Eigen::MatrixXd values(m, n);
    Eigen::VectorXd root(m);  // of the weights
    for (Eigen::Index i = 0; i < m; ++i) {
      const Vec3 d = (position_[nodes[static_cast<std::size_t>(i)]] - origin) / h;
      const auto t = terms(dot(d, e), dot(d, f));
      root[i] = std::exp(-0.5 * squared_norm(d) / (kFitRadius * kFitRadius));
      for (Eigen::Index j = 0; j < n; ++j) values(i, j) = root[i] * t[static_cast<std::size_t>(j)];
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(values);
    const auto pivots = qr.matrixR().diagonal().cwiseAbs();
    if (!(pivots.minCoeff() > kWellPosed * pivots.maxCoeff())) continue;
    // The coefficients are a linear function of the values: c = P R^-1 Q^T root d. The Laplacian is twice those of uu
    // and vv, g c; its weights are root Q R^-T P^T g.
    Eigen::VectorXd g = Eigen::VectorXd::Zero(n), q = Eigen::VectorXd::Zero(m);
    g[2] = g[4] = 2 / (h * h);
    Eigen::VectorXd y = qr.colsPermutation().transpose() * g;
    qr.matrixR().topLeftCorner(n, n).triangularView<Eigen::Upper>().transpose().solveInPlace(y);
    q.head(n) = y;
    q.applyOnTheLeft(qr.householderQ());
    Weights weights;
    double sum = 0, size = 0;
    for (Eigen::Index i = 0; i < m; ++i) {
      const double w = root[i] * q[i];
      weights.emplace_back(nodes[static_cast<std::size_t>(i)], w), sum += w, size += std::abs(w);
    }
    if (size * h * h > kMostWeight) continue;
    weights.emplace_back(node, -sum);
    return weights;
  }
  Weights weights;  // of the mean of the neighbours: 4 / h^2 times its distance on a regular grid
  const double whole = 4 / (h * h);
  for (const std::size_t v : neighbours_[node])
    weights.emplace_back(v, whole / static_cast<double>(neighbours_[node].size()));
  weights.emplace_back(node, -whole);
  return weights;
}

SparseRows SurfaceLaplacian::fits() const {
  return square(position_.size(), collected<Entry>(
                                      position_.size(),
                                      [&](std::size_t node, std::vector<Entry>& entries) {
                                        for (const auto& [v, w] : fit(node)) entries.push_back(entry(node, v, w));
                                      },
                                      kFitBlock));
}

SparseRows SurfaceLaplacian::power(int n) const {
  const SparseRows outer = cotangents();
  if (n == 1) return outer;
  const SparseRows second = outer * fits();
  if (n == 2) return second;
  const SparseRows third = outer * SparseRows(inverse_areas().asDiagonal() * second);
  Eigen::VectorXd inside = Eigen::VectorXd::Ones(third.rows());
  for (std::size_t v = 0; v < position_.size(); ++v)
    if (std::ranges::any_of(neighbours_[v], [&](std::size_t u) { return is_on_border(u); }))
      inside[static_cast<Eigen::Index>(v)] = 0;
  const Eigen::VectorXd beside = Eigen::VectorXd::Ones(third.rows()) - inside;
  return SparseRows(inside.asDiagonal() * third) + SparseRows(beside.asDiagonal() * second);
}

}  // namespace meshgraft
