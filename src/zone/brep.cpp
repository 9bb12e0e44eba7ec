#include "zone/brep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/blocks.hpp"
#include "geometry/quality.hpp"
#include "zone/chains.hpp"
#include "zone/curve_edges.hpp"
#include "zone/edge_table.hpp"
#include "zone/original_faces.hpp"
#include "zone/parents.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kVertexBlock = 4096;  // vertices judged in one go
constexpr double kTurnReach = 0.1;          // share of the edge length of the parents over which a turn is measured
constexpr double kPlaneShare = 1e-9;        // of the size of a sheet: what rounding leaves of a plane
constexpr double kPulledShare = 0.01;       // of the mean edge length: how far the border may stand off the plane

/// Counts the fans (faces joined over edges that are no curve) at a vertex.
class Fans {
 public:
  Fans(const Complex& complex, const EdgeTable& edges, const CurveEdges& curves)
      : complex_(complex), edges_(edges), curves_(curves) {}

  /// `faces`: all at v, ascending.
  std::size_t count(VertexId v, std::span<const FaceId> faces) {
    seen_.assign(faces.size(), 0);
    std::size_t fans = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (seen_[i]) continue;
      ++fans;
      seen_[i] = 1;
      stack_.assign(1, i);
      while (!stack_.empty()) {
        const FaceId f = faces[stack_.back()];
        stack_.pop_back();
        spread(v, f, faces);
      }
    }
    return fans;
  }

 private:
  void spread(VertexId v, FaceId f, std::span<const FaceId> faces) {
    const auto& corner = complex_.face[f.value];
    for (std::size_t k = 0; k < 3; ++k) {
      const EdgeId e = edges_.of(f, k);
      if ((corner[k] != v && corner[(k + 1) % 3] != v) || curves_.is_curve(e)) continue;
      for (const EdgeUse& use : edges_.uses(e)) {
        const auto j = static_cast<std::size_t>(std::ranges::lower_bound(faces, use.face) - faces.begin());
        if (!seen_[j]) seen_[j] = 1, stack_.push_back(j);
      }
    }
  }

  const Complex& complex_;
  const EdgeTable& edges_;
  const CurveEdges& curves_;
  std::vector<std::uint8_t> seen_;  // by position in `faces`
  std::vector<std::size_t> stack_;
};

class Reader {
 public:
  Reader(const Complex& complex, std::span<const std::array<VertexId, 2>> junction_edges,
         std::span<const VertexId> junction_points, GroupSets& groups, const BrepOptions& options)
      : complex_(complex),
        groups_(groups),
        options_(options),
        edges_(complex),
        faces_at_(complex),
        parents_(complex),
        area_vector_(area_vectors(parents_, complex)),
        curves_(curve_edges(complex, edges_, parents_, junction_edges, options)),
        degree_(edges_, curves_, complex.n_vertices()),
        corner_(complex.n_vertices(), 0) {
    for (const VertexId v : junction_points) corner_[v.value] = 1;
    if (options.original != nullptr) originals_.emplace(*options.original);
  }

  Brep read() {
    mark_corners();
    mark_sharp_turns();
    Brep brep;
    make_curves(brep);
    make_sheets(brep);
    mark_borders(brep);
    brep.dimension.assign(complex_.n_vertices(), Dimension::kSheet);
    for (std::size_t v = 0; v < complex_.n_vertices(); ++v)
      if (corner_[v])
        brep.dimension[v] = Dimension::kCorner;
      else if (degree_.count[v] != 0)
        brep.dimension[v] = Dimension::kCurve;
    return brep;
  }

 private:
  void mark_corners() {
    for (const VertexId v : curves_.ends_of_loose_lines) corner_[v.value] = 1;
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (curves_.fixed[e])
        for (const VertexId v : edges_.ends(EdgeId(e))) corner_[v.value] = 1;
    for_blocks(
        complex_.n_vertices(),
        [&](std::size_t first, std::size_t last) {
          Fans fans(complex_, edges_, curves_);
          for (std::size_t i = first; i < last; ++i)
            if (!corner_[i] && is_corner(VertexId(i), fans)) corner_[i] = 1;
        },
        kVertexBlock);
    for (std::size_t i = 0; i < complex_.n_vertices(); ++i)  // one by one: makes group sets
      if (!corner_[i] && is_explicit(VertexId(i))) corner_[i] = 1;
  }

  [[nodiscard]] bool is_corner(VertexId v, Fans& fans) const {
    const auto faces = faces_at_[v];
    if (faces.empty() || complex_.state[v.value] != VertexState::kOpen) return true;
    const std::uint32_t degree = degree_.count[v.value];
    if (degree != 0 && !degree_.passes(v, curves_)) return true;
    // A curve that passes has one fan on each of its sides; more is a point where surfaces touch.
    const std::size_t sides = degree == 0 ? 1 : edges_.uses(degree_.around[v.value][0]).size();
    return fans.count(v, faces) != sides || bends_lines(v);
  }

