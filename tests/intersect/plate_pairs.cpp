#include "plate_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "geometry/quality.hpp"
#include "support/scenes.hpp"

namespace meshgraft::checks {
namespace {

constexpr double kBase = 6;
constexpr double kLonger = 1.5;  // edges than asked for: diagonals and shaken meshes
using Quad = std::array<Vec3, 4>;

Quad quad(Vec3 origin, Vec3 u, Vec3 v) { return {origin, origin + u, origin + u + v, origin + v}; }

struct Sides {
  Vec3 origin, u, v;
};

/// Of the plate, before both are shaken and tilted.
Sides sides(const PlatePair& p) {
  const Vec3 u{std::cos(p.turn), std::sin(p.turn), 0}, v{-u.y, u.x, 0};
  return {{p.x, p.y, 0}, p.length * u, p.width * v};
}

Quad base_quad() { return quad({0, 0, 0}, {kBase, 0, 0}, {0, kBase, 0}); }
Quad plate_quad(const PlatePair& p) {
  const Sides s = sides(p);
  return quad(s.origin, s.u, s.v);
}

/// How far a point is inside a convex polygon of the plane z = 0; negative outside.
double depth(const Quad& q, Vec3 p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 along = normalized(q[(k + 1) % 4] - q[k]), d = p - q[k];
    least = std::min(least, along.x * d.y - along.y * d.x);
  }
  return least;
}

Vec3 tilted(Vec3 p, double angle) {
  return {p.x, std::cos(angle) * p.y - std::sin(angle) * p.z, std::sin(angle) * p.y + std::cos(angle) * p.z};
}

double area_of(const Model& m) {
  double sum = 0;
  for (std::size_t e = 0; e < m.n_elements(); ++e) sum += area(m.corners(ElementId(e)));
  return sum;
}

/// Faults in words.
class Faults {
 public:
  template <class... Words>
  void operator()(const Words&... words) {
    std::ostringstream text;
    (text << ... << words);
    all_.push_back(text.str());
  }
  /// Counts a use of each edge of a face.
  void count_edges(const std::array<VertexId, 3>& face) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(face[k], face[(k + 1) % 3]);
      if (++uses_[{low, high}] == 3) (*this)("edge ", low.value, "-", high.value, " has a third face");
    }
  }
  [[nodiscard]] std::vector<std::string> all() && { return std::move(all_); }

 private:
  std::vector<std::string> all_;
  std::map<std::array<VertexId, 2>, int> uses_;
};

/// What borders may be moved by, and by how much areas may differ for it.
struct Slack {
  explicit Slack(const PlatePair& pair)
      : length(kLonger * tolerance(pair) + pair.noise),
        area(length * (2 * pair.length + 2 * pair.width) + 100 * pair.noise) {}
  double length, area;
};

}  // namespace

std::vector<Model> models(const PlatePair& p) {
  const auto frame = [&](Vec3 q) {
    return tilted(q + p.noise * Vec3{std::sin(70 * q.x), std::sin(90 * q.y), std::sin(110 * (q.x + q.y))}, p.tilt);
  };
  const auto plate = p.staggered ? scenes::staggered_plate : scenes::plate;
  const Sides s = sides(p);
  const auto lean = [&](Vec3 q) {
    const double along = dot(q - s.origin, s.u) / squared_norm(s.u) + dot(q - s.origin, s.v) / squared_norm(s.v);
    return frame({q.x, q.y, p.height + 0.5 * p.lean * along});
  };
  return {scenes::moved(plate({0, 0, 0}, {kBase, 0, 0}, {0, kBase, 0}, 1, "BASE", p.base_jitter), frame),
          scenes::moved(plate(s.origin, s.u, s.v, p.size, "PART", p.jitter), lean)};
}

double tolerance(const PlatePair& pair) { return 0.01 * std::min(1.0, pair.size); }

std::array<double, 2> depths(const PlatePair& pair, Vec3 p) {
  const Vec3 flat = tilted(p, -pair.tilt);
  return {depth(base_quad(), flat), depth(plate_quad(pair), flat)};
}

double layered_area(const Complex& complex) {
  double sum = 0;
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    if (!complex.layers_of(FaceId(f)).empty()) sum += area(complex.corners(FaceId(f)));
  return sum;
}

