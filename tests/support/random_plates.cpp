#include "support/random_plates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/scenes.hpp"

namespace meshgraft::scenes {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2;
constexpr double kMostFaces = 900;  // of one plate, so that a law has time for many scenes
constexpr double kIrregular = 0.15;

struct Rectangle {
  Vec3 corner, u, v;
  [[nodiscard]] std::array<Vec3, 4> outline() const { return {corner, corner + u, corner + u + v, corner + v}; }
  [[nodiscard]] double length() const { return 2 * (norm(u) + norm(v)); }
};

double area_of(const std::vector<Vec3>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    twice += p.x * q.y - p.y * q.x;
  }
  return 0.5 * twice;
}

/// What of a convex polygon is over a rectangle; both are counter-clockwise as seen along z.
std::vector<Vec3> common_part(const std::vector<Vec3>& polygon, const Rectangle& rectangle) {
  std::vector<Vec3> p = polygon;
  const auto outline = rectangle.outline();
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 from = outline[k], along = outline[(k + 1) % 4] - from;
    const auto inside = [&](Vec3 q) { return along.x * (q.y - from.y) - along.y * (q.x - from.x); };
    std::vector<Vec3> left;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec3 q = p[i], r = p[(i + 1) % p.size()];
      const double dq = inside(q), dr = inside(r);
      if (dq >= 0) left.push_back(q);
      if ((dq < 0) != (dr < 0)) left.push_back(lerp(q, r, dq / (dq - dr)));
    }
    p = left;
  }
  return p;
}

/// Area over which there is any of the rectangles: sums over all sets of them.
double area_of_union(const std::vector<Rectangle>& rectangles) {
  double sum = 0;
  for (std::size_t set = 1; set < std::size_t{1} << rectangles.size(); ++set) {
    std::vector<Vec3> common;
    int n = 0;
    for (std::size_t k = 0; k < rectangles.size(); ++k) {
      if ((set >> k & 1) == 0) continue;
      const auto outline = rectangles[k].outline();
      common = n++ == 0 ? std::vector<Vec3>(outline.begin(), outline.end()) : common_part(common, rectangles[k]);
    }
    sum += (n % 2 == 1 ? 1 : -1) * area_of(common);
  }
  return sum;
}

bool one_in(const Draw& draw, double n) { return draw(0, n) < 1; }
double whole(double x) { return std::round(x); }

template <std::size_t N>
double any_of(const Draw& draw, const std::array<double, N>& values) {
  return values[std::min(N - 1, static_cast<std::size_t>(draw(0, N)))];
}

/// How plates are meshed; all of a scene alike, so that nodes fall on nodes where their places do.
struct Pattern {
  bool staggered = false;
  double jitter = 0;
  [[nodiscard]] Model mesh(const Rectangle& r, double size, const std::string& group) const {
    return (staggered ? staggered_plate : plate)(r.corner, r.u, r.v, size, group, jitter);
  }
};

/// A plate somewhere over the base, its sides some edges long.
Rectangle anywhere(const Draw& draw, const Rectangle& base, double size) {
  const double least = std::max(2.5 * size, 2.5), most = size * std::sqrt(kMostFaces / 2);
  const double length = std::min(most, draw(least, std::max(1.5 * least, 0.8 * base.u.x)));
  const double width = std::min(most, draw(least, std::max(1.5 * least, 0.8 * base.v.y)));
  const double turn = draw(0, 4 * kRightAngle);
  const Vec3 u{std::cos(turn), std::sin(turn), 0}, v{-u.y, u.x, 0};
  const Vec3 middle{draw(0, base.u.x), draw(0, base.v.y), 0};
  return {middle - 0.5 * length * u - 0.5 * width * v, length * u, width * v};
}

/// The same with its corner on a point of the base's lattice or half way between, and sides along its lines.
Rectangle aligned(const Draw& draw, const Rectangle& base, double size) {
  Rectangle r = anywhere(draw, base, size);
  const double turn = kRightAngle * std::floor(draw(0, 4));
  const double step = std::min(size, 1.0) * any_of(draw, std::array{1.0, 1.0, 0.5});
  const double length = size * std::max(2.0, whole(norm(r.u) / size)),
               width = size * std::max(2.0, whole(norm(r.v) / size));
  const double c = whole(std::cos(turn)), s = whole(std::sin(turn));
  r.corner = {step * whole(r.corner.x / step), step * whole(r.corner.y / step), 0};
  r.u = length * Vec3{c, s, 0}, r.v = width * Vec3{-s, c, 0};
  return r;
}