  /// Whether 1D elements meet here at an angle: each is straight, so their bends are nodes.
  [[nodiscard]] bool bends_lines(VertexId v) const {
    if (degree_.count[v.value] != 2) return false;
    const auto& [e, f] = degree_.around[v.value];
    if (curves_.lines_of(e).empty()) return false;
    const auto far = [&](EdgeId edge) {
      const auto [a, b] = edges_.ends(edge);
      return complex_.position[(a == v ? b : a).value];
    };
    const Vec3 at = complex_.position[v.value], in = at - far(e), out = far(f) - at;
    return std::atan2(norm(cross(in, out)), dot(in, out)) > options_.line_turn_angle;
  }

  /// Whether a node group names this vertex for its own sake (see read_brep).
  bool is_explicit(VertexId v) {
    if (complex_.vertex_groups[v.value] == GroupSets::kEmpty) return false;
    return std::ranges::any_of(faces_at_[v], [&](FaceId f) { return is_explicit(v, complex_.component[f.value]); });
  }

  bool is_explicit(VertexId v, std::uint32_t component) {
    const auto groups = [&](VertexId w) { return complex_.groups_on(component, w); };
    const GroupSetId all = groups(v);
    GroupSetId around = all;
    std::vector<std::pair<GroupSetId, GroupSetId>> areas;  // element groups of faces, node groups all over those
    for (const FaceId f : faces_at_[v]) {
      if (complex_.component[f.value] != component) continue;
      const GroupSetId key = complex_.face_groups[f.value];
      auto area = std::ranges::find(areas, key, &std::pair<GroupSetId, GroupSetId>::first);
      if (area == areas.end()) area = areas.insert(areas.end(), {key, all});
      for (const VertexId w : complex_.face[f.value]) area->second = groups_.intersect(area->second, groups(w));
      around = groups_.intersect(around, area->second);
    }
    if (around == all) return false;
    if (degree_.count[v.value] != 2) return true;
    GroupSetId line = all;
    bool feature = true;
    for (const EdgeId e : degree_.around[v.value]) {
      for (const VertexId w : edges_.ends(e)) line = groups_.intersect(line, groups(w));
      feature = feature && is_feature(e, component);
    }
    if (feature) return groups_.unite(around, line) != all;
    for (const auto& [key, area] : areas) around = groups_.unite(around, groups_.intersect(line, area));
    return around != all;
  }

  /// Whether the edge is free, branching or sharp in the mesh of the component.
  [[nodiscard]] bool is_feature(EdgeId e, std::uint32_t component) const {
    std::vector<std::uint32_t> parents;
    for (const EdgeUse& use : edges_.uses(e))
      if (complex_.component[use.face.value] == component) parents.push_back(parents_.of_face[use.face.value]);
    if (parents.size() != 2) return true;
    const Vec3 m = area_vector_[parents[0]], n = area_vector_[parents[1]];
    return std::atan2(norm(cross(m, n)), dot(m, n)) > options_.sharp_angle;
  }

  /// Of the parent of a face.
  [[nodiscard]] double input_edge_length(FaceId f) const {
    const FaceId parent = originals_ ? originals_->find(complex_.parent[f.value]) : FaceId();
    return edge_length_of_area(parent.valid() ? area(options_.original->corners(parent))
                                              : norm(area_vector_[parents_.of_face[f.value]]));
  }

  void mark_sharp_turns() {
    std::vector<double> reach(complex_.n_vertices(), 0);
    for (std::size_t v = 0; v < reach.size(); ++v) {
      if (degree_.count[v] != 2) continue;
      double least = std::numeric_limits<double>::infinity();
      for (const FaceId f : faces_at_[VertexId(v)]) least = std::min(least, input_edge_length(f));
      reach[v] = kTurnReach * least;
    }
    for (const Chain& chain : chains(edges_, curves_, degree_, corner_))
      for (const VertexId v : sharp_turns(chain, complex_.position, reach, options_.turn_angle)) corner_[v.value] = 1;
  }

  void make_curves(Brep& brep) const {
    brep.curve_of_edge.assign(complex_.n_faces(), {});
    for (Chain& chain : chains(edges_, curves_, degree_, corner_)) {
      const EdgeId first = chain.edges.front();
      Curve curve;
      curve.closed = chain.closed;
      curve.junction = curves_.junction[first.value] != 0;
      curve.fixed = curves_.fixed[first.value] != 0;
      curve.free = edges_.uses(first).size() == 1;
      curve.lines_per_edge = static_cast<std::uint32_t>(curves_.lines_of(first).size());
      const CurveId id(brep.curves.size());
      for (const EdgeId e : chain.edges) {
        const auto lines = curves_.lines_of(e);
        curve.lines.insert(curve.lines.end(), lines.begin(), lines.end());
        for (const EdgeUse& use : edges_.uses(e)) brep.curve_of_edge[use.face.value][use.corner] = id;
      }
      curve.chain = std::move(chain.vertices);
      brep.curves.push_back(std::move(curve));
    }
  }

