#include "support/random_scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "support/scenes.hpp"

namespace meshgraft::scenes {
namespace {

constexpr double kSize = 0.1;   // edge length of the first shape
constexpr double kAlike = 1.6;  // ratio of the sizes below which nothing grades
constexpr double kTwoPi = 2 * std::numbers::pi;

struct Frame {
  Vec3 origin, x, y, z;
  [[nodiscard]] Vec3 at(double a, double b, double c) const { return origin + a * x + b * y + c * z; }
};

/// z in any direction.
Frame any_frame(const Draw& draw, Vec3 origin) {
  const double c = draw(-1, 1), s = std::sqrt(1 - c * c), phi = draw(0, kTwoPi), turn = draw(0, kTwoPi);
  const Vec3 z{s * std::cos(phi), s * std::sin(phi), c};
  const Vec3 helper = std::abs(z.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 e = normalized(cross(z, helper)), f = cross(z, e);
  const Vec3 x = std::cos(turn) * e + std::sin(turn) * f;
  return {origin, x, cross(z, x), z};
}

enum class Kind : std::uint8_t { kPlate, kTube, kCone, kSphere, kSaddle };
constexpr std::array kNames{"plate", "tube", "cone", "sphere", "saddle"};

/// The mesh, and how far its surface is from the origin of its frame sideways: along y of the frame.
struct Drawn {
  Model model;
  double reach = 0;
};

std::size_t cells(double length, double size) {
  return std::max<std::size_t>(3, static_cast<std::size_t>(std::lround(length / size)));
}

Drawn drawn(Kind kind, const Draw& draw, const Frame& frame, double size, const std::string& group) {
  const double jitter = draw(0, 1) < 0.5 ? 0 : 0.2;
  const double radius = draw(0.3, 0.8), length = draw(1.6, 2.6);
  Surface s;
  s.group = group, s.jitter = jitter, s.seed = static_cast<std::uint32_t>(draw(1, 1e6));
  switch (kind) {
    case Kind::kPlate: {
      const Vec3 corner = frame.at(-0.5 * length, 0, -0.5 * length);
      return {staggered_plate(corner, length * frame.x, length * frame.z, size, group, jitter), 0};
    }
    case Kind::kSphere: {
      const double edge = std::numbers::pi / 2.84 * radius;  // of the icosahedron, along the sphere
      return {sphere(frame.origin, radius, cells(edge, size), group), radius};
    }
    case Kind::kSaddle: {
      const double bend = draw(0.1, 0.4);
      s.at = [=](double u, double v) {
        const double a = length * (u - 0.5), c = length * (v - 0.5);
        return frame.at(a, bend * (a * a - c * c), c);
      };
      s.nu = s.nv = cells(length, size);
      return {surface(s), 0};
    }
    case Kind::kTube:
    case Kind::kCone: {
      const double taper = kind == Kind::kCone ? draw(0.1, 0.35) : 0;
      s.at = [=](double u, double v) {
        const double r = radius * (1 + taper * (2 * v - 1)), angle = kTwoPi * u;
        return frame.at(r * std::sin(angle), r * std::cos(angle), length * (v - 0.5));
      };
      s.closed_u = true, s.nu = cells(kTwoPi * radius, size), s.nv = cells(length, size);
      return {surface(s), radius};
    }
  }
  return {};
}

}  // namespace

Draw draw_from(std::uint32_t seed) {
  const auto random = std::make_shared<std::mt19937>(seed);
  return [random](double low, double high) {
    return low + (high - low) * static_cast<double>((*random)()) / 4294967296.0;
  };
}

Merge random_shapes(const Draw& draw) {
  const auto any_kind = [&] { return static_cast<Kind>(std::min(4.0, draw(0, 5))); };
  const Kind first = any_kind(), second = any_kind();
  const double ratio = draw(0, 1) < 0.6 ? draw(1 / 1.5, 1.5) : draw(1.0 / 3, 3);
  Merge m;
  m.name = std::string(kNames[static_cast<std::size_t>(first)]) + "_" + kNames[static_cast<std::size_t>(second)];
  const Frame frame = any_frame(draw, {draw(-1, 1), draw(-1, 1), draw(-1, 1)});
  const Drawn base = drawn(first, draw, frame, kSize, "BASE");
  m.base = base.model;
  Frame other = any_frame(draw, frame.at(0, base.reach, 0) + Vec3{draw(-0.3, 0.3), draw(-0.3, 0.3), draw(-0.3, 0.3)});
  const bool tangent = draw(0, 1) < 0.25;
  if (tangent) {
    // y is normal to both surfaces where they nearly touch.
    const double turn = draw(0, kTwoPi);
    other.x = std::cos(turn) * frame.x + std::sin(turn) * frame.z, other.y = frame.y, other.z = cross(other.x, other.y);
  }
  Drawn part = drawn(second, draw, other, kSize * ratio, "PART");
  if (tangent) {
    const double depth = draw(0, 1) * draw(0, 1) * 4 * kSize * std::max(1.0, ratio);
    const Vec3 to = frame.at(0, base.reach + part.reach - depth, 0) - other.origin;
    part.model = moved(std::move(part.model), [=](Vec3 p) { return p + to; });
    m.name += "_tangent";
  }
  m.parts.push_back(std::move(part.model));
  m.mean_q = std::max(ratio, 1 / ratio) < kAlike ? 0.9 : 0.85;
  return m;
}

}  // namespace meshgraft::scenes
