#include "intersect/whole_edges.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "geometry/closest.hpp"
#include "geometry/plane.hpp"
#include "geometry/quality.hpp"
#include "intersect/polygon.hpp"

namespace meshgraft {
namespace {

using Corners = std::array<VertexId, 3>;

class PointRemover {
 public:
  PointRemover(Complex& complex, FaceMarks& marks, const std::vector<CutEdge>& edges, const UncutFaces& before)
      : complex_(complex), marks_(marks), edges_(edges), before_(before) {
    std::vector<std::uint8_t> may_go(complex.n_vertices());
    for (std::uint32_t e = 0; e < edges.size(); ++e)
      for (std::size_t i = 0; i < edges[e].chain.size(); ++i) {
        edges_at_[edges[e].chain[i]].push_back(e);
        if (edges[e].may_go[i]) may_go[edges[e].chain[i].value] = 1;
      }
    for (std::uint32_t f = 0; f < complex.n_faces(); ++f) {
      pieces_.push_back({complex.face[f], f});
      for (const VertexId v : complex.face[f])
        if (may_go[v.value]) at_[v].push_back(f);
    }
  }

  std::vector<Corefined::Traded> run() {
    bool any = false;
    for (const CutEdge& edge : edges_) {
      VertexId before = edge.chain.front();
      for (std::size_t i = 1; i + 1 < edge.chain.size(); ++i) {
        const VertexId v = edge.chain[i];
        if (edge.may_go[i] && take_out(v, before, edge.chain[i + 1]))
          any = true;
        else
          before = v;
      }
    }
    if (any) rebuild();
    std::vector<Corefined::Traded> all;
    for (const auto& [parent, area] : traded_) all.push_back({parent, area});
    return all;
  }

 private:
  struct Piece {
    Corners corners;
    std::uint32_t of = 0;  // face
    bool is_gone = false;
  };

  /// The faces on one side of an edge at a point of it, and the polygon around them without the point.
  struct Fan {
    std::vector<std::uint32_t> pieces;
    std::vector<VertexId> polygon;  // counter-clockwise as the first face sees it
  };

  [[nodiscard]] Vec3 at(VertexId v) const { return complex_.position[v.value]; }
  [[nodiscard]] Triangle triangle(const Corners& v) const { return {at(v[0]), at(v[1]), at(v[2])}; }

  /// The two corners after v, in the order of the face.
  [[nodiscard]] std::array<VertexId, 2> others(std::uint32_t piece, VertexId v) const {
    const Corners& c = pieces_[piece].corners;
    const auto k = static_cast<std::size_t>(std::ranges::find(c, v) - c.begin());
    return {c[(k + 1) % 3], c[(k + 2) % 3]};
  }

  /// From face to face around v until `last`; nothing if it ends before, branches or turns over.
  [[nodiscard]] std::optional<Fan> fan(std::uint32_t start, VertexId v, VertexId first, VertexId last) const {
    Fan fan{{start}, {first}};
    const bool forward = others(start, v)[0] == first;  // the corner that comes next is the second
    const std::size_t in = forward ? 0 : 1;
    VertexId now = others(start, v)[1 - in];
    while (now != last) {
      fan.polygon.push_back(now);
      std::uint32_t next = kNowhere;
      for (const std::uint32_t p : at_.at(v)) {
        const auto o = others(p, v);
        if (p == fan.pieces.back() || (o[0] != now && o[1] != now)) continue;
        if (next != kNowhere || o[in] != now) return std::nullopt;
        next = p;
      }
      if (next == kNowhere || fan.pieces.size() > at_.at(v).size()) return std::nullopt;
      fan.pieces.push_back(next);
      now = others(next, v)[1 - in];
    }
    fan.polygon.push_back(last);
    if (!forward) std::ranges::reverse(fan.polygon);
    return fan;
  }

  /// Corners of one edge that was cut are on one line, whatever their coordinates.
  [[nodiscard]] std::vector<std::uint32_t> lines(const std::vector<VertexId>& polygon) const {
    std::map<std::uint32_t, std::vector<std::size_t>> on;
    for (std::size_t i = 0; i < polygon.size(); ++i)
      if (const auto edges = edges_at_.find(polygon[i]); edges != edges_at_.end())
        for (const std::uint32_t e : edges->second) on[e].push_back(i);
    std::vector<std::uint32_t> bits(polygon.size(), 0);
    std::uint32_t bit = 1;
    for (const auto& [edge, corners] : on) {
      if (corners.size() < 3) continue;
      for (const std::size_t i : corners) bits[i] |= bit;
      bit <<= 1;
    }
    return bits;
  }

  [[nodiscard]] std::optional<std::vector<Piece>> filled(const Fan& fan) const {
    Vec3 normal;
    for (const std::uint32_t p : fan.pieces) normal += area_vector(triangle(pieces_[p].corners));
    const Plane to_plane(normal);
    const std::vector<std::uint32_t> bits = lines(fan.polygon);
    std::vector<PolygonCorner> corners;
    for (std::size_t i = 0; i < fan.polygon.size(); ++i)
      corners.push_back({to_plane(at(fan.polygon[i])), fan.polygon[i].value, bits[i]});
    const auto triangles = triangulated(corners);
    if (!triangles) return std::nullopt;
    std::vector<Piece> filled;
    for (const auto& [a, b, c] : *triangles) {
      const Corners v{fan.polygon[a], fan.polygon[b], fan.polygon[c]};
      filled.push_back({v, face_beneath(centroid(triangle(v)), fan)});
    }
    return filled;
  }