  void make_sheets(Brep& brep) const {
    brep.sheet_of_face.assign(complex_.n_faces(), {});
    for (std::size_t i = 0; i < complex_.n_faces(); ++i) {
      if (!brep.sheet_of_face[i].valid()) {
        spread_sheet(FaceId(i), SheetId(brep.sheets.size()), brep.sheet_of_face);
        brep.sheets.emplace_back();
      }
      brep.sheets[brep.sheet_of_face[i].value].faces.emplace_back(i);
    }
    for_blocks(
        brep.sheets.size(),
        [&](std::size_t first, std::size_t last) {
          for (std::size_t s = first; s < last; ++s) find_plane(brep.sheets[s]);
        },
        1);
  }

  /// Gives a face and all that hang together with it without a curve between to a sheet.
  void spread_sheet(FaceId start, SheetId sheet, std::vector<SheetId>& sheet_of_face) const {
    std::vector<FaceId> reached{start};
    sheet_of_face[start.value] = sheet;
    while (!reached.empty()) {
      const FaceId f = reached.back();
      reached.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const EdgeId e = edges_.of(f, k);
        if (curves_.is_curve(e)) continue;
        for (const EdgeUse& use : edges_.uses(e)) {
          if (sheet_of_face[use.face.value].valid()) continue;
          sheet_of_face[use.face.value] = sheet;
          reached.push_back(use.face);
        }
      }
    }
  }

  void mark_borders(Brep& brep) const {
    for (Curve& curve : brep.curves) {
      curve.border = true;
      for (std::size_t i = 1; i < curve.chain.size() && curve.border; ++i)
        curve.border = is_border(brep, edges_.find(curve.chain[i - 1], curve.chain[i]));
    }
  }

  [[nodiscard]] bool is_border(const Brep& brep, EdgeId e) const {
    const auto uses = edges_.uses(e);
    const auto sheet = [&](std::size_t i) -> const Sheet& {
      return brep.sheets[brep.sheet_of_face[uses[i].face.value].value];
    };
    if (uses.size() > 2 || !sheet(0).planar || !sheet(uses.size() - 1).planar) return false;
    const Vec3 m = sheet(0).normal, n = sheet(uses.size() - 1).normal;
    return std::atan2(norm(cross(m, n)), std::abs(dot(m, n))) <= options_.sharp_angle;  // however they are oriented
  }

  [[nodiscard]] bool is_inside(VertexId v) const { return corner_[v.value] == 0 && degree_.count[v.value] == 0; }

  /// Vertices that were pulled onto another mesh do not make a plane sheet a curved one: the plane is
  /// that of the vertices inside, and those on the border may stand off it a little.
  void find_plane(Sheet& sheet) const {
    Box box;
    Vec3 sum, sum_inside;
    double edge = 0;
    for (const FaceId f : sheet.faces) {
      const Triangle t = complex_.corners(f);
      sum += area_vector(t);
      if (std::ranges::all_of(complex_.face[f.value], [&](VertexId v) { return is_inside(v); }))
        sum_inside += area_vector(t);
      edge += mean_edge_length(t) / static_cast<double>(sheet.faces.size());
      for (const Vec3 p : t) box.add(p);
    }
    const bool has_inside = squared_norm(sum_inside) > 0;
    const Vec3 normal = normalized(has_inside ? sum_inside : sum), origin = midpoint(box.low, box.high);
    constexpr double kFar = std::numeric_limits<double>::infinity();
    std::array<double, 2> low{kFar, kFar}, high{-kFar, -kFar};  // of all vertices; of those that tell the plane
    for (const FaceId f : sheet.faces)
      for (const VertexId v : complex_.face[f.value]) {
        const double height = dot(normal, complex_.position[v.value] - origin);
        for (const std::size_t k : {0u, 1u})
          if (k == 0 || !has_inside || is_inside(v))
            low[k] = std::min(low[k], height), high[k] = std::max(high[k], height);
      }
    sheet.planar = squared_norm(normal) > 0 && high[1] - low[1] <= 2 * kPlaneShare * box.diagonal() &&
                   high[0] - low[0] <= kPulledShare * edge;
    if (sheet.planar) sheet.normal = normal, sheet.origin = origin + 0.5 * (low[1] + high[1]) * normal;
  }

  const Complex& complex_;
  GroupSets& groups_;
  const BrepOptions& options_;
  EdgeTable edges_;
  VertexFaces faces_at_;
  Parents parents_;
  std::vector<Vec3> area_vector_;  // by parent
  CurveEdges curves_;
  CurveDegree degree_;
  std::vector<std::uint8_t> corner_;  // by vertex
  std::optional<OriginalFaces> originals_;
};

}  // namespace

Brep read_brep(const Complex& complex, std::span<const std::array<VertexId, 2>> junction_edges,
               std::span<const VertexId> junction_points, GroupSets& groups, const BrepOptions& options) {
  return Reader(complex, junction_edges, junction_points, groups, options).read();
}

}  // namespace meshgraft
