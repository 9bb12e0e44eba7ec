#include "bench_scenes.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "support/scenes.hpp"

namespace meshgraft::bench {
namespace {

constexpr double kJitter = 0.2;    // of a cell: no real mesh is a grid
constexpr double kAngle = 0.3;     // from the rows of the plate to the stiffeners
constexpr double kBeneath = 0.31;  // share of the height of a stiffener on the other side of the plate

double cells_per_side(std::size_t n_faces) { return std::sqrt(static_cast<double>(n_faces) / 2); }

/// A square plate around the origin.
Model plate(double side, double size) {
  return scenes::plate({-side / 2, -side / 2, 0}, {side, 0, 0}, {0, side, 0}, size, "PLATE", kJitter);
}

struct Stiffener {
  Vec3 middle;  // on the plate
  double angle = kAngle;
  double length = 0, height = 0;
};

/// It leans a little, and passes through the plate.
Model stiffener(const Stiffener& s, double size, const std::string& group) {
  const double c = std::cos(s.angle - kAngle), sine = std::sin(s.angle - kAngle);
  const Vec3 along{std::cos(s.angle), std::sin(s.angle), 0};
  const Vec3 up = normalized({-0.04 * c - 0.2 * sine, 0.2 * c - 0.04 * sine, 1});
  const Vec3 corner = s.middle - 0.5 * s.length * along - kBeneath * s.height * up;
  return scenes::plate(corner, s.length * along, s.height * up, size, group, kJitter);
}

Scene plate_and_stiffener(double side, double stiffener_length, double stiffener_height, double size) {
  return {plate(side, size), {stiffener({{}, kAngle, stiffener_length, stiffener_height}, size, "STIFFENER")}, size};
}

}  // namespace

Scene growing_zone(std::size_t n_faces) { return plate_and_stiffener(1, 0.6, 0.1, 1 / cells_per_side(n_faces)); }

Scene constant_zone(std::size_t n_faces) { return plate_and_stiffener(cells_per_side(n_faces), 42, 7, 1); }

Scene long_zone(std::size_t n_faces) { return plate_and_stiffener(cells_per_side(n_faces), 250, 7, 1); }

Scene grid(std::size_t n_faces, int n) {
  const double size = 1 / cells_per_side(n_faces);
  Scene scene{plate(1, size), {}, size};
  constexpr double kWidth = 0.6;  // of the field of stiffeners, in sides of the plate
  for (const double angle : {kAngle, kAngle + std::numbers::pi / 2})
    for (int k = 0; k < n; ++k) {
      const double beside = kWidth * ((k + 0.5) / n - 0.5);
      const Vec3 middle = beside * Vec3{-std::sin(angle), std::cos(angle), 0};
      const std::string group = "STIFFENER_" + std::to_string(scene.parts.size() + 1);
      scene.parts.push_back(stiffener({middle, angle, kWidth, 12 * size}, size, group));
    }
  return scene;
}

}  // namespace meshgraft::bench
