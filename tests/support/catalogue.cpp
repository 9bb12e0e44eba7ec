#include "support/catalogue.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/scenes.hpp"

namespace meshgraft::scenes {
namespace {

constexpr double kSize = 0.1;           // edge length of the bases
constexpr double kGraded = 0.85;        // mean Q asked for where sizes grade, also into narrow places
constexpr double kRow = 12 * 2.0 / 23;  // y of a row of nodes of the wall, 23 rows of kSize triangles high
constexpr double kIrregular = 0.15;     // jitter of meshes that are not grids

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

Model wall(double size = kSize, double jitter = kIrregular) {
  return staggered_plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, size, "WALL", jitter);
}

/// Two triangles in each square cell, as structured meshers write.
Model grid_wall() { return plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, kSize, "WALL"); }

/// A stiffener on the line y = y0 of the wall from x0 to x1, from `below` under it to `above` over
/// it, leaning by `degrees` to the wall.
Model stiffener(double x0, double x1, double y0, double below, double above, double size = kSize, double degrees = 90,
                const std::string& group = "STIFFENER") {
  const Vec3 up{0, std::cos(radians(degrees)), std::sin(radians(degrees))};
  const Vec3 origin = Vec3{x0, y0, 0} - below * up;
  return staggered_plate(origin, {x1 - x0, 0, 0}, (below + above) * up, size, group, kIrregular);
}

Merge merge_of(std::string name, Model base, Model part, double mean_q = 0.9) {
  Merge m;
  m.name = std::move(name);
  m.base = std::move(base);
  m.parts.push_back(std::move(part));
  m.mean_q = mean_q;
  return m;
}

void add_angles(std::vector<Merge>& all) {
  for (const int degrees : {10, 20, 30, 45, 60, 75, 90}) {
    const std::string angle = std::to_string(degrees);
    all.push_back(merge_of("crossing_" + angle, wall(), stiffener(0.33, 1.61, 0.97, 0.31, 0.43, kSize, degrees)));
    all.push_back(merge_of("ending_" + angle, wall(), stiffener(0.33, 1.61, 0.97, 0, 0.43, kSize, degrees)));
  }
}

void add_sizes(std::vector<Merge>& all) {
  for (const int ratio : {3, 10}) {
    const std::string r = std::to_string(ratio);
    const double fine = kSize / ratio;
    all.push_back(merge_of("fine_part_1_" + r, wall(), stiffener(0.43, 1.21, 0.97, 0.31, 0.43, fine), kGraded));
    all.push_back(merge_of("fine_part_ending_1_" + r, wall(), stiffener(0.43, 1.21, 0.97, 0, 0.43, fine), kGraded));
    all.push_back(merge_of("coarse_part_" + r + "_1", wall(fine), stiffener(0.43, 1.21, 0.97, 0.31, 0.43), kGraded));
  }
}

/// A stiffener that was once meshed with the wall: its foot has the wall's own nodes.
Merge sharing_nodes() {
  Merge m = merge_of("sharing_nodes", wall(kSize, 0),
                     staggered_plate({0.3, kRow, 0}, {1.2, 0, 0}, {0, 0, 0.7}, kSize, "STIFFENER"));
  const auto nearest = [&](Vec3 p) {
    return *std::ranges::min_element(m.base.position, {}, [&](Vec3 q) { return distance(p, q); });
  };
  for (Vec3& p : m.parts[0].position)
    if (p.z == 0) p = nearest(p);
  return m;
}