bool overlaps(const Rectangle& a, const Rectangle& b, double size) {
  const auto outline = a.outline();
  return area_of(common_part({outline.begin(), outline.end()}, b)) > size * size;
}

}  // namespace

RandomPlates random_plates(const Draw& draw) {
  const bool is_aligned = one_in(draw, 2.5), are_alike = is_aligned && one_in(draw, 3);
  const Pattern pattern{.staggered = one_in(draw, 2), .jitter = is_aligned || one_in(draw, 2) ? 0 : kIrregular};
  const auto any_size = [&]() -> double {
    if (are_alike) return 1;
    if (is_aligned) return any_of(draw, std::array{0.125, 0.25, 0.5, 1.0, 1.0, 2.0, 4.0, 8.0});
    return one_in(draw, 2) ? draw(0.7, 1.4) : std::exp2(draw(-3, 3));
  };
  std::vector<double> sizes{1};
  for (int n = one_in(draw, 3) ? 2 : 1; n > 0; --n) sizes.push_back(any_size());
  const double coarsest = std::ranges::max(sizes), finest = std::ranges::min(sizes);

  RandomPlates out;
  const auto side = [&] {
    return whole(std::min(draw(6, 12) * std::max(1.0, 0.4 * coarsest), std::sqrt(kMostFaces / 2)));
  };
  std::vector<Rectangle> plates{{{}, {side(), 0, 0}, {0, side(), 0}}};
  const double gap = one_in(draw, 3) ? draw(0.05, 0.3) * finest : 0;
  out.merge.name = "plates";
  out.merge.base = pattern.mesh(plates[0], 1, "BASE");
  out.layers = plates[0].u.x * plates[0].v.y;
  for (std::size_t k = 1; k < sizes.size(); ++k) {
    const double size = sizes[k];
    Rectangle r;
    do r = (is_aligned ? aligned : anywhere)(draw, plates[0], size);
    while (!std::ranges::any_of(plates, [&](const Rectangle& p) { return overlaps(r, p, std::max(1.0, size)); }));
    plates.push_back(r);
    out.outline += r.length();
    const std::string group = "PART" + std::to_string(k);
    r.corner.z = gap * static_cast<double>(k);
    std::vector<Model> pieces{pattern.mesh(r, size, group)};
    const bool has_leg = one_in(draw, 5);
    const double height = std::max(3.0, 2 * size);
    if (has_leg)
      pieces.push_back(Pattern{pattern.staggered, 0}.mesh({r.corner, r.u, {0, 0, height}}, size, group + "_LEG"));
    out.layers += norm(r.u) * norm(r.v) + (has_leg ? height * norm(r.u) : 0);
    out.layer += has_leg ? height * norm(r.u) : 0;
    out.merge.parts.push_back(has_leg ? welded(together(pieces)) : pieces[0]);
  }
  if (gap > 0) out.merge.options.tolerance = {gap * draw(1.2, 1.6) * (sizes.size() > 2 ? 2.0 : 1.0), false};
  out.reach = out.merge.options.tolerance.at(coarsest);
  out.layer += area_of_union(plates);
  return out;
}

std::function<Vec3(Vec3)> any_motion(const Draw& draw, double far, double noise) {
  const double c = draw(-1, 1), s = std::sqrt(1 - c * c), a = draw(0, 4 * kRightAngle), turn = draw(0, 4 * kRightAngle);
  const Vec3 axis{s * std::cos(a), s * std::sin(a), c};
  const Vec3 shift{draw(-far, far), draw(-far, far), draw(-far, far)};
  return [=](Vec3 p) {
    const Vec3 q = std::cos(turn) * p + std::sin(turn) * cross(axis, p) + (1 - std::cos(turn)) * dot(axis, p) * axis;
    return q + shift + Vec3{draw(-noise, noise), draw(-noise, noise), draw(-noise, noise)};
  };
}

}  // namespace meshgraft::scenes