double common_area(const PlatePair& pair) {
  const Quad base = base_quad(), plate = plate_quad(pair);
  std::vector<Vec3> p(plate.begin(), plate.end());
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 inward = cross({0, 0, 1}, base[(k + 1) % 4] - base[k]);
    std::vector<Vec3> left;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec3 q = p[i], r = p[(i + 1) % p.size()];
      const double dq = dot(inward, q - base[k]), dr = dot(inward, r - base[k]);
      if (dq >= 0) left.push_back(q);
      if ((dq < 0) != (dr < 0)) left.push_back(lerp(q, r, dq / (dq - dr)));
    }
    p = left;
  }
  Vec3 sum;
  for (std::size_t i = 2; i < p.size(); ++i) sum += 0.5 * cross(p[i - 1] - p[0], p[i] - p[0]);
  return norm(sum);
}

std::vector<std::string> faults(const PlatePair& pair, const std::vector<Model>& models, const Corefined& corefined,
                                const GroupSets& sets) {
  Faults fault;
  const Complex& after = corefined.complex;
  const Slack slack(pair);
  double whole = 0, layered = 0;
  std::array<double, 2> of_group{};
  for (std::size_t f = 0; f < after.n_faces(); ++f) {
    const Triangle t = after.corners(FaceId(f));
    const double own = area(t);
    whole += own;
    for (const std::size_t k : {0, 1})
      if (sets.contains(after.face_groups[f], GroupId(100 * k))) of_group[k] += own;
    if (dot(area_vector(t), area_vector(models[after.parent[f].input].corners(after.parent[f].element))) <= 0)
      fault("face ", f, " is turned over");
    const bool is_layered = !after.layers_of(FaceId(f)).empty();
    if (is_layered) layered += own;
    const auto [inside_base, inside_plate] = depths(pair, centroid(t));
    if (is_layered && std::min(inside_base, inside_plate) < -slack.length)
      fault("face ", f, " stands for both in vain");
    if (!is_layered && std::min(inside_base, inside_plate) > slack.length) fault("face ", f, " stands for one of two");
    fault.count_edges(after.face[f]);
  }
  const double common = common_area(pair), base = area_of(models[0]), part = area_of(models[1]);
  if (std::abs(layered - common) > slack.area) fault("common area is ", layered, " instead of ", common);
  if (std::abs(whole - (base + part - common)) > slack.area)
    fault("area is ", whole, " instead of ", base + part - common);
  if (std::abs(of_group[0] - base) > 1e-6 * base) fault("base has area ", of_group[0], " instead of ", base);
  if (std::abs(of_group[1] - part) > slack.area) fault("plate has area ", of_group[1], " instead of ", part);
  return std::move(fault).all();
}

std::vector<std::string> faults_of_kept_base(const PlatePair& pair, const std::vector<Model>& models,
                                             const Corefined& corefined) {
  Faults fault;
  const Complex& after = corefined.complex;
  const Slack slack(pair);
  std::array<double, 2> areas{};
  for (std::size_t f = 0; f < after.n_faces(); ++f) {
    const Triangle t = after.corners(FaceId(f));
    const std::uint32_t own = after.component[f];
    areas[own] += area(t);
    if (own == 1 && std::ranges::min(depths(pair, centroid(t))) > slack.length)
      fault("face ", f, " of the plate is left on the base");
    fault.count_edges(after.face[f]);
    for (const VertexId v : after.face[f]) {
      const NodeRef node = after.node[v.value];
      if (own == 0 && node.valid() && node.input == 0 && after.position[v.value] != models[0].position[node.node.value])
        fault("a node of the base moved");
      if (own == 1 || (node.valid() && node.input == 0)) continue;
      const Vec3 at = after.position[v.value];
      if (std::ranges::any_of(depths(pair, at), [&](double depth) { return std::abs(depth) > slack.length; }))
        fault("the base is cut at (", at.x, ", ", at.y, ")");
    }
  }
  const double base = area_of(models[0]), rest = area_of(models[1]) - common_area(pair);
  if (std::abs(areas[0] - base) > 1e-6 * base) fault("base has area ", areas[0], " instead of ", base);
  if (std::abs(areas[1] - rest) > slack.area) fault("plate has area ", areas[1], " left instead of ", rest);
  return std::move(fault).all();
}

std::string to_string(const PlatePair& p) {
  std::ostringstream text;
  text.precision(17);
  text << "{.x = " << p.x << ", .y = " << p.y << ", .length = " << p.length << ", .width = " << p.width
       << ", .turn = " << p.turn << ", .size = " << p.size << ", .height = " << p.height << ", .lean = " << p.lean
       << ", .base_jitter = " << p.base_jitter << ", .jitter = " << p.jitter << ", .noise = " << p.noise
       << ", .tilt = " << p.tilt << ", .staggered = " << (p.staggered ? "true" : "false") << "}";
  return text.str();
}

}  // namespace meshgraft::checks
