#include "remesh/star.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr double kFlatCost = 0.02;   // Q at which the cost of flatness levels off
constexpr double kSizeWeight = 0.1;  // of the squared misfit of the size in the cost
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Q and mean edge length of a face with its vertex at p.
struct Shape {
  Shape(const Star::Face& f, Vec3 p) {
    const Vec3 u = f.a - p, v = f.b - p, twice_area = cross(u, v);
    const std::array<double, 3> edges{norm(u), f.opposite, norm(v)};
    const double size = aspect_ratio(0.5 * norm(twice_area), edges);
    q = dot(twice_area, f.normal) < 0 ? -size : size;
    mean_edge = (edges[0] + edges[1] + edges[2]) / 3;
  }
  double q, mean_edge;
};

}  // namespace

double face_cost(double q, double mean_edge, double wanted) {
  if (q <= kFlat) return kInfinite;
  const double flatness = (1 - q) / (q + kFlatCost);
  const double misfit = 2 * (mean_edge - wanted) / (mean_edge + wanted);  // the logarithm of the ratio, to third order
  return flatness * flatness + kSizeWeight * misfit * misfit;
}

double Star::cost(Vec3 p, double enough) const {
  double sum = 0;
  for (const Face& f : faces) {
    const Shape shape(f, p);
    sum += face_cost(shape.q, shape.mean_edge, f.wanted);
    if (!(sum < enough)) return kInfinite;
  }
  return sum;
}

double Star::flatness(Vec3 p, double enough) const {
  double worst = 1;
  for (const Face& f : faces) {
    worst = std::min(worst, Shape(f, p).q);
    if (worst <= kFlat || !(1 - worst < enough)) return kInfinite;
  }
  return 1 - worst;
}

}  // namespace meshgraft
