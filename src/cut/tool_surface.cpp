#include "cut/tool_surface.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "cut/lattice.hpp"
#include "geometry/angles.hpp"
#include "geometry/quality.hpp"
#include "merge/compatibility.hpp"
#include "merge/inputs.hpp"

namespace meshgraft {
namespace {

constexpr double kCellEdges = 6;      // side of a cell, in mean edges of the base near the tool
constexpr double kChordEdges = 0.25;  // width of a facet of a cylinder, in least edges of the base near it
constexpr double kLeastFacets = 64, kMostFacets = 4096;
constexpr double kMostFacetCells = 1 << 17;
constexpr double kThinnest = 1 / CompatibilityLimits{}.max_size_ratio;  // of edges, what a tool is across
constexpr double kBeyond = 1.1;  // how far a surface goes beyond the base, in its radius

/// A ball around the nodes of a model.
struct Ball {
  Vec3 centre;
  double radius = 0;
};

Ball ball_around(const Model& base, Vec3 centre) {
  Ball ball{centre, 0};
  for (const Vec3 p : base.position) ball.radius = std::max(ball.radius, distance(p, centre));
  return ball;
}

Box box_of(const Model& base) {
  Box box;
  for (const Vec3 p : base.position) box.add(p);
  return box;
}

/// Edge lengths of the faces that a surface may cross; `height` tells how far a point is from it.
struct Fineness {
  double mean = 0, least = std::numeric_limits<double>::infinity();
};

template <class F>
Fineness fineness_near(const Model& base, F&& height) {
  Fineness near, all;
  double n_near = 0, n_all = 0;
  for (std::size_t e = 0; e < base.n_elements(); ++e) {
    if (!base.is_face(ElementId(e))) continue;
    const Triangle t = base.corners(ElementId(e));
    const double length = mean_edge_length(t);
    if (!(length > 0)) continue;
    all.mean += length, ++n_all, all.least = std::min(all.least, length);
    const std::array<double, 3> h{height(t[0]), height(t[1]), height(t[2])};
    const auto [low, high] = std::ranges::minmax(h);
    if (low > length || high < -length) continue;
    near.mean += length, ++n_near, near.least = std::min(near.least, length);
  }
  Fineness& found = n_near > 0 ? near : all;
  found.mean /= std::max(1.0, std::max(n_near, n_near > 0 ? n_near : n_all));
  return found;
}

/// As many digits as tell it from all other numbers: tools are told by the numbers they were given.
std::string exact(double value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::string numbers(std::initializer_list<Vec3> points) {
  std::string text;
  for (const Vec3 p : points)
    for (std::size_t k = 0; k < 3; ++k) {
      if (!text.empty()) text.push_back(',');
      text.append(exact(p[k]));
    }
  return text;
}

Failure senseless(const std::string& what, const std::string& hint) { return failure(ErrorCode::kUsage, what, hint); }

/// Directions too: they say nothing more than those of a length near 1.
Failure too_far(const std::string& name) {
  return senseless(name + " has a number beyond " + text_of(kLargestCoordinate) + ", which cannot be calculated with",
                   "give numbers that are not much larger than those of the mesh");
}

/// A tool that is hardly thicker than a line, beside edges of the base.
Failure too_thin(const std::string& name, double width, double edge) {
  return senseless(
      name + " is only " + text_of(width) + " across, where edges of the base are " + text_of(edge) + " long",
      "check the unit of the numbers; nothing narrower than " + text_of(kThinnest * edge) + " is cut out");
}

Result<ToolSurface> surface_of(const Model&, const Model* mesh) { return mesh_tool(*mesh); }

Result<ToolSurface> surface_of(const Model& base, const BoxTool& box) {
  const std::string name = "box " + numbers({box.low, box.high});
  if (!is_place(box.low) || !is_place(box.high)) return too_far(name);
  if (!(box.low.x < box.high.x && box.low.y < box.high.y && box.low.z < box.high.z))
    return senseless(name + " has no volume", "give the lowest corner first, then the highest: x0,y0,z0,x1,y1,z1");
  const Box around = box_of(base);
  const Vec3 centre = midpoint(box.low, box.high), half = 0.5 * (box.high - box.low);
  const auto height = [&](Vec3 p) {
    double h = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) h = std::max(h, std::abs(p[k] - centre[k]) - half[k]);
    return h;
  };
  const double edge = fineness_near(base, height).mean, step = kCellEdges * edge;
  const double width = 2 * std::min({half.x, half.y, half.z});
  if (width < kThinnest * edge) return too_thin(name, width, edge);
  std::array<std::vector<double>, 3> at;
  for (std::size_t k = 0; k < 3; ++k) at[k] = ticks(box.low[k], box.high[k], around.low[k], around.high[k], step);
  LatticeBuilder lattice;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
    for (const bool top : {false, true}) {
      const auto node = [&](std::size_t i, std::size_t j) {
        LatticeBuilder::Name name_of;
        name_of[k] = top ? at[k].size() - 1 : 0, name_of[u] = i, name_of[v] = j;
        Vec3 p;
        for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = at[axis][name_of[axis]];
        return lattice.node(name_of, p);
      };
      for (std::size_t i = 0; i + 1 < at[u].size(); ++i)
        for (std::size_t j = 0; j + 1 < at[v].size(); ++j)
          if (top)
            lattice.add_cell(node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
          else
            lattice.add_cell(node(i, j), node(i, j + 1), node(i + 1, j + 1), node(i + 1, j));
    }
  }
  const std::size_t n_cutting = lattice.n_faces();
  return ToolSurface{lattice.build(name), n_cutting, true, std::nullopt};
}

/// The plane is the base of a pyramid so large that all of the base behind the plane is inside.
Result<ToolSurface> surface_of(const Model& base, const PlaneTool& plane) {
  const std::string name = "plane " + numbers({plane.point, plane.normal});
  const Vec3 n = normalized(plane.normal);
  if (!is_place(plane.point) || !is_place(plane.normal)) return too_far(name);
  if (n == Vec3{})
    return senseless(name + " has no direction", "give a point and a normal that is not zero: x,y,z,nx,ny,nz");
  const auto height = [&](Vec3 p) { return dot(n, p - plane.point); };
  const Box around = box_of(base);
  const Vec3 middle = midpoint(around.low, around.high);
  const Ball ball = ball_around(base, middle - height(middle) * n);
  const double r = kBeyond * ball.radius;
  const auto [u, v] = directions_across(n);
  // At a depth of r the pyramid of half width 4 r and height 8 r is still 3.5 r wide.
  const std::vector<double> at = ticks(-4 * r, 4 * r, -r, r, kCellEdges * fineness_near(base, height).mean);
  // Coordinates along the plane count from the point given, so that nothing is lost where it is exact.
  const Vec3 origin = plane.point + dot(u, ball.centre - plane.point) * u + dot(v, ball.centre - plane.point) * v;
  LatticeBuilder lattice;
  const auto node = [&](std::size_t i, std::size_t j) {
    return lattice.node({i, j, 0}, origin + at[i] * u + at[j] * v);
  };
  const std::size_t last = at.size() - 1;
  const auto add_cells = [&](bool beyond) {  // the outermost ring is beyond the base
    for (std::size_t i = 0; i < last; ++i)
      for (std::size_t j = 0; j < last; ++j)
        if ((i == 0 || j == 0 || i + 1 == last || j + 1 == last) == beyond)
          lattice.add_cell(node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
  };
  add_cells(false);
  const std::size_t n_cutting = lattice.n_faces();
  add_cells(true);
  const NodeId apex = lattice.node({0, 0, 1}, origin - 8 * r * n);
  for (std::size_t i = 0; i < last; ++i) {
    lattice.add_face(node(i + 1, 0), node(i, 0), apex), lattice.add_face(node(i, last), node(i + 1, last), apex);
    lattice.add_face(node(0, i), node(0, i + 1), apex), lattice.add_face(node(last, i + 1), node(last, i), apex);
  }
  return ToolSurface{lattice.build(name), n_cutting, true, std::nullopt};
}

Result<ToolSurface> surface_of(const Model& base, const CylinderTool& cylinder) {
  const std::string name = "cylinder " + numbers({cylinder.point, cylinder.axis}) + "," + exact(cylinder.radius);
  const Vec3 axis = normalized(cylinder.axis);
  if (!is_place(cylinder.point) || !is_place(cylinder.axis) || !is_coordinate(cylinder.radius)) return too_far(name);
  if (axis == Vec3{} || !(cylinder.radius > 0))
    return senseless(name + " has no radius or no direction",
                     "give a point of the axis, a direction that is not zero and a radius above 0: x,y,z,ax,ay,az,r");
  const double r = cylinder.radius;
  const auto radial = [&](Vec3 p) { return (p - cylinder.point) - dot(axis, p - cylinder.point) * axis; };
  const Fineness fineness = fineness_near(base, [&](Vec3 p) { return norm(radial(p)) - r; });
  if (2 * r < kThinnest * fineness.mean) return too_thin(name, 2 * r, fineness.mean);
  const double facets = std::ceil(2 * std::numbers::pi * r / (kChordEdges * fineness.least));
  const auto n = static_cast<std::size_t>(std::clamp(facets, kLeastFacets, kMostFacets));

  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3 p : base.position) {
    low = std::min(low, dot(axis, p - cylinder.point)), high = std::max(high, dot(axis, p - cylinder.point));
  }
  const double step = std::max(kCellEdges * fineness.mean, (high - low) * static_cast<double>(n) / kMostFacetCells);
  const double beyond = (high - low) + r + step;
  const std::vector<double> at = ticks(low - beyond, high + beyond, low, high, step);
  const auto [u, v] = directions_across(axis);
  LatticeBuilder lattice;
  const auto node = [&, first = u, second = v](std::size_t i, std::size_t j) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i % n) / static_cast<double>(n);
    return lattice.node({i % n, j, 0},
                        cylinder.point + at[j] * axis + r * (std::cos(angle) * first + std::sin(angle) * second));
  };
  const NodeId bottom = lattice.node({0, 0, 1}, cylinder.point + at.front() * axis);
  const NodeId top = lattice.node({0, 1, 1}, cylinder.point + at.back() * axis);
  const std::size_t last = at.size() - 1;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < last; ++j)
      lattice.add_cell(node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
  const std::size_t n_cutting = lattice.n_faces();
  for (std::size_t i = 0; i < n; ++i)
    lattice.add_face(node(i + 1, 0), node(i, 0), bottom), lattice.add_face(node(i, last), node(i + 1, last), top);
  return ToolSurface{lattice.build(name), n_cutting, true, CylinderTool{cylinder.point, axis, r}};
}

}  // namespace

Result<ToolSurface> tool_surface(const Model& base, const CutTool& tool) {
  return std::visit([&](const auto& t) { return surface_of(base, t); }, tool);
}

}  // namespace meshgraft