void add_places(std::vector<Merge>& all) {
  all.push_back(merge_of("across_whole_wall", wall(), stiffener(-0.27, 2.31, 0.97, 0.31, 0.43)));
  all.push_back(merge_of("across_grid_off_grid", grid_wall(), stiffener(-0.27, 2.31, 0.97, 0.31, 0.43)));
  all.push_back(merge_of("on_grid_line", wall(kSize, 0),
                         staggered_plate({0.3, kRow, -0.3}, {1.2, 0, 0}, {0, 0, 0.7}, kSize, "STIFFENER")));
  Model ulp = staggered_plate({0.3, kRow, -0.3}, {1.2, 0, 0}, {0, 0, 0.7}, kSize, "STIFFENER");
  for (Vec3& p : ulp.position) p.y = std::nextafter(kRow, p.x < 0.9 ? 0.0 : 2.0);
  all.push_back(merge_of("one_ulp_off_grid_line", wall(kSize, 0), ulp));
  all.push_back(sharing_nodes());
  all.push_back(merge_of("to_free_edge", wall(), stiffener(0.61, 2, 0.97, 0, 0.43)));
  all.push_back(merge_of("along_free_edge", wall(), stiffener(0.33, 1.61, 0, 0, 0.43)));
  all.push_back(merge_of("on_corner", wall(), stiffener(1.17, 2, 0, 0, 0.43)));
  all.push_back(merge_of("beside_free_edge", wall(), stiffener(0.33, 1.61, 0.03, 0.31, 0.43), kGraded));
  all.push_back(merge_of("butt_joint", wall(),
                         staggered_plate({2, 0.2, 0}, {1, 0, 0}, {0, 1.3, 0}, 0.085, "STRAKE", kIrregular)));
}

/// A wall with a rib on the line y = 1 already: a T-line of the base.
Model ribbed_wall() {
  const std::array<Model, 3> pieces{staggered_plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "WALL"),
                                    staggered_plate({0, 1, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "WALL"),
                                    staggered_plate({0, 1, 0}, {2, 0, 0}, {0, 0, 0.4}, kSize, "RIB")};
  return welded(together(pieces));
}

void add_t_lines(std::vector<Merge>& all) {
  const auto across = [](double y0, double y1, double below, double above) {
    return staggered_plate({0.87, y0, -below}, {0, y1 - y0, 0}, {0, 0, below + above}, kSize, "STIFFENER", kIrregular);
  };
  all.push_back(merge_of("across_t_line", ribbed_wall(), across(0.33, 1.71, 0.31, 0.63)));
  all.push_back(merge_of("ending_across_t_line", ribbed_wall(), across(0.33, 1.71, 0, 0.3)));
  all.push_back(merge_of("up_to_t_line", ribbed_wall(), across(0.33, 1, 0, 0.3)));
  all.push_back(merge_of("on_t_line", ribbed_wall(),
                         staggered_plate({0.33, 1, -0.4}, {1.2, 0, 0}, {0, 0, 0.4}, 0.09, "STIFFENER", kIrregular)));
  all.push_back(merge_of("beside_t_line", ribbed_wall(), stiffener(0.33, 1.61, 1.04, 0, 0.43), kGraded));
}

void add_gaps(std::vector<Merge>& all) {
  // Half a percent of the edge length short of the wall, through it, and both along one edge.
  const double off = 0.004 * kSize;
  all.push_back(merge_of("short_of_wall", wall(), moved(stiffener(0.33, 1.61, 0.97, 0, 0.43), [=](Vec3 p) {
                           return p + Vec3{0, 0, off};
                         })));
  all.push_back(merge_of("through_wall", wall(), moved(stiffener(0.33, 1.61, 0.97, 0, 0.43), [=](Vec3 p) {
                           return p - Vec3{0, 0, off};
                         })));
  all.push_back(merge_of("partly_short", wall(), moved(stiffener(0.33, 1.61, 0.97, 0, 0.43), [=](Vec3 p) {
                           return p + Vec3{0, 0, off * std::sin(5 * p.x)};
                         })));
  all.push_back(merge_of("rounding_noise", wall(), moved(stiffener(0.33, 1.61, 0.97, 0, 0.43), [=](Vec3 p) {
                           return p + Vec3{0, 0, 1e-15 * std::sin(500 * p.x)};
                         })));
}