  [[nodiscard]] std::uint32_t face_beneath(Vec3 p, const Fan& fan) const {
    std::uint32_t face = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t piece : fan.pieces) {
      const double d = squared_norm(p - closest_on_triangle(p, triangle(pieces_[piece].corners)).point);
      if (d < nearest) nearest = d, face = pieces_[piece].of;
    }
    return face;
  }

  bool take_out(VertexId v, VertexId before, VertexId after) {
    const auto found = at_.find(v);
    if (found == at_.end()) return false;
    std::vector<std::uint32_t> around = found->second;
    std::vector<Piece> now;
    std::size_t n = 0;
    for (const std::uint32_t p : around) {
      const auto o = others(p, v);
      if (o[0] != before && o[1] != before) continue;
      const auto side = fan(p, v, before, after);
      const auto pieces = side ? filled(*side) : std::nullopt;
      if (!pieces) return false;
      now.insert(now.end(), pieces->begin(), pieces->end());
      n += side->pieces.size();
    }
    if (n != around.size() || !join_lines(v, before, after)) return false;
    note_trade(around, now);
    for (const std::uint32_t p : around) {
      pieces_[p].is_gone = true;
      for (const VertexId w : pieces_[p].corners)
        if (const auto at = at_.find(w); at != at_.end()) std::erase(at->second, p);
    }
    for (const Piece& p : now) {
      const auto id = static_cast<std::uint32_t>(pieces_.size());
      pieces_.push_back(p);
      for (const VertexId w : p.corners)
        if (const auto at = at_.find(w); at != at_.end()) at->second.push_back(id);
    }
    return true;
  }

  void note_trade(const std::vector<std::uint32_t>& gone, const std::vector<Piece>& now) {
    const auto parent = [&](const Piece& p) { return complex_.parent[p.of]; };
    const ElementRef first = parent(pieces_[gone.front()]);
    if (std::ranges::all_of(gone, [&](std::uint32_t p) { return parent(pieces_[p]) == first; })) return;
    for (const std::uint32_t p : gone) traded_[parent(pieces_[p])] -= area(triangle(pieces_[p].corners));
    for (const Piece& p : now) traded_[parent(p)] += area(triangle(p.corners));
  }

  /// Lines that end at v must be the two halves of lines along the edge.
  bool join_lines(VertexId v, VertexId before, VertexId after) {
    std::vector<Complex::Line> lines;
    for (const Complex::Line& line : complex_.lines) {
      if (line.ends[0] != v && line.ends[1] != v) {
        lines.push_back(line);
        continue;
      }
      const bool is_second = !lines.empty() && lines.back().parent == line.parent && lines.back().ends[1] == v;
      if (is_second) {
        lines.back().ends[1] = line.ends[1];
        continue;
      }
      if (line.ends[1] != v || (line.ends[0] != before && line.ends[0] != after)) return false;
      lines.push_back(line);
    }
    const auto ends_here = [&](const Complex::Line& l) { return l.ends[0] == v || l.ends[1] == v; };
    if (std::ranges::any_of(lines, ends_here)) return false;
    complex_.lines = std::move(lines);
    return true;
  }

  void rebuild() {
    std::erase_if(pieces_, [](const Piece& p) { return p.is_gone; });
    std::ranges::stable_sort(pieces_, {}, &Piece::of);
    std::vector<std::uint32_t> n_of(before_.corners.size());
    for (const Piece& p : pieces_) ++n_of[marks_.from[p.of].value];
    Complex old;
    complex_.swap_faces(old);
    FaceMarks marks;
    for (const Piece& p : pieces_) {
      const std::uint32_t from = marks_.from[p.of].value;
      const bool is_whole = n_of[from] == 1 && std::ranges::is_permutation(p.corners, before_.corners[from]);
      complex_.add_face(is_whole ? before_.corners[from] : p.corners, old, FaceId(std::size_t{p.of}));
      marks.add(marks_, p.of);
      if (is_whole) marks.touched.back() = before_.touched[from];
    }
    marks_ = std::move(marks);
  }

  Complex& complex_;
  FaceMarks& marks_;
  const std::vector<CutEdge>& edges_;
  const UncutFaces& before_;
  std::vector<Piece> pieces_;
  std::map<VertexId, std::vector<std::uint32_t>> at_;        // pieces at points that may go
  std::map<VertexId, std::vector<std::uint32_t>> edges_at_;  // edges that a vertex is on
  std::map<ElementRef, double> traded_;                      // as in Corefined
};

}  // namespace

std::vector<Corefined::Traded> take_out_points(Complex& complex, FaceMarks& marks, const std::vector<CutEdge>& edges,
                                               const UncutFaces& before) {
  if (edges.empty()) return {};
  return PointRemover(complex, marks, edges, before).run();
}

}  // namespace meshgraft
