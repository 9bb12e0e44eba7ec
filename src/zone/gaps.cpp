#include "zone/gaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/blocks.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"
#include "zone/curve_edges.hpp"
#include "zone/parents.hpp"
#include "zone/ruler.hpp"

namespace meshgraft {
namespace {

constexpr double kSideSine = 0.1;       // how far off its curve a way must lead to count as inside the sheet
constexpr double kSampleShare = 0.5;    // of the size: longest piece of curve looked at as one
constexpr int kMaxHalvings = 10;        // of such a piece
constexpr std::size_t kSideBlock = 64;  // sides looked from in one go

/// One edge of one face of a sheet on a curve; or a corner inside the sheet (a == b, no curve).
struct Side {
  Vec3 a, b, inward;
  std::array<VertexId, 2> edge;  // ascending
  CurveId curve;
  double arc_a = 0, arc_b = 0;  // along the curve
  bool frozen = false;          // nothing is remeshed there
};

/// Arc lengths of the chain vertices of all curves.
class Arcs {
 public:
  Arcs(const Complex& complex, const Brep& brep)
      : complex_(complex), curves_(brep.curves), inner_(complex.n_vertices(), 0) {
    std::vector<Vec3> points;
    for (const Curve& curve : brep.curves) {
      points.clear();
      for (const VertexId v : curve.chain) points.push_back(complex.position[v.value]);
      const std::vector<double> arc = arc_lengths(points);
      for (std::size_t i = 1; i + 1 < arc.size(); ++i) inner_[curve.chain[i].value] = arc[i];
      length_.push_back(arc.back());
    }
  }

  [[nodiscard]] double length(CurveId c) const { return length_[c.value]; }

  /// Of the ends of the edge a b of a curve.
  [[nodiscard]] std::array<double, 2> of_edge(CurveId c, VertexId a, VertexId b) const {
    const auto& chain = curves_[c.value].chain;
    const auto end = [&](VertexId v, VertexId other) {
      if (v == chain.front() && other == chain[1]) return 0.0;
      return v == chain.back() ? length(c) : inner_[v.value];
    };
    return {end(a, b), end(b, a)};
  }

  /// Shortest way along the curves between two places, if they are on one curve or on two that share an end.
  [[nodiscard]] double way(CurveId c, double s, CurveId d, double t) const {
    double least = std::numeric_limits<double>::infinity();
    if (c == d) least = std::abs(s - t);
    const auto ends = [&](CurveId k) {
      return std::array{curves_[k.value].chain.front(), curves_[k.value].chain.back()};
    };
    const auto from = ends(c), to = ends(d);
    for (const std::size_t i : {0, 1})
      for (const std::size_t j : {0, 1})
        if (from[i] == to[j]) least = std::min(least, (i == 0 ? s : length(c) - s) + (j == 0 ? t : length(d) - t));
    return least;
  }

  /// Whether two curves leave an end that they share by less than an angle. One that turns away from the other beside
  /// that end leaves a strip, not a corner.
  [[nodiscard]] bool form_corner(CurveId c, CurveId d, double angle) const {
    const auto leaving = [&](CurveId k, bool front) {
      const auto& chain = curves_[k.value].chain;
      const VertexId tip = front ? chain.front() : chain.back(), next = front ? chain[1] : chain[chain.size() - 2];
      return std::pair{tip, normalized(complex_.position[next.value] - complex_.position[tip.value])};
    };
    for (const bool i : {false, true})
      for (const bool j : {false, true}) {
        const auto [tip, u] = leaving(c, i);
        const auto [other, v] = leaving(d, j);
        if (tip == other && dot(u, v) > std::cos(angle)) return true;
      }
    return false;
  }

 private:
  const Complex& complex_;
  const std::vector<Curve>& curves_;
  std::vector<double> inner_;   // by vertex inside a chain; such a vertex is on one curve only
  std::vector<double> length_;  // by curve
};

class SheetGaps {
 public:
  SheetGaps(const std::vector<Side>& sides, const Arcs& arcs, const SizeOptions& options,
            const std::function<double(Vec3)>& size, const std::function<double(Vec3)>& plain)
      : sides_(sides), arcs_(arcs), options_(options), size_(size), plain_(plain) {
    std::vector<Box> boxes;
    for (const Side& side : sides) {
      Box& box = boxes.emplace_back();
      box.add(side.a), box.add(side.b);
    }
    tree_ = BoxTree(boxes);
  }

  void look_from(const Side& side, std::vector<SizeLimit>& result) const {
    if (side.curve.valid() && !side.frozen) look(side, 0, 1, 0, result);
  }

 private:
  /// Looks from the middle of a piece of a side, and closer where that is narrow.
  void look(const Side& side, double t0, double t1, int depth, std::vector<SizeLimit>& result) const {
    const double t = 0.5 * (t0 + t1), length = (t1 - t0) * distance(side.a, side.b);
    const Vec3 x = lerp(side.a, side.b, t);
    const double around = size_(x), allowed = allowed_at(side, t, x, around);
    if (length > kSampleShare * std::min(around, allowed) && depth < kMaxHalvings) {
      look(side, t0, t, depth + 1, result);
      look(side, t, t1, depth + 1, result);
    } else if (allowed < around) {
      result.push_back({lerp(side.a, side.b, t0), lerp(side.a, side.b, t1), allowed, allowed});
    }
  }

