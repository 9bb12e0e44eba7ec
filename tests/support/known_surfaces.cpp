#include "support/known_surfaces.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/quality.hpp"
#include "support/scenes.hpp"

namespace meshgraft::scenes {
namespace {

constexpr double kHalf = 1.2;  // of the width of the surfaces

std::function<Model(double)> grid(const std::function<Vec3(double u, double v)>& at) {
  return [=](double size) {
    Surface s;
    s.at = [=](double u, double v) { return at(kHalf * (2 * u - 1), kHalf * (2 * v - 1)); };
    s.nu = s.nv = static_cast<std::size_t>(std::lround(2 * kHalf / size));
    s.jitter = 0.15;
    return surface(s);
  };
}

double saddle_height(double x, double y) { return 0.4 * (x * x - y * y) + 0.1 * x * x * x; }

/// Along the normal above or below the point: the nearest one up to higher order of the distance.
Vec3 nearest_of_saddle(Vec3 p) {
  const Vec3 n = normalized({-(0.8 * p.x + 0.3 * p.x * p.x), 0.8 * p.y, 1});
  return p - dot(Vec3{0, 0, p.z - saddle_height(p.x, p.y)}, n) * n;
}

}  // namespace

std::vector<KnownSurface> known_surfaces() {
  return {{"SphereCap",
           [](double size) {
             return sphere({0, 0, 0}, 1, std::size_t(std::lround(kHalf / size)));
           },
           {0, 0, 1},
           [](Vec3 p) { return normalized(p); }},
          {"Cylinder",
           grid([](double u, double v) {
             return Vec3{std::sin(u), v, std::cos(u)};
           }),
           {0, 0, 1},
           [](Vec3 p) {
             const Vec3 d = normalized({p.x, 0, p.z});
             return Vec3{d.x, p.y, d.z};
           }},
          {"Torus",
           grid([](double u, double v) {
             const double r = 2 + std::cos(v);
             return Vec3{r * std::sin(u / 3), std::sin(v), r * std::cos(u / 3)};
           }),
           {0, 0, 3},
           [](Vec3 p) {
             const Vec3 ring = 2 * normalized({p.x, 0, p.z});
             return ring + normalized(p - ring);
           }},
          {"Saddle",
           grid([](double u, double v) {
             return Vec3{u, v, saddle_height(u, v)};
           }),
           {0, 0, 0},
           nearest_of_saddle}};
}

Result<Refill> refilled(const KnownSurface& surface, double size, Blend blend, double edges) {
  Refill r;
  r.holed = without_faces(surface.model(size), [&](Vec3 p) { return distance(p, surface.centre) < edges * size; });
  FillOptions options;
  options.zone.blend = blend;
  auto merged = fill(r.holed, options);
  if (!merged) return Failure(merged.error());
  r.merged = std::move(*merged);
  for (const NewNode& n : r.merged.graft.new_nodes)
    r.distance = std::max(r.distance, distance(n.position, surface.nearest(n.position)));
  const Model filled = apply(r.holed, {}, r.merged);
  for (std::size_t e = r.holed.n_elements(); e < filled.n_elements(); ++e) {
    const Triangle t = filled.corners(ElementId(e));
    const Triangle on{surface.nearest(t[0]), surface.nearest(t[1]), surface.nearest(t[2])};
    r.normal = std::max(r.normal, norm(cross(unit_normal(t), unit_normal(on))));
  }
  return r;
}

double order_of(std::span<const Refill> refills, double Refill::*error) {
  return std::log2(refills.front().*error / refills.back().*error) / static_cast<double>(refills.size() - 1);
}

}  // namespace meshgraft::scenes
