#include "patch/surface_laplacian.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr double kFitRadius = 1.5;   // of the mean distance of the neighbours: where weights have fallen to 1/e
constexpr double kSurplus = 1.2;     // nodes per coefficient of a fit, at least
constexpr double kWellPosed = 1e-6;  // least ratio of pivots of a fit
constexpr double kLeastSine = 1e-6;  // of an angle whose cotangent is taken

/// u, v, uu, uv, vv, uuu, ...: 5 terms for the second degree, 9 for the third.
std::array<double, 9> terms(double u, double v) {
  return {u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v, v * v * v};
}

void add(NodeWeights& to, const NodeWeights& from, double factor) {
  for (const auto& [node, w] : from) to[node] += factor * w;
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

NodeWeights SurfaceLaplacian::cotangents(std::size_t node) const {
  NodeWeights weights;
  const auto add_angle = [&](std::size_t at, std::size_t end) {  // the angle at `at` opposite to the edge node-end
    const Vec3 u = position_[node] - position_[at], v = position_[end] - position_[at];
    const double sine = std::max(norm(cross(u, v)), kLeastSine * norm(u) * norm(v));
    const double half = 0.5 * dot(u, v) / sine;
    weights[end] += half, weights[node] -= half;
  };
  for (const std::uint32_t f : faces_at_[node]) {
    const auto& v = faces_[f];
    const std::size_t k = v[0] == node ? 0 : v[1] == node ? 1 : 2;
    add_angle(v[(k + 1) % 3], v[(k + 2) % 3]);
    add_angle(v[(k + 2) % 3], v[(k + 1) % 3]);
  }
  return weights;
}

std::vector<std::size_t> SurfaceLaplacian::two_rings(std::size_t node) const {
  std::vector<std::size_t> nodes = neighbours_[node];
  for (const std::size_t v : neighbours_[node]) nodes.insert(nodes.end(), neighbours_[v].begin(), neighbours_[v].end());
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::erase(nodes, node);
  return nodes;
}

NodeWeights SurfaceLaplacian::of_fit(std::size_t node) const {
  Vec3 normal;
  for (const std::uint32_t f : faces_at_[node]) {
    const auto& v = faces_[f];
    normal += area_vector({position_[v[0]], position_[v[1]], position_[v[2]]});
  }
  normal = normalized(normal);
  const Vec3 helper = std::abs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 e = normalized(cross(normal, helper)), f = cross(normal, e);
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
    // The coefficients are a linear function of the values; of uu and vv twice makes the Laplacian.
    const Eigen::MatrixXd inverse = qr.solve(Eigen::MatrixXd(root.asDiagonal()));
    NodeWeights weights;
    for (Eigen::Index i = 0; i < m; ++i) {
      const double w = 2 * (inverse(2, i) + inverse(4, i)) / (h * h);
      weights[nodes[static_cast<std::size_t>(i)]] += w, weights[node] -= w;
    }
    return weights;
  }
  NodeWeights weights;  // of the mean of the neighbours: 4 / h^2 times its distance on a regular grid
  for (const std::size_t v : neighbours_[node]) {
    const double w = 4 / (h * h) / static_cast<double>(neighbours_[node].size());
    weights[v] += w, weights[node] -= w;
  }
  return weights;
}

const NodeWeights& SurfaceLaplacian::density(std::size_t node, int n) {
  auto& known = density_[static_cast<std::size_t>(n - 1)];
  if (const auto it = known.find(node); it != known.end()) return it->second;
  if (n == 1) return known[node] = of_fit(node);
  double area_around = 0;
  for (const std::uint32_t f : faces_at_[node]) {
    const auto& v = faces_[f];
    area_around += area({position_[v[0]], position_[v[1]], position_[v[2]]}) / 3;
  }
  NodeWeights weights;
  for (const auto& [v, w] : cotangents(node)) add(weights, density(v, n - 1), w / area_around);
  return known[node] = std::move(weights);
}

NodeWeights SurfaceLaplacian::power(std::size_t node, int n) {
  if (n == 1) return cotangents(node);
  if (n > 2 && std::ranges::any_of(neighbours_[node], [&](std::size_t v) { return is_on_border(v); })) n = 2;
  NodeWeights weights;
  for (const auto& [v, w] : cotangents(node)) add(weights, density(v, n - 1), w);
  return weights;
}

}  // namespace meshgraft