void add_curved(std::vector<Merge>& all) {
  all.push_back(merge_of("sphere_and_plate", sphere({0, 0, 0}, 1, 10),
                         staggered_plate({-1.6, -1.6, 0.23}, {3.2, 0, 0}, {0, 3.2, 0}, 0.11, "PLATE", kIrregular)));
  all.push_back(merge_of("sphere_and_equator", sphere({0, 0, 0}, 1, 10),
                         staggered_plate({-1.6, -1.6, 0}, {3.2, 0, 0}, {0, 3.2, 0}, 0.11, "PLATE", kIrregular)));
  all.push_back(merge_of("cylinder_and_rib", cylinder({0, 0, 0}, {0, 0, 2}, 0.7, kSize),
                         staggered_plate({0.45, 0.11, 0.31}, {0.7, 0, 0}, {0, 0, 1.3}, kSize, "RIB", kIrregular)));
  all.push_back(merge_of("cylinder_and_flange", cylinder({0, 0, 0}, {0, 0, 2}, 0.7, kSize),
                         staggered_plate({-1.1, -1.1, 0.93}, {2.2, 0, 0}, {0, 2.2, 0}, kSize, "FLANGE", kIrregular)));
  all.push_back(merge_of("two_pipes", cylinder({0, 0, 0}, {0, 0, 3}, 0.7, kSize, "RUN"),
                         cylinder({0.05, 0.1, 1.4}, {1.8, 0.1, 1.6}, 0.4, 0.08, "BRANCH"), kGraded));
  all.push_back(merge_of("coarse_pipe_fine_branch", cylinder({0, 0, 0}, {0, 0, 3}, 0.7, 0.12, "RUN"),
                         cylinder({0, 0, 1.5}, {1.6, 0, 1.5}, 0.3, 0.04, "BRANCH"), kGraded));
}

void add_many(std::vector<Merge>& all) {
  Surface wave;  // meets the wall five times
  wave.at = [](double u, double v) {
    return Vec3{0.2 + 1.6 * u, 0.4 + 1.1 * v, 0.25 * std::sin(5 * std::numbers::pi * u + 0.3)};
  };
  wave.nu = 36, wave.nv = 11, wave.group = "WAVE";
  all.push_back(merge_of("five_places", wall(), surface(wave), kGraded));

  Merge crossing = merge_of("two_parts_crossing", wall(), stiffener(0.33, 1.61, 0.97, 0.31, 0.43));
  crossing.parts.push_back(staggered_plate({0.91, 0.4, 0}, {0, 1.2, 0}, {0, 0, 0.35}, 0.09, "SECOND", kIrregular));
  all.push_back(crossing);

  Merge grid = merge_of("grid_3_by_3", wall(), stiffener(0.23, 1.77, 0.41, 0, 0.3), kGraded);
  for (const double y : {0.97, 1.53}) grid.parts.push_back(stiffener(0.23, 1.77, y, 0, 0.3));
  for (const double x : {0.43, 1.02, 1.57})
    grid.parts.push_back(staggered_plate({x, 0.21, 0}, {0, 1.6, 0}, {0, 0, 0.3}, kSize, "ACROSS", kIrregular));
  all.push_back(grid);

  Merge point = merge_of("three_through_a_point", wall(), stiffener(0.33, 1.61, 0.9, 0.31, 0.43));
  point.parts.push_back(staggered_plate({0.9, 0.4, -0.2}, {0, 1.2, 0}, {0, 0, 0.6}, 0.09, "SECOND", kIrregular));
  all.push_back(point);

  Merge brace = merge_of("on_the_joint_of_two", wall(), stiffener(0.33, 1.61, 0.97, 0, 0.43));
  brace.parts.push_back(staggered_plate({0.51, 0.97, 0}, {0.9, 0, 0}, {0, 0.3, 0.3}, kSize, "BRACE", kIrregular));
  all.push_back(brace);

  Merge miss = merge_of("miss", wall(), moved(stiffener(0.33, 1.61, 0.97, 0, 0.43), [](Vec3 p) {
                          return p + Vec3{0, 0, 1};
                        }));
  miss.apart = true;
  all.push_back(miss);
}

void add_far(std::vector<Merge>& all) {
  const auto away = [](Vec3 p) { return p + Vec3{1234.5, -987.25, 4321.125}; };  // 40,000 edge lengths
  const auto tiny = [](Vec3 p) { return 1e-4 * p; };
  all.push_back(merge_of("far_from_origin", moved(wall(), away), moved(stiffener(0.33, 1.61, 0.97, 0, 0.43), away)));
  all.push_back(merge_of("tiny_unit", moved(wall(), tiny), moved(stiffener(0.33, 1.61, 0.97, 0.2, 0.43), tiny)));
}

}  // namespace

std::vector<Merge> catalogue() {
  std::vector<Merge> all;
  add_angles(all);
  add_sizes(all);
  add_places(all);
  add_t_lines(all);
  add_gaps(all);
  add_curved(all);
  add_many(all);
  add_far(all);
  return all;
}

}  // namespace meshgraft::scenes
