#include "cut/round.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"
#include "geometry/quality.hpp"
#include "zone/edge_table.hpp"
#include "zone/original_faces.hpp"

namespace meshgraft {
namespace {

constexpr double kOnEdge = 1e-9;    // of its length: a vertex nearer to an edge is on it
constexpr double kOnFace = 1e-13;   // of its edges: a point nearer to a face is on it
constexpr double kOnRound = 1e-13;  // of the radius: what rounding leaves
constexpr double kMostSlide =
    4;                         // of the distance to the cylinder: along an edge that hardly crosses it the way is long
constexpr int kMostSteps = 8;  // from face to face of a curved base

Vec3 radial(const CylinderTool& c, Vec3 p) { return (p - c.point) - dot(c.axis, p - c.point) * c.axis; }

double height(const CylinderTool& c, Vec3 p) { return norm(radial(c, p)) - c.radius; }

/// The least s, in size, for which p + s d is on the cylinder.
std::optional<double> way_to_cylinder(const CylinderTool& cylinder, Vec3 p, Vec3 d) {
  const Vec3 at = radial(cylinder, p), along = d - dot(cylinder.axis, d) * cylinder.axis;
  const double a = squared_norm(along), b = dot(at, along);
  const double c = (norm(at) - cylinder.radius) * (norm(at) + cylinder.radius);
  const double root = b * b - a * c;
  if (!(a > 0) || root < 0) return std::nullopt;
  const double q = -(b + std::copysign(std::sqrt(root), b));  // the larger of the two in size
  return q == 0 ? 0 : c / q;
}

/// Moves vertices of a complex as long as no face turns over.
class Mover {
 public:
  explicit Mover(Complex& complex) : complex_(complex), faces_at_(complex) {}

  void move(VertexId v, Vec3 to) {
    const Vec3 from = complex_.position[v.value];
    std::vector<Vec3> before;
    for (const FaceId f : faces_at_[v]) before.push_back(area_vector(complex_.corners(f)));
    complex_.position[v.value] = to;
    std::size_t i = 0;
    for (const FaceId f : faces_at_[v])
      if (dot(area_vector(complex_.corners(f)), before[i++]) <= 0) complex_.position[v.value] = from;
  }

  [[nodiscard]] std::span<const FaceId> faces_at(VertexId v) const { return faces_at_[v]; }

 private:
  Complex& complex_;
  VertexFaces faces_at_;
};

/// Ends of the edge of an original face that a vertex lies on.
std::optional<std::array<Vec3, 2>> edge_beneath(const Complex& original, std::span<const FaceId> parents, Vec3 p) {
  for (const FaceId f : parents) {
    const Triangle t = original.corners(f);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = t[k], b = t[(k + 1) % 3];
      if (distance(p, closest_on_segment(p, a, b).point) <= kOnEdge * distance(a, b)) return std::array{a, b};
    }
  }
  return std::nullopt;
}

}  // namespace

void round_border(const Complex& original, std::span<const std::array<VertexId, 2>> border,
                  const CylinderTool& cylinder, Complex& complex) {
  std::vector<VertexId> vertices;
  for (const auto& edge : border)
    for (const VertexId v : edge)
      if (v.value >= original.n_vertices()) vertices.push_back(v);
  std::ranges::sort(vertices);
  vertices.erase(std::ranges::unique(vertices).begin(), vertices.end());
  const OriginalFaces originals(original);
  Mover mover(complex);
  for (const VertexId v : vertices) {
    std::vector<FaceId> parents;
    for (const FaceId f : mover.faces_at(v)) parents.push_back(originals.find(complex.parent[f.value]));
    const Vec3 p = complex.position[v.value];
    const auto edge = edge_beneath(original, parents, p);
    if (!edge) continue;
    const Vec3 d = (*edge)[1] - (*edge)[0];
    const auto s = way_to_cylinder(cylinder, p, d);
    if (s && std::abs(*s) * norm(d) <= kMostSlide * std::abs(height(cylinder, p))) mover.move(v, p + *s * d);
  }
}

void round_nodes(const Complex& original, const Junction& cut, const CylinderTool& cylinder, Complex& complex) {
  std::vector<Box> boxes(original.n_faces());
  for (std::size_t f = 0; f < boxes.size(); ++f)
    for (const Vec3 p : original.corners(FaceId(f))) boxes[f].add(p);
  const BoxTree tree(boxes);
  const auto foot = [&](Vec3 p) {
    const auto squared_distance = [&](std::uint32_t f) {
      return squared_norm(p - closest_on_triangle(p, original.corners(FaceId(std::size_t{f}))).point);
    };
    const FaceId f(std::size_t{tree.nearest(p, squared_distance).item});
    const Vec3 q = closest_on_triangle(p, original.corners(f)).point;
    return std::pair{f, distance(p, q) <= kOnFace * mean_edge_length(original.corners(f)) ? p : q};
  };
  std::vector<std::uint8_t> degree(complex.n_vertices());
  for (const JunctionEdge& e : cut.edges)
    for (const VertexId v : e.ends) ++degree[v.value];
  Mover mover(complex);
  for (std::size_t i = 0; i < complex.n_vertices(); ++i) {
    const VertexId v(i);
    // At the end of the cut, or where it branches, another edge of the base holds the vertex.
    if (degree[i] != 2 || complex.node[i].valid()) continue;
    Vec3 p = complex.position[v.value];
    if (std::abs(height(cylinder, p)) <= kOnRound * cylinder.radius) continue;
    for (int step = 0; step < kMostSteps && std::abs(height(cylinder, p)) > kOnRound * cylinder.radius; ++step) {
      const auto [f, on_face] = foot(p);
      const Vec3 n = unit_normal(original.corners(f)), out = normalized(radial(cylinder, on_face));
      const Vec3 d = out - dot(out, n) * n;
      const auto s = way_to_cylinder(cylinder, on_face, d);
      if (!s) break;
      // What is a little beyond the face goes on its neighbour in the next step.
      p = foot(on_face + *s * d).second;
    }
    mover.move(v, p);
  }
}

}  // namespace meshgraft
