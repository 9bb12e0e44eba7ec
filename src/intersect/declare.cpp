// Incidences within the snap length, decided in order of dimension. What is declared here is never
// asked of coordinates again.
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "geometry/closest.hpp"
#include "intersect/meeting.hpp"
#include "intersect/no_gap.hpp"
#include "intersect/seams.hpp"

namespace meshgraft {
namespace {

constexpr double kSideways = 0.5;  // sine of the angle by which the way across a gap may lean

Carrier vertex(VertexId v) { return {Carrier::kVertex, v.value, 0}; }

/// A gap is closed across it, not along a surface: things that lie beside each other on one surface
/// stay apart unless both are features, and vertices unless they end there. True if the way from `at`, which is on
/// `faces` of side s, to `q`, `gap` away, leaves their planes; how far they reach does not count, as slivers end beside
/// every way.
bool is_straight_across(const Meeting& m, std::size_t s, std::span<const LocalFace> faces, Vec3 at, Vec3 q,
                        double gap) {
  const Vec3 way = q - at;
  return std::all_of(faces.begin(), faces.end(), [&](LocalFace f) {
    const Vec3 n = unit_normal(m.triangle(s, f));
    return norm(way - dot(n, way) * n) <= kSideways * gap;
  });
}

/// A vertex of side 1 becomes a vertex of side 0. Ordered by distance, so that the nearest win.
struct VertexPair {
  double distance = 0;
  VertexId x, y;
  friend auto operator<=>(const VertexPair&, const VertexPair&) = default;
};

std::vector<VertexPair> near_vertices(const Meeting& m) {
  std::vector<VertexPair> found;
  for (const FacePair& p : m.pairs) {
    const Snap snap = m.snap(p);
    for (const VertexId y : m.side[1].corners(p[1])) {
      if (m.has_symbol(1, y) || m.complex.state[y.value] == VertexState::kFrozen) continue;
      for (const VertexId x : m.side[0].corners(p[0])) {
        const bool fx = m.ending.vertex[0][x.value] != 0, fy = m.ending.vertex[1][y.value] != 0;
        const double d = distance(m.at(x), m.at(y));
        const double near = std::max({snap.weld, m.seams_of.vertex[0][x.value], m.seams_of.vertex[1][y.value]});
        if (d > std::max(near, snap.of(fx || fy))) continue;
        if (d > near && !fx && !is_straight_across(m, 0, m.side[0].faces_at(x), m.at(x), m.at(y), d)) continue;
        if (d > near && !fy && !is_straight_across(m, 1, m.side[1].faces_at(y), m.at(y), m.at(x), d)) continue;
        found.push_back({d, x, y});
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// Several vertices of side 1 may become one of side 0 (open seams), but not two ends of an edge.
bool would_collapse(const Meeting& m, VertexId x, VertexId y) {
  for (const Symbol& s : m.symbols)
    if (s.vertex == x && s.on[1].kind == Carrier::kVertex &&
        m.side[1].find(VertexId(std::size_t{s.on[1].id}), y) != kNowhere)
      return true;
  return false;
}

void replace(Meeting& m, VertexId x, VertexId y) {
  m.add({x, {vertex(x), vertex(y)}});
  m.replaced.push_back({y, x});
  m.join_groups(x, 1, vertex(y));
  m.complex.state[x.value] = std::max(m.complex.state[x.value], m.complex.state[y.value]);
}

/// Where two vertices on free edges of side 1 become one.
void note_seam(Meeting& m, VertexId x, VertexId y) {
  const Side& side = m.side[1];
  for (const LocalFace f : side.faces_at(y))
    for (const LocalEdge e : side.edges(f)) {
      const auto& [a, b] = side.ends(e);
      if (!side.is_free(e) || (a != y && b != y)) continue;
      m.seams.push_back({m.complex.parent[side.face(f).value], m.at(x)});
      return;
    }
}

/// Vertex y of side 1 becomes x of side 0, and is where that is, if it may.
bool becomes(Meeting& m, VertexId x, VertexId y) {
  if (m.has_symbol(1, y) || m.complex.state[y.value] == VertexState::kFrozen) return false;
  const bool is_taken = m.has_symbol(0, x);
  if (is_taken && would_collapse(m, x, y)) return false;
  m.has_closed_gap |= distance(m.at(x), m.at(y)) > m.rule.noise();
  replace(m, x, y);
  if (is_taken) note_seam(m, x, y);
  m.complex.position[y.value] = m.at(x);
  return true;
}

void declare_vertex_on_vertex(Meeting& m, Seams& seams) {
  for (const auto& [d, near, y] : near_vertices(m)) {
    if (m.has_symbol(1, y)) continue;
    const auto crossing =
        m.has_symbol(0, near) ? std::nullopt : seams.find_crossing(m.at(near), {vertex(near), vertex(y)});
    becomes(m, crossing ? m.symbols[*crossing].vertex : near, y);
  }
}

/// A vertex of one side near an edge or a face of the other.
struct Landing {
  VertexId vertex;
  double distance = 0;
  std::uint32_t on = 0;  // LocalEdge or LocalFace of the other side
  double t = 0;          // on an edge
  Vec3 point;
  bool is_gap = false;   // farther away than the weld length
  VertexId beside;       // of the other side, if it lands beside one
  bool is_at = false;    // nearer to that than the weld length
  bool on_line = false;  // of side 1, which moves: on an edge that is one of a line of the mesh
};

/// Lands it beside the nearest of `vertices`, those of what it lands on, if that is near. What is there takes the
/// vertex as a whole: else the edges and faces at the vertex meet it again, about as near as the weld length, where
/// some of these meetings would be declared and others not.
Landing landed(Landing l, const Meeting& m, std::span<const VertexId> vertices, double weld) {
  constexpr double kBeside = 10;  // weld lengths: what meets at more than a tenth does so farther away
  const auto distance_of = [&](VertexId v) { return distance(m.at(v), l.point); };
  const VertexId nearest = *std::ranges::min_element(vertices, {}, distance_of);
  if (distance_of(nearest) <= kBeside * weld) l.beside = nearest;
  l.is_at = distance_of(nearest) <= weld;
  return l;
}

/// The nearest landing of each vertex, ties by id, the nearest first; `found` in any order. Across a gap, a line in
/// reach comes before mere edges: where those are is chance.
std::vector<Landing> nearest_of_each(std::vector<Landing> found) {
  std::sort(found.begin(), found.end(), [](const Landing& a, const Landing& b) {
    return std::tie(a.vertex, a.is_gap, b.on_line, a.distance, a.on) <
           std::tie(b.vertex, b.is_gap, a.on_line, b.distance, b.on);
  });
  const auto same = [](const Landing& a, const Landing& b) { return a.vertex == b.vertex; };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  std::sort(found.begin(), found.end(), [](const Landing& a, const Landing& b) {
    return std::tie(a.distance, a.vertex) < std::tie(b.distance, b.vertex);
  });
  return found;
}

/// A vertex that may still be declared to lie on the other side.
bool is_undecided(const Meeting& m, std::size_t s, VertexId v) {
  return !m.has_symbol(s, v) && (s == 0 || m.complex.state[v.value] != VertexState::kFrozen);
}

/// A free edge of side 1 with both ends on side 0: it has been extended there, and what it runs along and curves up
/// between the ends is met in the surface that the edge is extended along, that of its one face.
bool is_chord(const Meeting& m, LocalEdge f) {
  return m.side[1].is_free(f) && m.ending.edge[1][f] != 0 &&
         std::ranges::all_of(m.side[1].ends(f), [&](VertexId v) { return m.has_symbol(1, v); });
}

bool is_in_surface_of(const Meeting& m, Vec3 p, LocalEdge chord, double weld) {
  const Triangle face = m.triangle(1, m.side[1].faces_at_edge(chord).front());
  return std::abs(dot(unit_normal(face), p - face[0])) <= weld;
}

/// How far a point in the surface that a chord was extended along is from it, where it is or where it was before: that
/// draws its ends to the other side, and its middle away from what curves up between them.
double distance_from_chord(const Meeting& m, Vec3 p, LocalEdge chord) {
  const auto& [a, b] = m.side[1].ends(chord);
  const auto to = [&](Vec3 from, Vec3 end) { return distance(p, closest_on_segment(p, from, end).point); };
  return std::min(to(m.at(a), m.at(b)), to(m.at_first(a), m.at_first(b)));
}

/// Whether the chord f is met in v of side 0, `on_f` next to it: beneath or above it on a face there, and in the
/// surface that f is extended along. Another mesh that ends in v may do so sideways.
bool is_met_in(const Meeting& m, LocalEdge f, VertexId v, Vec3 on_f, double gap) {
  if (!is_chord(m, f)) return false;
  const Vec3 n = unit_normal(m.triangle(1, m.side[1].faces_at_edge(f).front()));
  return std::abs(dot(n, m.at(v) - on_f)) <= kSideways * gap &&
         std::ranges::any_of(m.side[0].faces_at(v), [&](LocalFace g) {
           return is_straight_across(m, 0, std::span(&g, 1), m.at(v), on_f, gap);
         });
}

std::vector<Landing> landings_on_edges(const Meeting& m, std::size_t s) {
  const Side& other = m.side[1 - s];
  std::vector<Landing> found;
  for (const FacePair& p : m.pairs) {
    const Snap snap = m.snap(p);
    for (const VertexId v : m.side[s].corners(p[s])) {
      if (!is_undecided(m, s, v)) continue;
      for (const LocalEdge e : other.edges(p[1 - s])) {
        const auto& [low, high] = other.ends(e);
        const double near = std::max({snap.weld, m.seams_of.vertex[s][v.value], m.seams_of.edge[1 - s][e]});
        const double gap = std::max(near, snap.of(m.ending.vertex[s][v.value] != 0 || m.ending.edge[1 - s][e] != 0));
        const bool beside_chord = s == 0 && is_chord(m, e) && is_in_surface_of(m, m.at(v), e, snap.weld);
        if (!beside_chord && are_apart(m.at(v), m.at(v), m.at(low), m.at(high), gap)) continue;
        const SegmentPoint c = closest_on_segment(m.at(v), m.at(low), m.at(high));
        const double d = distance(m.at(v), c.point);
        if (c.t <= 0 || c.t >= 1 || (beside_chord ? distance_from_chord(m, m.at(v), e) : d) > gap) continue;
        if (d > near && !other.is_line_edge(e) &&
            !is_straight_across(m, 1 - s, other.faces_at_edge(e), c.point, m.at(v), d))
          continue;
        if (d > near && m.ending.vertex[s][v.value] == 0 &&
            !is_straight_across(m, s, m.side[s].faces_at(v), m.at(v), c.point, d) &&
            !(s == 0 && is_met_in(m, e, v, c.point, d)))
          continue;
        found.push_back(landed({v, d, e, c.t, c.point, d > snap.weld, {}, false, s == 1 && other.is_line_edge(e)}, m,
                               other.ends(e), snap.weld));
      }
    }
  }
  return nearest_of_each(std::move(found));
}

std::vector<Landing> landings_on_faces(const Meeting& m, std::size_t s) {
  std::vector<Landing> found;
  for (const FacePair& p : m.pairs) {
    const Snap snap = m.snap(p);
    for (const VertexId v : m.side[s].corners(p[s])) {
      if (!is_undecided(m, s, v)) continue;
      const double gap = std::max(m.seams_of.vertex[s][v.value], snap.of(m.ending.vertex[s][v.value] != 0));
      const Triangle t = m.triangle(1 - s, p[1 - s]);
      const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
      if (std::abs(dot(n, m.at(v) - t[0])) > gap * norm(n)) continue;
      const TrianglePoint c = closest_on_triangle(m.at(v), t);
      const double d = distance(m.at(v), c.point);
      if (c.weight[0] > 0 && c.weight[1] > 0 && c.weight[2] > 0 && d <= gap)
        found.push_back(landed({v, d, p[1 - s], 0, c.point, d > snap.weld, {}, false, false}, m,
                               m.side[1 - s].corners(p[1 - s]), snap.weld));
    }
  }
  return nearest_of_each(std::move(found));
}

/// Vertices of side 1 move to where they land; those of side 0 stay, and side 1 bends to them.
void land(Meeting& m, Seams& seams, std::size_t s, const std::vector<Landing>& landings, Carrier::Kind kind) {
  for (const Landing& l : landings) {
    Symbol symbol{l.vertex, {}};
    symbol.on[s] = vertex(l.vertex);
    symbol.on[1 - s] = {kind, l.on, l.t};
    const bool is_border = m.ends_on_borders && s == 0 && kind == Carrier::kEdge;
    if (l.is_gap && !is_border && would_flatten(m, s, l.vertex, symbol.on[1 - s])) continue;
    if (l.is_gap && kind == Carrier::kEdge &&
        (have_met(m, s, l.vertex, l.on) || is_beyond_own_face(m, s, l.vertex, l.on)))
      continue;
    if (l.beside.valid() && becomes(m, s == 0 ? l.vertex : l.beside, s == 0 ? l.beside : l.vertex)) continue;
    if (l.is_at) continue;  // the two would be in one place
    auto other = seams.find(s, symbol.on[s], symbol.on[1 - s], l.point);
    if (!other) other = seams.find_crossing(l.point, symbol.on);
    if (other && seams.close(s, l.vertex, *other)) continue;
    m.has_closed_gap |= l.is_gap;
    m.add(symbol);
    m.join_groups(l.vertex, 1 - s, symbol.on[1 - s]);
    if (s == 0 || l.distance <= m.rule.noise()) continue;
    m.moved.emplace_back(l.vertex, m.at(l.vertex));
    m.complex.position[l.vertex.value] = l.point;
  }
}

struct EdgePair {
  std::array<LocalEdge, 2> edge;
  std::array<double, 2> t;
  Vec3 point;  // on the edge of side 0
  double distance = 0;
  bool is_gap = false;  // farther apart than what is one place there
  bool bends = false;   // farther apart than the weld length
};

/// Whether edge f of side 1 runs along a face at edge e of side 0.
bool runs_along(const Meeting& m, LocalEdge f, LocalEdge e) {
  const auto& [a, b] = m.side[1].ends(f);
  const Vec3 along = m.at(b) - m.at(a);
  return std::ranges::any_of(m.side[0].faces_at_edge(e), [&](LocalFace g) {
    return std::abs(dot(along, unit_normal(m.triangle(0, g)))) <= kAlong * norm(along);
  });
}

/// Where edge e of side 0 meets the plane of the face at the chord f, if that is within the gap of f. `undecided`: it
/// ends in the plane.
std::optional<EdgePair> chord_crossing(const Meeting& m, LocalEdge e, LocalEdge f, const Snap& snap, bool& undecided) {
  const auto& [a, b] = m.side[0].ends(e);
  const auto& [c, d] = m.side[1].ends(f);
  const Triangle face = m.triangle(1, m.side[1].faces_at_edge(f).front());
  const Vec3 n = unit_normal(face);
  const double at_a = dot(n, m.at(a) - face[0]), at_b = dot(n, m.at(b) - face[0]);
  undecided = std::min(std::abs(at_a), std::abs(at_b)) <= snap.weld;
  if (undecided || (at_a > 0) == (at_b > 0)) return std::nullopt;
  const double t = at_a / (at_a - at_b);
  const Vec3 at = lerp(m.at(a), m.at(b), t);
  const SegmentPoint on_f = closest_on_segment(at, m.at(c), m.at(d));
  const double apart = distance(at, on_f.point);
  // What is beside an end of the chord passes that, not the chord, whichever side rounding puts it on.
  const bool at_end = std::min(distance(on_f.point, m.at(c)), distance(on_f.point, m.at(d))) <= snap.weld;
  if (at_end || distance_from_chord(m, at, f) > snap.feature || m.share_end(e, f)) return std::nullopt;
  return EdgePair{{e, f}, {t, on_f.t}, at, apart, apart > snap.weld, apart > snap.weld};
}

/// The nearest first.
std::vector<EdgePair> passing_edges(const Meeting& m) {
  std::vector<EdgePair> found;
  std::vector<std::uint8_t> chord;  // by edge of side 1
  for (LocalEdge f = 0; f < m.side[1].n_edges(); ++f) chord.push_back(is_chord(m, f) ? 1 : 0);
  for (const FacePair& p : m.pairs) {
    const Snap snap = m.snap(p);
    for (const LocalEdge e : m.side[0].edges(p[0]))
      for (const LocalEdge f : m.side[1].edges(p[1])) {
        const auto& [a, b] = m.side[0].ends(e);
        const auto& [c, d] = m.side[1].ends(f);
        const bool both = m.side[0].is_feature_edge(e) && m.side[1].is_feature_edge(f);
        const double close = std::max({snap.weld, m.seams_of.edge[0][e], m.seams_of.edge[1][f]});
        const double gap = std::max(close, snap.of(both || m.ending.edge[0][e] != 0 || m.ending.edge[1][f] != 0));
        if (bool undecided = false; chord[f] != 0 && runs_along(m, f, e)) {
          if (const auto crossing = chord_crossing(m, e, f, snap, undecided)) found.push_back(*crossing);
          if (!undecided) continue;
        }
        if (are_apart(m.at(a), m.at(b), m.at(c), m.at(d), gap)) continue;
        const SegmentPair near = closest_between_segments(m.at(a), m.at(b), m.at(c), m.at(d));
        const bool inside = near.first.t > 0 && near.first.t < 1 && near.second.t > 0 && near.second.t < 1;
        const double apart = distance(near.first.point, near.second.point);
        if (!inside || apart > gap || m.share_end(e, f)) continue;
        const bool is_gap = apart > close;
        const Vec3 on_e = near.first.point, on_f = near.second.point;
        // At an end that did not become what it is beside: the two would be in one place.
        if (std::min({distance(on_e, m.at(a)), distance(on_e, m.at(b)), distance(on_f, m.at(c)),
                      distance(on_f, m.at(d))}) <= snap.weld)
          continue;
        if (is_gap && !m.side[0].is_line_edge(e) &&
            !is_straight_across(m, 0, m.side[0].faces_at_edge(e), on_e, on_f, apart))
          continue;
        if (is_gap && !m.side[1].is_line_edge(f) &&
            !is_straight_across(m, 1, m.side[1].faces_at_edge(f), on_f, on_e, apart))
          continue;
        found.push_back({{e, f}, {near.first.t, near.second.t}, on_e, apart, is_gap, apart > snap.weld});
      }
  }
  std::sort(found.begin(), found.end(), [](const EdgePair& a, const EdgePair& b) {
    return std::tie(a.distance, a.edge) < std::tie(b.distance, b.edge);
  });
  const auto same = [](const EdgePair& a, const EdgePair& b) { return a.edge == b.edge; };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  return found;
}

/// A straight edge meets a face once, unless it runs along it. An edge steep to a face, with a symbol
/// on it already, has no second one a tolerance away on a side of that face.
bool is_doubtful(const Meeting& m, const EdgePair& p) {
  constexpr double kSteep = 0.3;  // sine of the angle from which an edge does not run along a face
  for (const std::size_t s : kSides) {
    const auto& [a, b] = m.side[s].ends(p.edge[s]);
    const Vec3 along = normalized(m.at(b) - m.at(a));
    for (const LocalFace f : m.side[1 - s].faces_at_edge(p.edge[1 - s]))
      if (std::abs(dot(along, unit_normal(m.triangle(1 - s, f)))) > kSteep && m.meet(s, p.edge[s], f)) return true;
  }
  return false;
}

}  // namespace

void declare_shared(Meeting& m) {
  for (std::size_t i = 0; i < m.symbol_of[0].size(); ++i)
    if (const VertexId v(i); !m.side[0].faces_at(v).empty() && !m.side[1].faces_at(v).empty())
      m.add({v, {vertex(v), vertex(v)}});
}

void declare_vertices(Meeting& m) {
  m.ending = ending_features(m, &Snap::feature);
  m.seams_of = seam_widths(m);
  declare_shared(m);
  Seams seams(m);
  declare_vertex_on_vertex(m, seams);
  seams.close_at_symbols();
  land(m, seams, 1, landings_on_edges(m, 1), Carrier::kEdge);
  land(m, seams, 1, landings_on_faces(m, 1), Carrier::kFace);
  land(m, seams, 0, landings_on_edges(m, 0), Carrier::kEdge);
  land(m, seams, 0, landings_on_faces(m, 0), Carrier::kFace);
  seams.close_at_symbols();
  seams.declare_edges_at_vertices();
}

void declare_edges(Meeting& m) {
  Seams seams(m);
  for (const EdgePair& p : passing_edges(m)) {
    if (p.is_gap && is_doubtful(m, p)) continue;
    m.has_closed_gap |= p.bends;
    const std::array<Carrier, 2> on{Carrier{Carrier::kEdge, p.edge[0], p.t[0]},
                                    Carrier{Carrier::kEdge, p.edge[1], p.t[1]}};
    m.add(seams.shared_or_new(p.point, on));
    m.crossed_edges.insert(p.edge);
  }
}

}  // namespace meshgraft
