#include "zone/own_size.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include "geometry/closest.hpp"
#include "zone/original_faces.hpp"

namespace meshgraft {
namespace {

constexpr double kUniform = 1.03;  // largest over smallest value below which a sheet is taken as uniform

Box box_of(const Triangle& t) {
  Box box;
  for (const Vec3 p : t) box.add(p);
  return box;
}

}  // namespace

OwnSize::OwnSize(std::vector<Triangle> triangles, std::vector<std::array<double, 3>> values)
    : triangles_(std::move(triangles)), values_(std::move(values)) {
  assert(!triangles_.empty());
  double least = std::numeric_limits<double>::infinity(), sum = 0;
  for (const auto& corner : values_)
    for (const double v : corner) least = std::min(least, v), largest_ = std::max(largest_, v), sum += v;
  uniform_ = largest_ <= kUniform * least;
  if (uniform_) {
    largest_ = sum / (3 * static_cast<double>(values_.size()));
    return;
  }
  std::vector<Box> boxes;
  for (const Triangle& t : triangles_) boxes.push_back(box_of(t));
  tree_ = BoxTree(boxes);
}

double OwnSize::at(Vec3 p) const {
  if (uniform_ || tree_.empty()) return largest_;
  const auto found =
      tree_.nearest(p, [&](std::uint32_t i) { return squared_norm(p - closest_on_triangle(p, triangles_[i]).point); });
  const TrianglePoint closest = closest_on_triangle(p, triangles_[found.item]);
  const auto& value = values_[found.item];
  return closest.weight[0] * value[0] + closest.weight[1] * value[1] + closest.weight[2] * value[2];
}

std::vector<OwnSize> own_sizes(const Complex& original, const Complex& complex, const Brep& brep) {
  const OriginalFaces originals(original);
  std::vector<double> sum(original.n_vertices(), 0);
  std::vector<std::uint32_t> count(original.n_vertices(), 0);
  struct Samples {
    std::vector<Triangle> triangles;
    std::vector<std::array<double, 3>> values;
  };
  std::vector<Samples> samples;  // by sheet
  samples.reserve(brep.sheets.size());
  for (const Sheet& sheet : brep.sheets) {
    std::vector<FaceId> faces;
    for (const FaceId f : sheet.faces)
      if (const FaceId o = originals.find(complex.parent[f.value]); o.valid()) faces.push_back(o);
    std::ranges::sort(faces);
    faces.erase(std::ranges::unique(faces).begin(), faces.end());
    for (const FaceId f : faces)
      for (const VertexId v : original.face[f.value]) {
        sum[v.value] += mean_edge_length(original.corners(f));
        ++count[v.value];
      }
    auto& [triangles, values] = samples.emplace_back();
    triangles.reserve(faces.size()), values.reserve(faces.size());
    for (const FaceId f : faces) {
      triangles.push_back(original.corners(f));
      auto& value = values.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const VertexId v = original.face[f.value][k];
        value[k] = sum[v.value] / count[v.value];
      }
    }
    for (const FaceId f : faces)
      for (const VertexId v : original.face[f.value]) sum[v.value] = 0, count[v.value] = 0;
  }
  std::vector<OwnSize> result(samples.size());
  tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t s) {
    result[s] = OwnSize(std::move(samples[s].triangles), std::move(samples[s].values));
  });
  return result;
}

}  // namespace meshgraft
