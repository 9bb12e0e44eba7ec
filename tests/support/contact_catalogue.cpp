#include <array>
#include <cmath>
#include <numbers>

#include "support/catalogue.hpp"
#include "support/scenes.hpp"

namespace meshgraft::scenes {
namespace {

constexpr double kSize = 0.1;        // edge length of the bases
constexpr double kIrregular = 0.15;  // jitter of meshes that are not grids
constexpr double kGraded = 0.85;     // mean Q asked for where sizes grade

Model wall(double size = kSize, double jitter = kIrregular) {
  return staggered_plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, size, "WALL", jitter);
}

/// A doubler 0.78 by 0.6, `height` above the wall, turned by `degrees`.
Model doubler(double size = kSize, double height = 0, double degrees = 0) {
  const double a = degrees * std::numbers::pi / 180;
  return staggered_plate({0.63, 0.57, height}, {0.78 * std::cos(a), 0.78 * std::sin(a), 0},
                         {-0.6 * std::sin(a), 0.6 * std::cos(a), 0}, size, "DOUBLER", kIrregular);
}

Merge contact(std::string name, Model base, Model part, double mean_q = 0.88, double tolerance = 0) {
  Merge m;
  m.name = std::move(name);
  m.base = std::move(base);
  m.parts.push_back(std::move(part));
  m.mean_q = mean_q;
  if (tolerance > 0) m.options.tolerance = {tolerance, false};
  return m;
}

void add_doublers(std::vector<Merge>& all) {
  all.push_back(contact("doubler", wall(), doubler()));
  all.push_back(contact("doubler_turned", wall(), doubler(kSize, 0, 17)));
  all.push_back(contact("doubler_above", wall(), doubler(kSize, 0.03, 17), 0.88, 0.05));
  all.push_back(contact("doubler_below", wall(), doubler(kSize, -0.03), 0.88, 0.05));
  all.push_back(contact("doubler_up_to_rounding", wall(), moved(doubler(kSize, 0, 17), [](Vec3 p) {
                          return p + Vec3{0, 0, 1e-13 * std::sin(500 * p.x + 300 * p.y)};
                        })));
  all.push_back(contact("doubler_fine_1_3", wall(), doubler(kSize / 3, 0, 17), kGraded));
  all.push_back(contact("doubler_fine_1_8", wall(), doubler(kSize / 8), kGraded));
  all.push_back(contact("doubler_coarse_3_1", wall(kSize / 3), doubler(kSize), kGraded));
  all.push_back(contact("doubler_at_free_edge", wall(),
                        staggered_plate({0.63, 0, 0}, {0.78, 0, 0}, {0, 0.6, 0}, kSize, "DOUBLER", kIrregular)));
  all.push_back(contact("doubler_in_corner", wall(),
                        staggered_plate({0, 0, 0}, {0.78, 0, 0}, {0, 0.6, 0}, 0.09, "DOUBLER", kIrregular)));
}

void add_partial(std::vector<Merge>& all) {
  const auto strake = [](double size, double x0) {
    return staggered_plate({x0, 0.27, 0}, {1.3, 0, 0}, {0, 1.1, 0}, size, "STRAKE", kIrregular);
  };
  all.push_back(contact("partial_overlap_1_1", wall(), strake(kSize, 1.37)));
  all.push_back(contact("partial_overlap_1_8", wall(), strake(kSize / 8, 1.67), kGraded));
  all.push_back(contact("partial_overlap_across", wall(),
                        staggered_plate({0.57, -0.43, 0}, {0.8, 0, 0}, {0, 2.9, 0}, 0.09, "STRAKE", kIrregular)));
  all.push_back(contact("partial_overlap_corners", wall(),
                        staggered_plate({1.37, 1.43, 0}, {1.3, 0, 0}, {0, 1.1, 0}, 0.09, "STRAKE", kIrregular)));
  all.push_back(
      contact("shared_edge", wall(kSize, 0), staggered_plate({2, 0, 0}, {1, 0, 0}, {0, 2, 0}, kSize, "STRAKE")));
  all.push_back(contact("shared_edge_1e-9", wall(kSize, 0),
                        moved(staggered_plate({2, 0, 0}, {1, 0, 0}, {0, 2, 0}, kSize, "STRAKE"), [](Vec3 p) {
                          return p + Vec3{1e-9, 1e-9 * std::sin(70 * p.y), -1e-9};
                        })));
  all.push_back(contact("identical_meshes", wall(kSize, 0), moved(wall(kSize, 0), [](Vec3 p) {
                          return p + Vec3{0.5, 0, 0};
                        })));
}

/// A wall with a rib on the line y = 1 on its upper or lower side.
Model ribbed_wall(double side) {
  const std::array<Model, 3> pieces{staggered_plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "WALL"),
                                    staggered_plate({0, 1, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "WALL"),
                                    staggered_plate({0, 1, 0}, {2, 0, 0}, {0, 0, 0.4 * side}, kSize, "RIB")};
  return welded(together(pieces));
}

/// A leg flat on the wall, a leg standing on the line y = 0.9, one node mesh.
Model angle_profile(double x0, double x1, double size) {
  const std::array<Model, 2> legs{staggered_plate({x0, 0.9, 0}, {x1 - x0, 0, 0}, {0, 0.3, 0}, size, "FLAT_LEG"),
                                  staggered_plate({x0, 0.9, 0}, {x1 - x0, 0, 0}, {0, 0, 0.4}, size, "STANDING_LEG")};
  return welded(together(legs));
}

void add_profiles(std::vector<Merge>& all) {
  all.push_back(contact("doubler_over_t_line", ribbed_wall(-1), doubler(0.09, 0, 17)));
  all.push_back(contact("doubler_under_rib", ribbed_wall(1), doubler(0.09)));
  all.push_back(contact("angle_profile", wall(), angle_profile(0.37, 1.57, 0.09)));
  const std::array<Model, 2> corner{staggered_plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, kSize, "WALL"),
                                    staggered_plate({2, 0, 0}, {0, 0, 1}, {0, 2, 0}, kSize, "SIDE")};
  all.push_back(contact("angle_profile_up_to_side", welded(together(corner)), angle_profile(0.71, 2, 0.09)));
}

