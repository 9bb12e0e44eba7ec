#include "compare.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "geometry/closest.hpp"

namespace meshgraft::validation {
namespace {

/// Faces that meet at more than this are a fold.
constexpr double kFoldAngle = 10 * std::numbers::pi / 180;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::map<Edge, std::vector<std::size_t>> faces_of_edges(const Structure& structure) {
  std::map<Edge, std::vector<std::size_t>> faces;
  for (std::size_t f = 0; f < structure.faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      faces[std::minmax(structure.faces[f][k], structure.faces[f][(k + 1) % 3])].push_back(f);
  return faces;
}

bool is_fold(const Structure& structure, const std::vector<std::size_t>& faces) {
  if (faces.size() != 2) return false;
  const double along = dot(unit_normal(structure.corners(faces[0])), unit_normal(structure.corners(faces[1])));
  return std::abs(along) < std::cos(kFoldAngle);  // whatever the orientations
}

std::vector<std::array<Vec3, 2>> singular_lines(const Structure& structure) {
  const std::set<std::uint32_t> held(structure.clamped.begin(), structure.clamped.end());
  std::vector<std::array<Vec3, 2>> lines;
  for (const auto& [edge, faces] : faces_of_edges(structure))
    if (faces.size() > 2 || is_fold(structure, faces) || (held.contains(edge.first) && held.contains(edge.second)))
      lines.push_back({structure.position[edge.first], structure.position[edge.second]});
  return lines;
}

}  // namespace

Interpolation::Interpolation(const Structure& from, const Structure& to) {
  std::vector<Box> boxes(from.faces.size());
  for (std::size_t f = 0; f < boxes.size(); ++f)
    for (const Vec3 p : from.corners(f)) boxes[f].add(p);
  const BoxTree tree(boxes);
  for (const Vec3 p : to.position) {
    const std::uint32_t face =
        tree.nearest(p,
                     [&](std::uint32_t f) { return squared_norm(closest_on_triangle(p, from.corners(f)).point - p); })
            .item;
    places_.push_back({from.faces[face], closest_on_triangle(p, from.corners(face)).weight});
  }
}

std::vector<Vec3> Interpolation::operator()(const std::vector<Vec3>& field) const {
  std::vector<Vec3> values;
  for (const auto& [nodes, weight] : places_)
    values.push_back(weight[0] * field[nodes[0]] + weight[1] * field[nodes[1]] + weight[2] * field[nodes[2]]);
  return values;
}

namespace {

/// Of two fields, weighted by the areas around nodes.
double product(const Structure& on, const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0;
  for (std::size_t f = 0; f < on.faces.size(); ++f) {
    const double weight = area(on.corners(f));
    for (const std::uint32_t n : on.faces[f]) sum += weight * dot(a[n], b[n]);
  }
  return sum;
}

}  // namespace

double mac(const Structure& on, const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  const double ab = product(on, a, b);
  return ab * ab / (product(on, a, a) * product(on, b, b));
}

double spanned_share(const Structure& on, const std::vector<Vec3>& field, const std::vector<std::vector<Vec3>>& by) {
  const auto n = static_cast<Eigen::Index>(by.size());
  Eigen::MatrixXd among(n, n);
  Eigen::VectorXd with(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    with[i] = product(on, field, by[i]);
    for (Eigen::Index j = 0; j <= i; ++j) among(i, j) = among(j, i) = product(on, by[i], by[j]);
  }
  return with.dot(among.ldlt().solve(with)) / product(on, field, field);
}

std::vector<ModePair> paired_modes(const Structure& on, const std::vector<std::vector<Vec3>>& reference,
                                   const std::vector<std::vector<Vec3>>& other) {
  struct Candidate {
    double mac;
    std::size_t reference, other;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < reference.size(); ++i)
    for (std::size_t j = 0; j < other.size(); ++j) candidates.push_back({mac(on, reference[i], other[j]), i, j});
  std::ranges::stable_sort(candidates, std::greater{}, &Candidate::mac);

  std::vector<ModePair> pairs(reference.size());
  std::vector<bool> has_pair(reference.size()), is_taken(other.size());
  for (const Candidate& c : candidates) {
    if (has_pair[c.reference] || is_taken[c.other]) continue;
    pairs[c.reference] = {c.other, c.mac};
    has_pair[c.reference] = is_taken[c.other] = true;
  }
  return pairs;
}

std::vector<SamplePoint> sample_points(const Structure& structure, const std::vector<std::uint32_t>& faces,
                                       double margin) {
  const std::vector<std::array<Vec3, 2>> lines = singular_lines(structure);
  std::vector<Box> boxes(lines.size());
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (const Vec3 p : lines[l]) boxes[l].add(p);
  const BoxTree tree(boxes);
  std::vector<SamplePoint> points;
  for (const std::uint32_t f : faces) {
    const Vec3 p = centroid(structure.corners(f));
    const auto near = tree.nearest(
        p, [&](std::uint32_t l) { return squared_norm(closest_on_segment(p, lines[l][0], lines[l][1]).point - p); },
        margin * margin);
    if (!near.found()) points.push_back({p, structure.thickness[f], area(structure.corners(f))});
  }
  return points;
}

namespace {

/// A field on faces of one thickness, made continuous.
class SmoothField {
 public:
  SmoothField(const Structure& structure, std::vector<std::uint32_t> faces, const std::vector<double>& of_faces)
      : structure_(structure), faces_(std::move(faces)), value_(structure.position.size()) {
    std::vector<double> area_around(value_.size());
    std::vector<Box> boxes(faces_.size());
    for (std::size_t k = 0; k < faces_.size(); ++k) {
      const Triangle corners = structure.corners(faces_[k]);
      for (const Vec3 p : corners) boxes[k].add(p);
      for (const std::uint32_t n : structure.faces[faces_[k]]) {
        value_[n] += area(corners) * of_faces[faces_[k]];
        area_around[n] += area(corners);
      }
    }
    for (std::size_t n = 0; n < value_.size(); ++n)
      if (area_around[n] > 0) value_[n] /= area_around[n];
    tree_ = BoxTree(boxes);
  }

