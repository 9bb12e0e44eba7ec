#include "bench_scenes.hpp"

#include <cmath>

#include "support/scenes.hpp"

namespace meshgraft::bench {
namespace {

constexpr double kJitter = 0.2;  // of a cell: no real mesh is a grid

/// A square plate around the origin and a leaning stiffener through its middle, not along its rows.
Scene plate_and_stiffener(double side, double stiffener_length, double stiffener_height, double size) {
  const Vec3 along{std::cos(0.3), std::sin(0.3), 0}, up = normalized({-0.04, 0.2, 1});
  const Vec3 corner = -0.5 * stiffener_length * along - 0.31 * stiffener_height * up;
  return {scenes::plate({-side / 2, -side / 2, 0}, {side, 0, 0}, {0, side, 0}, size, "PLATE", kJitter),
          scenes::plate(corner, stiffener_length * along, stiffener_height * up, size, "STIFFENER", kJitter), size};
}

double cells_per_side(std::size_t n_faces) { return std::sqrt(static_cast<double>(n_faces) / 2); }

}  // namespace

Scene growing_zone(std::size_t n_faces) { return plate_and_stiffener(1, 0.6, 0.1, 1 / cells_per_side(n_faces)); }

Scene constant_zone(std::size_t n_faces) { return plate_and_stiffener(cells_per_side(n_faces), 42, 7, 1); }

}  // namespace meshgraft::bench