void add_curved(std::vector<Merge>& all) {
  Surface pad;  // of facets that do not match the pipe's
  pad.at = [](double u, double v) {
    const double a = -0.6 + 1.2 * u;
    return Vec3{0.7 * std::cos(a), 0.7 * std::sin(a), 0.6 + 0.9 * v};
  };
  pad.nu = 9, pad.nv = 10, pad.group = "PAD";
  all.push_back(contact("saddle_pad", cylinder({0, 0, 0}, {0, 0, 2}, 0.7, kSize), surface(pad), kGraded, 0.01));
}

void add_three(std::vector<Merge>& all) {
  Merge stack = contact("two_doublers_side_by_side", wall(), doubler());
  stack.parts.push_back(staggered_plate({0.2, 1.3, 0}, {0.5, 0, 0}, {0, 0.4, 0}, 0.09, "SECOND", kIrregular));
  all.push_back(stack);
  Merge standing = contact("stiffener_on_doubler", wall(), doubler());
  standing.parts.push_back(staggered_plate({0.3, 0.87, 0}, {1.4, 0, 0}, {0, 0, 0.4}, 0.09, "STIFFENER", kIrregular));
  all.push_back(standing);
}

Merge with(Merge scene, std::string name, Model part) {
  scene.name = std::move(name);
  scene.parts.push_back(std::move(part));
  return scene;
}

/// Three and more meshes over one place.
void add_stacks(std::vector<Merge>& all) {
  const auto second = [](double height) {
    return staggered_plate({0.79, 0.43, height}, {0.6, 0, 0}, {0, 0.92, 0}, 0.09, "SECOND", kIrregular);
  };
  const auto inner = [](double height) {
    return staggered_plate({0.81, 0.7, height}, {0.43, 0, 0}, {0, 0.34, 0}, 0.07, "INNER", kIrregular);
  };
  const Merge one = contact("", wall(), doubler());
  all.push_back(with(one, "two_doublers_on_one_place", second(0)));
  all.push_back(with(one, "doubler_on_doubler", inner(0)));
  all.push_back(with(with(one, "", second(0)), "three_doublers_on_one_place", inner(0)));
  all.push_back(
      with(contact("", wall(), staggered_plate({1.37, 0.27, 0}, {1.3, 0, 0}, {0, 1.1, 0}, kSize, "STRAKE", kIrregular)),
           "three_in_partial_overlap",
           staggered_plate({1.53, 0.83, 0}, {1.5, 0, 0}, {0, 0.93, 0}, 0.09, "THIRD", kIrregular)));
  all.push_back(with(contact("", ribbed_wall(-1), doubler(0.09, 0, 17)), "doublers_over_and_under_t_line", second(0)));
  all.back().min_q = 0.43;  // their borders cross at 17 degrees: 0.441 at best
  all.push_back(with(contact("", ribbed_wall(-1), doubler(0.09, 0.02), 0.88, 0.03),
                     "doublers_apart_over_and_under_t_line", second(-0.02)));
  // Through one line, through one point: two of them lie on each other.
  const auto standing = [](Vec3 from, Vec3 along, const char* group) {
    return staggered_plate(from, along, {0, 0, 0.4}, 0.09, group, kIrregular);
  };
  all.push_back(
      with(one, "doubler_and_web_through_a_line",
           moved(staggered_plate({0.3, 0.87, -0.3}, {1.4, 0, 0}, {0, 0, 0.6}, 0.09, "WEB", kIrregular), [](Vec3 p) {
             return p + Vec3{0, 0.4 * p.z, 0};
           })));
  all.push_back(with(with(one, "", standing({0.3, 0.87, 0}, {1.4, 0, 0}, "ALONG")), "doubler_and_webs_through_a_point",
                     standing({1.02, 0.3, 0}, {0, 1.2, 0}, "ACROSS")));
  // Each within the tolerance of the next, the last not of the wall. The plate between is joined last.
  const auto apart = [](double height) { return contact("", wall(), doubler(kSize, height), 0.85, 0.015); };
  all.push_back(with(apart(0.01), "doubler_on_doubler_apart", inner(0.02)));
  all.push_back(with(apart(0.01), "doubler_beyond_doubler_apart", second(0.02)));
  all.push_back(with(apart(0.02), "plate_between_wall_and_doubler", inner(0.01)));
  // The far corner stands off by nearly the tolerance.
  all.push_back(with(contact("", wall(),
                             moved(doubler(),
                                   [](Vec3 p) {
                                     return p + Vec3{0, 0, 0.046 * (p.x - 0.63)};
                                   }),
                             0.88, 0.04),
                     "leaning_doublers", moved(second(0), [](Vec3 p) {
                       return p + Vec3{0, 0, -0.04 * (p.y - 0.43)};
                     })));
}

}  // namespace

std::vector<Merge> contact_catalogue() {
  std::vector<Merge> all;
  add_doublers(all);
  add_partial(all);
  add_profiles(all);
  add_curved(all);
  add_three(all);
  add_stacks(all);
  return all;
}

}  // namespace meshgraft::scenes
