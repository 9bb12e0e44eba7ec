// Points and vectors of space, in the length unit of the input file.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace meshgraft {

struct Vec3 {
  double x = 0, y = 0, z = 0;

  constexpr double operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr double& operator[](std::size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr Vec3& operator+=(Vec3 b) { return x += b.x, y += b.y, z += b.z, *this; }
  constexpr Vec3& operator-=(Vec3 b) { return x -= b.x, y -= b.y, z -= b.z, *this; }
  constexpr Vec3& operator*=(double s) { return x *= s, y *= s, z *= s, *this; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) { return a += b; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return a -= b; }
constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(double s, Vec3 a) { return a *= s; }
constexpr Vec3 operator*(Vec3 a, double s) { return a *= s; }
constexpr Vec3 operator/(Vec3 a, double s) { return {a.x / s, a.y / s, a.z / s}; }
constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
constexpr double squared_norm(Vec3 a) { return dot(a, a); }
inline double norm(Vec3 a) { return std::sqrt(dot(a, a)); }
inline double distance(Vec3 a, Vec3 b) { return norm(a - b); }
constexpr Vec3 lerp(Vec3 a, Vec3 b, double t) { return a + t * (b - a); }
constexpr Vec3 midpoint(Vec3 a, Vec3 b) { return 0.5 * (a + b); }
/// `a` scaled to length 1; the zero vector stays zero.
inline Vec3 normalized(Vec3 a) {
  const double length = norm(a);
  return length > 0 ? a / length : Vec3{};
}
/// What a model may have at most: products of six such numbers, as in the squares of volumes, are still finite.
inline constexpr double kLargestCoordinate = 1e50;
/// What its box must have at least along one axis, unless that has no size: such products are not rounded to 0.
inline constexpr double kLeastExtent = 1e-50;
/// Neither too large nor no number.
constexpr bool is_coordinate(double x) { return -kLargestCoordinate <= x && x <= kLargestCoordinate; }
constexpr bool is_place(Vec3 a) { return is_coordinate(a.x) && is_coordinate(a.y) && is_coordinate(a.z); }

/// Axis-aligned box; empty until something is added.
struct Box {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};

  constexpr void add(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  constexpr void add(const Box& b) { add(b.low), add(b.high); }
  [[nodiscard]] constexpr bool empty() const { return low.x > high.x; }
  [[nodiscard]] constexpr bool overlaps(const Box& b) const {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y && low.z <= b.high.z &&
           b.low.z <= high.z;
  }
  [[nodiscard]] constexpr bool contains(Vec3 p) const {
    return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y && low.z <= p.z && p.z <= high.z;
  }
  [[nodiscard]] constexpr Box grown(double by) const {
    const Vec3 d{by, by, by};
    Box b;
    b.low = low - d, b.high = high + d;
    return b;
  }
  [[nodiscard]] double diagonal() const { return empty() ? 0 : distance(low, high); }
};

}  // namespace meshgraft