  [[nodiscard]] double allowed_at(const Side& side, double t, Vec3 x, double around) const {
    const double reach = around / options_.gap_share, cone = std::tan(0.5 * options_.cone);
    const double arc = side.arc_a + t * (side.arc_b - side.arc_a);
    double allowed = around;
    Box box;
    box.add(x);
    tree_.overlapping(box.grown(reach), [&](std::uint32_t j) {
      const Side& other = sides_[j];
      if (other.edge == side.edge) return;  // both faces of an edge in this sheet: no gap, whatever rounding says
      const SegmentPoint c = closest_on_segment(x, other.a, other.b);
      const Vec3 way = c.point - x;
      const double d = norm(way);
      if (d >= reach || dot(way, side.inward) <= kSideSine * d) return;
      if (c.t > 0 && c.t < 1 && -dot(way, other.inward) <= kSideSine * d) return;
      const double along =
          other.curve.valid() ? arcs_.way(side.curve, arc, other.curve, other.arc_a + c.t * (other.arc_b - other.arc_a))
                              : std::numeric_limits<double>::infinity();
      if (d >= cone * along) return;
      const bool corner = along < std::numeric_limits<double>::infinity() && side.curve != other.curve &&
                          arcs_.form_corner(side.curve, other.curve, options_.cone);
      const double floor = (corner ? options_.cone_floor : options_.gap_floor) * plain_(x);
      allowed = std::min(allowed, std::max(floor, options_.gap_share * d));
    });
    return allowed;
  }

  const std::vector<Side>& sides_;
  const Arcs& arcs_;
  const SizeOptions& options_;
  const std::function<double(Vec3)>& size_;
  const std::function<double(Vec3)>& plain_;
  BoxTree tree_;
};

std::vector<Side> sides_of(const Sheet& sheet, const Complex& complex, const Brep& brep, const Arcs& arcs,
                           const Parents& parents, const std::vector<Vec3>& area_vector,
                           const std::vector<std::uint8_t>& on_curve) {
  std::vector<Side> result;
  std::vector<VertexId> isolated;
  for (const FaceId f : sheet.faces) {
    const auto& v = complex.face[f.value];
    const Vec3 normal = normalized(area_vector[parents.of_face[f.value]]);
    for (std::size_t k = 0; k < 3; ++k) {
      if (brep.dimension[v[k].value] == Dimension::kCorner && !on_curve[v[k].value]) isolated.push_back(v[k]);
      const CurveId curve = brep.curve_of_edge[f.value][k];
      if (!curve.valid()) continue;
      const VertexId a = v[k], b = v[(k + 1) % 3];
      Side side{complex.position[a.value], complex.position[b.value], {}, {std::min(a, b), std::max(a, b)}, curve};
      side.inward = normalized(cross(normal, side.b - side.a));
      const auto arc = arcs.of_edge(curve, a, b);
      side.arc_a = arc[0], side.arc_b = arc[1], side.frozen = is_frozen_edge(complex, a, b);
      result.push_back(side);
    }
  }
  std::ranges::sort(isolated);
  isolated.erase(std::ranges::unique(isolated).begin(), isolated.end());
  for (const VertexId v : isolated)
    result.push_back({complex.position[v.value], complex.position[v.value], {}, {v, v}, {}});
  return result;
}

}  // namespace

std::vector<SizeLimit> narrow_places(const Complex& complex, const Brep& brep, const SizeOptions& options,
                                     const std::function<double(SheetId, Vec3)>& size,
                                     const std::function<double(SheetId, Vec3)>& plain) {
  const Arcs arcs(complex, brep);
  const Parents parents(complex);
  const std::vector<Vec3> area_vector = area_vectors(parents, complex);
  std::vector<std::uint8_t> on_curve(complex.n_vertices(), 0);
  for (const Curve& curve : brep.curves)
    for (const VertexId v : curve.chain) on_curve[v.value] = 1;
  std::vector<SizeLimit> result;
  for (std::size_t s = 0; s < brep.sheets.size(); ++s) {
    const std::vector<Side> sides = sides_of(brep.sheets[s], complex, brep, arcs, parents, area_vector, on_curve);
    const std::function<double(Vec3)> here = [&](Vec3 p) { return size(SheetId(s), p); };
    const std::function<double(Vec3)> plain_here = [&](Vec3 p) { return plain(SheetId(s), p); };
    const SheetGaps gaps(sides, arcs, options, here, plain_here);
    const auto narrow = collected<SizeLimit>(
        sides.size(), [&](std::size_t i, std::vector<SizeLimit>& out) { gaps.look_from(sides[i], out); }, kSideBlock);
    result.insert(result.end(), narrow.begin(), narrow.end());
  }
  return result;
}

}  // namespace meshgraft
