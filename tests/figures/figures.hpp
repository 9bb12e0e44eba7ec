// The figures of the paper as small scenes: what goes in, for the tests and for the pictures.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "meshgraft/fill.hpp"
#include "meshgraft/merge.hpp"
#include "meshgraft/model.hpp"

namespace meshgraft::figures {

/// Figure 4: a stiffener on a wall (face/edge), a doubler on it (face/face), and a profile that does both.
struct Configuration {
  std::string name;
  Model base, part;
  std::vector<std::string> kinds;  // of PolylineSummary, that the junction has
};
[[nodiscard]] std::vector<Configuration> configurations();

/// Figure 6: ways in which two triangles meet. The first is (0,0,0), (2,0,0), (0,2,0).
struct Incidence {
  std::string name;
  std::array<Vec3, 3> second;
  std::vector<std::array<Vec3, 2>> lines;  // of the junction; where the triangles share area: its border
  std::vector<Vec3> points;                // alone
  bool overlaps = false;                   // they share area
};
[[nodiscard]] std::vector<Incidence> incidences();
[[nodiscard]] std::array<Vec3, 3> first_triangle();

/// Figure 7: two meshes cross, so that the line has nodes at all distances; ends and a bend are particular.
[[nodiscard]] std::array<Model, 2> uneven_crossing();

/// Figure 8: two meshes of like density that cross, along a line that runs at a distance from a row of edges in each.
[[nodiscard]] std::array<Model, 2> like_density(double from_row_of_wall, double from_row_of_rib);
inline constexpr double kNearRow = 0.3, kMidway = 0.5;  // of an edge: the figure, and a line in the middle of rows

/// Figure 9: a contour with straight and wavy sides.
[[nodiscard]] std::vector<Vec3> wavy_contour();

/// Figure 10: a sphere with a hole.
[[nodiscard]] Model holed_sphere();

/// Triangles as a model, each with nodes of its own.
[[nodiscard]] Model model_of(const std::vector<std::array<Vec3, 3>>& triangles, const std::string& group);

/// Of figure 9: positions in the contour of the faces that make the worst Q as large as possible, and of those that
/// make the area as small as possible (among all triangulations).
using Corners = std::vector<std::array<std::uint32_t, 3>>;
[[nodiscard]] Corners of_best_quality(const std::vector<Vec3>& contour);
[[nodiscard]] Corners of_least_area(const std::vector<Vec3>& contour);

}  // namespace meshgraft::figures