  [[nodiscard]] double at(Vec3 p) const {
    const auto near = tree_.nearest(p, [&](std::uint32_t k) { return squared_norm(on_face(p, k).point - p); });
    const std::array<double, 3> weight = on_face(p, near.item).weight;
    const auto& nodes = structure_.faces[faces_[near.item]];
    return weight[0] * value_[nodes[0]] + weight[1] * value_[nodes[1]] + weight[2] * value_[nodes[2]];
  }

 private:
  [[nodiscard]] TrianglePoint on_face(Vec3 p, std::uint32_t k) const {
    return closest_on_triangle(p, structure_.corners(faces_[k]));
  }

  const Structure& structure_;
  std::vector<std::uint32_t> faces_;
  std::vector<double> value_;  // by node
  BoxTree tree_;
};

}  // namespace

std::vector<double> sampled(const Structure& structure, const std::vector<std::uint32_t>& faces,
                            const std::vector<double>& of_faces, const std::vector<SamplePoint>& points) {
  std::map<double, std::vector<std::uint32_t>> by_thickness;
  for (const std::uint32_t f : faces) by_thickness[structure.thickness[f]].push_back(f);
  std::map<double, SmoothField> fields;
  for (const auto& [thickness, some] : by_thickness) fields.try_emplace(thickness, structure, some, of_faces);
  std::vector<double> values;
  for (const SamplePoint& p : points) values.push_back(fields.at(p.thickness).at(p.at));
  return values;
}

StressSummary stress_summary(const std::vector<SamplePoint>& points, const std::vector<double>& stress) {
  constexpr double kShare = 0.95;
  double total = 0;
  std::vector<std::size_t> by_stress;
  for (std::size_t k = 0; k < points.size(); ++k) by_stress.push_back(k), total += points[k].area;
  std::ranges::stable_sort(by_stress, {}, [&](std::size_t k) { return stress[k]; });
  StressSummary summary;
  double below = 0;
  for (const std::size_t k : by_stress) {
    if (below < kShare * total) summary.p95 = stress[k];
    below += points[k].area;
    summary.max = stress[k];
  }
  return summary;
}

}  // namespace meshgraft::validation
