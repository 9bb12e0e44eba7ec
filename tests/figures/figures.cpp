#include "figures/figures.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>

#include "geometry/quality.hpp"
#include "remesh/fill_polygon.hpp"
#include "support/scenes.hpp"

namespace meshgraft::figures {
namespace {

constexpr double kSize = 0.1;

Model wall() { return scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "WALL"); }

/// The triangulation with the least area, by the programme over all parts of the contour.
class LeastArea {
 public:
  explicit LeastArea(const std::vector<Vec3>& contour)
      : contour_(contour), n_(contour.size()), area_(n_ * n_, 0), apex_(n_ * n_, 0) {
    for (std::size_t width = 2; width < n_; ++width)
      for (std::size_t i = 0; i + width < n_; ++i) fill(i, i + width);
    collect(0, n_ - 1);
  }
  Corners faces;

 private:
  void fill(std::size_t i, std::size_t j) {
    double& best = area_[i * n_ + j];
    best = std::numeric_limits<double>::infinity();
    for (std::size_t k = i + 1; k < j; ++k) {
      const double a = area_[i * n_ + k] + area_[k * n_ + j] + area({contour_[i], contour_[k], contour_[j]});
      if (a < best) best = a, apex_[i * n_ + j] = k;
    }
  }
  void collect(std::size_t i, std::size_t j) {
    if (j - i < 2) return;
    const std::size_t k = apex_[i * n_ + j];
    faces.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(j)});
    collect(i, k), collect(k, j);
  }
  const std::vector<Vec3>& contour_;
  std::size_t n_;
  std::vector<double> area_;
  std::vector<std::size_t> apex_;
};

}  // namespace

std::vector<Configuration> configurations() {
  const Model stiffener = scenes::plate({0.3, 0.47, 0}, {1.3, 0, 0}, {0, 0, 0.4}, kSize, "STIFFENER");
  const Model doubler = scenes::plate({0.52, 0.27, 0}, {0.8, 0, 0}, {0, 0.5, 0}, kSize, "DOUBLER");
  const std::vector<Model> legs{scenes::plate({0.3, 0.33, 0}, {1.3, 0, 0}, {0, 0.3, 0}, kSize, "PROFILE"),
                                scenes::plate({0.3, 0.33, 0}, {1.3, 0, 0}, {0, 0, 0.4}, kSize, "PROFILE")};
  return {{"stiffener", wall(), stiffener, {"touching"}},
          {"doubler", wall(), doubler, {"overlap"}},
          {"profile", wall(), scenes::welded(scenes::together(legs)), {"overlap"}}};
}

std::array<Vec3, 3> first_triangle() { return {Vec3{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}; }

std::vector<Incidence> incidences() {
  const Vec3 a{0.2, 0.5, -1}, b{0.9, 0.5, -1}, top{0.5, 0.6, 1.5};  // two fifths of the way up is z = 0
  const Vec3 p{0.3, 0.3, 0}, q{0.9, 0.4, 0}, r{0.4, 0.9, 0};
  return {{"crossing", {a, b, top}, {{Vec3{0.32, 0.54, 0}, {0.74, 0.54, 0}}}, {}, false},
          {"edge_in_face",
           {Vec3{0.3, 0.4, 0}, {0.9, 0.4, 0}, {0.5, 0.4, 1}},
           {{Vec3{0.3, 0.4, 0}, {0.9, 0.4, 0}}},
           {},
           false},
          {"node_on_face", {Vec3{0.5, 0.5, 0}, {0.2, 0.5, 1}, {0.9, 0.5, 1}}, {}, {{0.5, 0.5, 0}}, false},
          {"node_on_edge", {Vec3{1, 0, 0}, {0.8, -0.3, 1}, {1.4, -0.3, 1}}, {}, {{1, 0, 0}}, false},
          {"node_on_node", {Vec3{0, 0, 0}, {-0.3, -0.2, 1}, {0.3, -0.4, 1}}, {}, {{0, 0, 0}}, false},
          {"edge_on_edge", {Vec3{0.5, 0, 0}, {1.5, 0, 0}, {1, -0.2, 1}}, {{Vec3{0.5, 0, 0}, {1.5, 0, 0}}}, {}, false},
          {"coplanar", {p, q, r}, {{p, q}, {q, r}, {r, p}}, {}, true}};
}

std::array<Model, 2> uneven_crossing() {
  return {scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "WALL"),
          scenes::plate({0.15, 0.1, -0.33}, {1.6, 0.73, 0}, {0, 0, 0.7}, 0.9 * kSize, "RIB")};
}

std::array<Model, 2> like_density(double from_row_of_wall, double from_row_of_rib) {
  return {scenes::plate({0, -from_row_of_wall * kSize, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "WALL"),
          scenes::plate({0, 0.5, -(3 + from_row_of_rib) * kSize}, {2, 0, 0}, {0, 0, 0.8}, kSize, "RIB")};
}

std::vector<Vec3> wavy_contour() {
  constexpr double kLength = 2, kWidth = 1, kHeight = 0.1;
  constexpr int kAlong = 4, kAcross = 2;  // sides
  const auto at = [&](double u, double v) {
    return Vec3{kLength * u, kWidth * v, kHeight * std::sin(2 * std::numbers::pi * u)};
  };
  std::vector<Vec3> contour;
  for (int i = 0; i < kAlong; ++i) contour.push_back(at(1.0 * i / kAlong, 0));
  for (int j = 0; j < kAcross; ++j) contour.push_back(at(1, 1.0 * j / kAcross));
  for (int i = 0; i < kAlong; ++i) contour.push_back(at(1 - 1.0 * i / kAlong, 1));
  for (int j = 0; j < kAcross; ++j) contour.push_back(at(0, 1 - 1.0 * j / kAcross));
  return contour;
}

Model holed_sphere() {
  return scenes::without_faces(scenes::sphere({0, 0, 0}, 1, 12), [](Vec3 p) { return distance(p, {0, 0, 1}) < 0.55; });
}

Model model_of(const std::vector<std::array<Vec3, 3>>& triangles, const std::string& group) {
  ModelBuilder builder;
  for (const auto& t : triangles) {
    const NodeId a = builder.add_node(t[0]), b = builder.add_node(t[1]), c = builder.add_node(t[2]);
    builder.add_to_group(group, builder.add_face(a, b, c));
  }
  return builder.build(group);
}

Corners of_best_quality(const std::vector<Vec3>& contour) {
  std::vector<VertexId> ids;
  for (std::size_t k = 0; k < contour.size(); ++k) ids.emplace_back(k);
  FillRules rules;
  rules.score = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return aspect_ratio({contour[i], contour[j], contour[k]});
  };
  rules.may_join = [](std::uint32_t, std::uint32_t) { return true; };
  return fill_polygon(ids, rules)->faces;
}

Corners of_least_area(const std::vector<Vec3>& contour) { return LeastArea(contour).faces; }

}  // namespace meshgraft::figures
