// Parts that stop short of what they are to be joined to, or stick out beyond it.
#include <array>
#include <cmath>
#include <numbers>

#include "support/catalogue.hpp"
#include "support/scenes.hpp"

namespace meshgraft::scenes {
namespace {

constexpr double kSize = 0.1;        // edge length
constexpr double kIrregular = 0.15;  // jitter
constexpr double kTolerance = 0.55 * kSize;
constexpr double kFoot = 1.28;  // length of the stiffener

Model wall() { return staggered_plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, kSize, "WALL", kIrregular); }

/// A stiffener above the line y = 0.97 of the wall that leans by `degrees` and ends `gap` over it.
Model stiffener(double gap, double degrees = 90, double x0 = 0.33, double x1 = 0.33 + kFoot) {
  const double a = degrees * std::numbers::pi / 180;
  const Vec3 up{0, std::cos(a), std::sin(a)};
  return staggered_plate(Vec3{x0, 0.97, gap}, {x1 - x0, 0, 0}, 0.43 * up, kSize, "STIFFENER", kIrregular);
}

/// `length`: of the junction.
Merge gap_merge(std::string name, Model base, Model part, double length, double tolerance = kTolerance) {
  Merge m;
  m.name = std::move(name);
  m.base = std::move(base);
  m.parts.push_back(std::move(part));
  m.mean_q = 0.85;
  m.joined_length = length;
  m.max_off = 1e-3;  // all that is flat stays flat
  m.options.tolerance = {tolerance, false};
  return m;
}

void add_walls(std::vector<Merge>& all) {
  for (const int degrees : {90, 60, 40})
    for (const int percent : {20, 35, 50})
      all.push_back(gap_merge("short_" + std::to_string(percent) + "_at_" + std::to_string(degrees), wall(),
                              stiffener(percent * kSize / 100, degrees), kFoot));
  all.push_back(gap_merge("sticking_out", wall(), stiffener(-0.3 * kSize), kFoot));
  all.push_back(gap_merge("sticking_out_at_60", wall(), stiffener(-0.3 * kSize, 60), kFoot));
  // More than an edge length away.
  all.push_back(gap_merge("short_by_two_edges", wall(), stiffener(2 * kSize), kFoot, 2.2 * kSize));
  for (const int degrees : {90, 50})  // its foot goes on beyond the wall
    all.push_back(gap_merge("short_past_free_edge_at_" + std::to_string(degrees), wall(),
                            stiffener(0.4 * kSize, degrees, 0.93, 2 + 1.7 * kSize), 2 - 0.93));
  // In reach of the tolerance over the first 8 of the 13 edges of its foot only.
  all.push_back(gap_merge("partly_in_reach", wall(),
                          moved(stiffener(0),
                                [](Vec3 p) {
                                  return p + Vec3{0, 0, 0.8 * kSize * (p.x - 0.33) / kFoot};
                                }),
                          kFoot * 8 / 13));
}

void add_corners(std::vector<Merge>& all) {
  const std::array<Model, 2> walls{staggered_plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, kSize, "WALL"),
                                   staggered_plate({2, 0, 0}, {0, 0, 1}, {0, 2, 0}, kSize, "SIDE")};
  const Model corner = welded(together(walls));
  const double off = 0.5 * kSize;
  all.push_back(gap_merge("off_a_corner", corner, stiffener(off, 90, 0.9, 2 - off), 1.1 + 0.43 + off));
  const double turn = std::atan(0.08), far = 0.3 * kSize;  // neither wall is square to it, nor as far off
  all.push_back(gap_merge("askew_off_a_corner", corner,
                          staggered_plate({0.9, 0.97, off}, {1.1 - far, 0.08 * (1.1 - far), 0}, {0, 0, 0.43}, kSize,
                                          "STIFFENER", kIrregular),
                          1.1 / std::cos(turn) + 0.43 + off));
  const std::array<Model, 3> ribbed{staggered_plate({0, 0, 0}, {1, 0, 0}, {0, 2, 0}, kSize, "WALL"),
                                    staggered_plate({1, 0, 0}, {1, 0, 0}, {0, 2, 0}, kSize, "WALL"),
                                    staggered_plate({1, 0, 0}, {0, 0, 0.6}, {0, 2, 0}, kSize, "RIB")};
  all.push_back(
      gap_merge("short_of_t_line", welded(together(ribbed)), stiffener(0, 90, 0.21, 1 - 0.35 * kSize), 0.79 + 0.43));
  all.push_back(gap_merge(
      "short_beside_free_edge", wall(),
      staggered_plate({2 + 0.35 * kSize, 0.33, 0}, {0.7, 0, 0}, {0, 1.3, 0}, 0.09, "STRAKE", kIrregular), 1.3));
}

void add_curved(std::vector<Merge>& all) {
  const Model pipe = cylinder({0, 0, 0}, {0, 0, 2}, 0.7, kSize, "PIPE");
  for (const int percent : {20, 35, 50}) {
    const double r = 0.7 + percent * kSize / 100;
    all.push_back(gap_merge("short_of_pipe_" + std::to_string(percent), pipe,
                            staggered_plate({r, 0.03, 0.31}, {0.5, 0, 0}, {0, 0, 1.3}, kSize, "RIB", kIrregular), 1.3));
  }
  Surface half_ring;  // around the pipe, half an edge length off it
  half_ring.at = [](double u, double v) {
    const double a = std::numbers::pi * (0.1 + 0.8 * u), r = 0.7 + 0.35 * kSize + 0.4 * v;
    return Vec3{r * std::cos(a), r * std::sin(a), 0.93};
  };
  half_ring.nu = 22, half_ring.nv = 4, half_ring.group = "RING";
  all.push_back(gap_merge("ring_off_a_pipe", pipe, surface(half_ring), 0.8 * std::numbers::pi * 0.7));
  all.push_back(gap_merge("pipe_short_of_wall", wall(),
                          cylinder({1.03, 0.97, 0.4 * kSize}, {1.03, 0.97, 0.9}, 0.5, kSize, "PIPE"),
                          std::numbers::pi));
}

}  // namespace

std::vector<Merge> gap_catalogue() {
  std::vector<Merge> all;
  add_walls(all);
  add_corners(all);
  const std::size_t n_flat = all.size();
  add_curved(all);
  for (std::size_t k = n_flat; k < all.size(); ++k) all[k].max_off = 0.1;
  return all;
}

}  // namespace meshgraft::scenes
