#include "zone/own_size.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/closest.hpp"
#include "zone/original_faces.hpp"
#include "zone/parents.hpp"

namespace meshgraft {
namespace {

constexpr double kUniform = 1.03;  // largest over smallest value below which a sheet is taken as uniform

Box box_of(const Triangle& t) {
  Box box;
  for (const Vec3 p : t) box.add(p);
  return box;
}

/// The faces of one sheet around a vertex.
class Around {
 public:
  void add(OwnSize::Lengths face, Vec3 area_vector) {
    size_ += face.size, edge_ += face.edge, ++count_;
    least_ = std::min(least_, face.edge);
    normal_ += area_vector;
  }
  /// After all of them were added.
  void add_lean(Vec3 area_vector) { across_ += norm(cross(area_vector, normalized(normal_))); }

  /// A vertex stands above the middle of an equilateral face of size s around it by the slope of the faces
  /// times s / sqrt(3).
  [[nodiscard]] OwnSize::Lengths lengths(double max_height) const {
    const double slope = across_ / norm(normal_), most = std::numbers::sqrt3 * max_height * least_ / slope;
    return {std::min(size_ / count_, most), std::min(edge_ / count_, most)};
  }

 private:
  double size_ = 0, edge_ = 0, across_ = 0;                 // sums; the last of areas seen along the normal
  double least_ = std::numeric_limits<double>::infinity();  // of the mean edge lengths
  int count_ = 0;
  Vec3 normal_;
};

}  // namespace

OwnSize::OwnSize(std::vector<Triangle> triangles, std::vector<std::array<Lengths, 3>> values)
    : triangles_(std::move(triangles)), values_(std::move(values)) {
  assert(!triangles_.empty());
  double least = std::numeric_limits<double>::infinity();
  Lengths sum;
  for (const auto& corner : values_)
    for (const Lengths& v : corner) {
      least = std::min(least, v.size), largest_ = std::max(largest_, v.size);
      sum.size += v.size, sum.edge += v.edge;
    }
  if (largest_ <= kUniform * least) {
    const double n = 3 * static_cast<double>(values_.size());
    uniform_ = {sum.size / n, sum.edge / n};
    largest_ = uniform_.size;
    return;
  }
  std::vector<Box> boxes;
  for (const Triangle& t : triangles_) boxes.push_back(box_of(t));
  tree_ = BoxTree(boxes);
}

OwnSize::Lengths OwnSize::at(Vec3 p) const {
  if (tree_.empty()) return uniform_;
  const auto found =
      tree_.nearest(p, [&](std::uint32_t i) { return squared_norm(p - closest_on_triangle(p, triangles_[i]).point); });
  const TrianglePoint closest = closest_on_triangle(p, triangles_[found.item]);
  Lengths result;
  for (std::size_t k = 0; k < 3; ++k) {
    const Lengths& value = values_[found.item][k];
    result.size += closest.weight[k] * value.size, result.edge += closest.weight[k] * value.edge;
  }
  return result;
}

std::vector<OwnSize> own_sizes(const Complex& original, const Complex& complex, const Brep& brep, double max_height,
                               double stretched) {
  const OriginalFaces originals(original);
  std::vector<Around> around(original.n_vertices());
  struct Samples {
    std::vector<Triangle> triangles;
    std::vector<std::array<OwnSize::Lengths, 3>> values;
  };
  std::vector<Samples> samples;  // by sheet
  samples.reserve(brep.sheets.size());
  for (const Sheet& sheet : brep.sheets) {
    std::vector<FaceId> faces;
    for (const FaceId f : sheet.faces)
      if (const FaceId o = originals.find(complex.parent[f.value]); o.valid()) faces.push_back(o);
    std::ranges::sort(faces);
    faces.erase(std::ranges::unique(faces).begin(), faces.end());
    for (const FaceId f : faces) {
      const Triangle t = original.corners(f);
      const double edge = mean_edge_length(t);
      const OwnSize::Lengths own{std::max(edge_length_of_area(area(t)), stretched * edge), edge};
      for (const VertexId v : original.face[f.value]) around[v.value].add(own, area_vector(t));
    }
    for (const FaceId f : faces) {
      const Vec3 vector = area_vector(original.corners(f));
      for (const VertexId v : original.face[f.value]) around[v.value].add_lean(vector);
    }
    auto& [triangles, values] = samples.emplace_back();
    triangles.reserve(faces.size()), values.reserve(faces.size());
    for (const FaceId f : faces) {
      triangles.push_back(original.corners(f));
      auto& value = values.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const VertexId v = original.face[f.value][k];
        value[k] = around[v.value].lengths(max_height);
      }
    }
    for (const FaceId f : faces)
      for (const VertexId v : original.face[f.value]) around[v.value] = {};
  }
  std::vector<OwnSize> result(samples.size());
  tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t s) {
    result[s] = OwnSize(std::move(samples[s].triangles), std::move(samples[s].values));
  });
  return result;
}

}  // namespace meshgraft
