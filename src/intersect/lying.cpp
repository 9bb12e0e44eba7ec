#include "intersect/lying.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "geometry/closest.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {

bool is_border_of_groups(const LyingMeeting& l, std::size_t s, LocalEdge e) {
  const Complex& c = l.meeting.complex;
  const Side& side = l.meeting.side[s];
  const auto key = [&](LocalFace f) {
    const std::uint32_t id = side.face(f).value;
    return std::tuple(c.component[id], c.face_groups[id], c.face_attributes[id]);
  };
  const auto faces = side.faces_at_edge(e);
  return std::any_of(faces.begin(), faces.end(), [&](LocalFace f) { return key(f) != key(faces[0]); });
}

bool is_on_border_of_groups(const LyingMeeting& l, std::size_t s, VertexId v) {
  const Side& side = l.meeting.side[s];
  const auto borders = [&](LocalEdge e) {
    return std::ranges::find(side.ends(e), v) != side.ends(e).end() && is_border_of_groups(l, s, e);
  };
  return std::ranges::any_of(side.faces_at(v),
                             [&](LocalFace f) { return std::ranges::any_of(side.edges(f), borders); });
}

bool is_single_group_node(const LyingMeeting& l, std::size_t s, VertexId v) {
  const Complex& c = l.meeting.complex;
  const GroupSetId own = c.vertex_groups[v.value];
  if (own == GroupSets::kEmpty) return false;
  GroupSetId around = GroupSets::kEmpty;
  for (const LocalFace f : l.meeting.side[s].faces_at(v))
    for (const VertexId w : l.meeting.side[s].corners(f))
      if (w != v) around = l.meeting.groups.unite(around, c.vertex_groups[w.value]);
  return !l.meeting.groups.is_subset(own, around);
}

namespace {

std::size_t n_in_contact(const LyingMeeting& l, std::size_t s, LocalEdge e) {
  const auto faces = l.meeting.side[s].faces_at_edge(e);
  return static_cast<std::size_t>(
      std::count_if(faces.begin(), faces.end(), [&](LocalFace f) { return l.in_contact[s][f] != 0; }));
}

/// Edges of a side that carry 1D elements or belong to elements which are not remeshed.
std::vector<std::uint8_t> carrying_edges(const LyingMeeting& l, std::size_t s) {
  const Side& side = l.meeting.side[s];
  std::vector<std::uint8_t> carries(side.n_edges());
  const auto mark = [&](const std::array<VertexId, 2>& ends) {
    if (const LocalEdge e = side.find(ends[0], ends[1]); e != kNowhere) carries[e] = 1;
  };
  for (const Complex::Line& line : l.meeting.complex.lines) mark(line.ends);
  for (const auto& edge : l.meeting.complex.fixed_edges) mark(edge);
  return carries;
}

void mark_edges_that_go(LyingMeeting& l) {
  const std::size_t s = l.goes();
  const Side& side = l.meeting.side[s];
  const std::vector<std::uint8_t> carries = carrying_edges(l, s);
  for (LocalEdge e = 0; e < side.n_edges(); ++e) {
    const std::size_t n = n_in_contact(l, s, e);
    if (n == 0) continue;
    const bool rest_is_joined = n < side.n_faces_at(e);
    const bool of_own = side.is_feature_edge(e) || is_border_of_groups(l, s, e);
    l.imprinted_edge[s][e] = rest_is_joined || carries[e] || (l.takes_over && of_own);
    l.border_edge[s][e] = l.imprinted_edge[s][e] || side.is_feature_edge(e);
  }
  for (LocalFace f = 0; f < side.n_faces(); ++f) {
    if (!l.in_contact[s][f]) continue;
    for (const VertexId v : side.corners(f))
      if (l.meeting.complex.state[v.value] != VertexState::kOpen || (l.takes_over && is_single_group_node(l, s, v)))
        l.imprinted_vertex[s][v.value] = 1;
  }
}

/// Where what lay off a face ends, a mesh that lies on that ends too.
bool is_border_of_reach(const LyingMeeting& l, LocalEdge e) {
  if (l.reach.empty()) return false;
  const Side& side = l.meeting.side[l.stays];
  const auto faces = side.faces_at_edge(e);
  const auto reach = [&](LocalFace f) { return l.reach[side.face(f).value]; };
  const auto differs = [&](LocalFace f) { return (reach(f) == Reach{}) != (reach(faces[0]) == Reach{}); };
  return std::ranges::any_of(faces, differs);
}

void mark_edges_that_stay(LyingMeeting& l) {
  const Side& side = l.meeting.side[l.stays];
  for (LocalEdge e = 0; e < side.n_edges(); ++e)
    l.border_edge[l.stays][e] = l.imprinted_edge[l.stays][e] =
        (side.is_feature_edge(e) || is_border_of_reach(l, e)) && n_in_contact(l, l.stays, e) == 1;
}

void mark_folds(LyingMeeting& l) {
  const Side& side = l.meeting.side[l.stays];
  l.fold_edge.assign(side.n_edges(), 0), l.fold_vertex.assign(l.meeting.complex.n_vertices(), 0);
  const double least = std::cos(l.rule.options.sharp_angle);
  for (LocalEdge e = 0; e < side.n_edges(); ++e) {
    const auto faces = side.faces_at_edge(e);
    if (faces.size() != 2 || n_in_contact(l, l.stays, e) != 2) continue;
    if (std::abs(dot(l.normal(l.stays, faces[0]), l.normal(l.stays, faces[1]))) >= least) continue;
    l.fold_edge[e] = 1;
    if (side.is_feature_edge(e)) continue;
    for (const VertexId v : side.ends(e)) l.fold_vertex[v.value] = 1;
  }
}

/// Over the shift along a surface: how far the border of one side may pass a line of the other that both its ends are
/// on, as chords of one curve do. Each may be off that curve.
constexpr double kChord = 2;

/// A place on the other side where a vertex may lie; the best is the least.
struct Spot {
  VertexId vertex;
  int dimension = 0;  // of what it lies on
  double beside = 0;
  std::uint32_t on = 0;  // vertex, edge or face of the other side
  double t = 0;
  Vec3 point;            // there
  Vec3 own;              // in its own surface, where it slides to for that
  bool is_mere = false;  // on an edge that is no line of the other side
};

class Declarer {
 public:
  explicit Declarer(LyingMeeting& l) : l_(l), m_(l.meeting) {}

  void run() {
    declare_shared(m_);
    for (const std::size_t s : {l_.goes(), l_.stays}) {
      snap_to_features(s);
      build_cover(l_, l_.goes());  // some of it has slid
      place(s);
    }
    cross_edges();
  }

 private:
  [[nodiscard]] bool is_open(std::size_t s, VertexId v) const {
    return l_.imprinted_vertex[s][v.value] && !m_.has_symbol(s, v);
  }

  /// Vertices of features that lie beside a feature of the other side, as seen along the normal; and what would
  /// leave a sliver: any vertex of the side that goes beside an imprinted edge of the other, any edge of it
  /// beside an imprinted vertex. Lines come first: where one is a mere edge may be nearer.
  void snap_to_features(std::size_t s) {
    const std::size_t o = 1 - s;
    std::vector<Spot> spots;
    for (const FacePair& p : m_.pairs)
      for (const VertexId v : m_.side[s].corners(p[s]))
        if (!m_.has_symbol(s, v)) add_spots(s, v, p, spots);
    std::sort(spots.begin(), spots.end(), [](const Spot& a, const Spot& b) {
      return std::tie(a.dimension, a.is_mere, a.beside, a.vertex, a.on) <
             std::tie(b.dimension, b.is_mere, b.beside, b.vertex, b.on);
    });
    for (const Spot& spot : spots) {
      if (m_.has_symbol(s, spot.vertex)) continue;
      if (spot.dimension == 0 && m_.has_symbol(o, VertexId(std::size_t{spot.on}))) continue;
      if (spot.dimension == 1 && is_taken(o, spot)) continue;
      declare(s, spot);
    }
  }

  /// Several vertices of one line that crosses an edge are beside it, and one can slide to where they meet.
  [[nodiscard]] bool is_taken(std::size_t o, const Spot& spot) const {
    const double weld = l_.rule.weld(l_.size(o, m_.side[o].faces_at_edge(spot.on)[0]));
    return std::ranges::any_of(m_.symbols, [&](const Symbol& symbol) {
      return m_.on_edge(symbol, o, spot.on) && distance(l_.at(o, symbol.vertex), spot.point) <= weld;
    });
  }

  /// Both ends of an edge lie on features of the other side.
  [[nodiscard]] bool ends_on_lines(std::size_t s, LocalEdge e) const {
    const Side& other = m_.side[1 - s];
    return std::ranges::all_of(m_.side[s].ends(e), [&](VertexId v) {
      return m_.any_symbol(s, v, [&](const Symbol& symbol) {
        const Carrier& on = symbol.on[1 - s];
        return on.kind == Carrier::kEdge
                   ? other.is_feature_edge(on.id)
                   : on.kind == Carrier::kVertex && other.is_feature(VertexId(std::size_t{on.id}));
      });
    });
  }

  void add_spots(std::size_t s, VertexId v, const FacePair& p, std::vector<Spot>& spots) const {
    const std::size_t o = 1 - s;
    const Side& other = m_.side[o];
    const LocalFace g = p[o];
    const double size = std::min(l_.size(o, g), l_.size(s, p[s]));
    const double beside = l_.rule.beside(size), gap = l_.rule.gap(size);
    const Vec3 n = unit_normal(l_.triangle(o, g));
    const bool is_feature = l_.imprinted_vertex[s][v.value] && m_.side[s].is_feature(v), may_slide = s == l_.goes();
    const auto offset = [&](Vec3 target) -> double {
      const Vec3 d = l_.at(s, v) - target;
      const double height = dot(n, d);
      return std::abs(height) <= gap ? norm(d - height * n) : std::numeric_limits<double>::infinity();
    };
    // The side that stays is where it is; the other one slides along itself.
    const auto slid = [&](Vec3 target) { return may_slide ? target + dot(n, l_.at(s, v) - target) * n : l_.at(s, v); };
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId x = other.corners(g)[k];
      const bool to_vertex = (is_feature && other.is_feature(x)) || (may_slide && l_.imprinted_vertex[o][x.value]);
      if (to_vertex && offset(l_.at(o, x)) <= beside)
        spots.push_back({v, 0, offset(l_.at(o, x)), x.value, 0, l_.at(o, x), slid(l_.at(o, x))});
      const LocalEdge e = other.edges(g)[k];
      const bool runs_along =
          l_.is_fold(s, v) || (!l_.rims.empty() && m_.side[s].is_feature(v) && other.is_feature_edge(e));
      const bool to_border = !may_slide && runs_along && l_.imprinted_edge[o][e] != 0;
      const bool to_fold = l_.imprinted_vertex[s][v.value] != 0 && l_.is_fold(o, e);
      const bool to_line = (is_feature && other.is_feature_edge(e)) || to_fold || to_border ||
                           (may_slide && l_.imprinted_edge[o][e] != 0);
      const bool to_mere = !may_slide && l_.imprinted_vertex[s][v.value] != 0;
      if (!to_line && !to_mere) continue;
      const Vec3 a = l_.at(o, other.ends(e)[0]), b = l_.at(o, other.ends(e)[1]);
      const Vec3 flat = l_.at(s, v) - dot(n, l_.at(s, v) - a) * n;
      const SegmentPoint c = closest_on_segment(flat, a, b);
      double limit = to_border && ends_on_lines(o, e) ? kChord * beside : beside;
      if (may_slide && other.is_feature_edge(e) && std::ranges::binary_search(l_.rims, v))
        limit = std::max(limit, l_.rule.snap.at(size).feature);
      if (c.t > 0 && c.t < 1 && offset(c.point) <= limit)
        spots.push_back({v, 1, offset(c.point), e, c.t, c.point, slid(c.point), !to_line});
    }
  }

  /// All other vertices go to the nearest point of the faces in contact, unless that is its border.
  void place(std::size_t s) {
    const std::size_t o = 1 - s;
    for (std::size_t i = 0; i < l_.imprinted_vertex[s].size(); ++i) {
      const VertexId v(i);
      if (!is_open(s, v)) continue;
      const Cover::Foot foot = l_.cover[o].foot(l_.at(s, v));
      const LocalFace g = l_.cover_face[o][foot.face];
      const double size = std::min(l_.size(o, g), l_.size(s, m_.side[s].faces_at(v)[0]));
      if (distance(l_.at(s, v), foot.point) > l_.rule.gap(size)) continue;
      if (foot.on_border && foot.beside > l_.rule.beside(size)) continue;
      if (const auto spot = spot_at(o, g, v, foot.point, size)) declare(s, *spot);
    }
  }

  /// What of face g a point on it lies on, within the weld length. Nothing at a corner or place that is taken: the
  /// vertex lies beyond the border, which became another point there.
  [[nodiscard]] std::optional<Spot> spot_at(std::size_t o, LocalFace g, VertexId v, Vec3 point, double size) const {
    const Vec3 own = l_.at(1 - o, v);
    const Side& other = m_.side[o];
    const double weld = l_.rule.weld(size);
    for (const VertexId x : other.corners(g))
      if (distance(l_.at(o, x), point) <= weld) {
        if (m_.has_symbol(o, x)) return std::nullopt;
        return Spot{v, 0, 0, x.value, 0, l_.at(o, x), own};
      }
    for (const LocalEdge e : other.edges(g)) {
      const SegmentPoint c = closest_on_segment(point, l_.at(o, other.ends(e)[0]), l_.at(o, other.ends(e)[1]));
      if (distance(c.point, point) > weld || c.t <= 0 || c.t >= 1) continue;
      const Spot spot{v, 1, 0, e, c.t, c.point, own};
      return is_taken(o, spot) ? std::nullopt : std::optional(spot);
    }
    return Spot{v, 2, 0, g, 0, point, own};
  }

  void declare(std::size_t s, const Spot& spot) {
    const std::size_t o = 1 - s;
    std::array<Carrier, 2> on;
    on[s] = {Carrier::kVertex, spot.vertex.value, 0};
    on[o] = {static_cast<Carrier::Kind>(spot.dimension), spot.on, spot.t};
    VertexId v = spot.vertex;
    if (spot.dimension == 0) {
      const VertexId x(std::size_t{on[0].id}), y(std::size_t{on[1].id});
      v = x;
      if (x != y) {
        m_.replaced.push_back({y, x});
        m_.complex.state[x.value] = std::max(m_.complex.state[x.value], m_.complex.state[y.value]);
      }
    }
    // By either name: edges still have the old one.
    for (const VertexId w : {v, VertexId(std::size_t{on[s].id})}) m_.chart[s][w.value] = spot.own;
    if (spot.dimension == 0) m_.chart[o][on[o].id] = spot.point;
    m_.chart[o][v.value] = spot.point;
    m_.add({v, on});
    const std::size_t joined = spot.dimension == 0 ? 1 : o;
    m_.join_groups(v, joined, on[joined]);
  }

  struct Crossing {
    std::array<LocalEdge, 2> edge;
    bool is_askew = false;  // seen along the common perpendicular of the edges only
    std::array<double, 2> t;
    std::array<Vec3, 2> point;
  };

  /// Where an edge of one side passes over or under one of the other, seen along a direction.
  [[nodiscard]] std::optional<Crossing> crossing(LocalEdge e, LocalEdge f, Vec3 along, double size) const {
    const auto& [a, b] = m_.side[0].ends(e);
    const auto& [c, d] = m_.side[1].ends(f);
    const Vec3 origin = l_.at(0, a);
    const auto flat = [&](Vec3 q) { return q - dot(along, q - origin) * along; };
    const SegmentPair near =
        closest_between_segments(flat(l_.at(0, a)), flat(l_.at(0, b)), flat(l_.at(1, c)), flat(l_.at(1, d)));
    const bool inside = near.first.t > 0 && near.first.t < 1 && near.second.t > 0 && near.second.t < 1;
    if (!inside || distance(near.first.point, near.second.point) > l_.rule.weld(size)) return std::nullopt;
    const std::array<Vec3, 2> at{lerp(l_.at(0, a), l_.at(0, b), near.first.t),
                                 lerp(l_.at(1, c), l_.at(1, d), near.second.t)};
    if (distance(at[0], at[1]) > l_.rule.gap(size)) return std::nullopt;
    return Crossing{{e, f}, false, {near.first.t, near.second.t}, at};
  }

  /// Facets of a coarse surface lean so much that one may hide from its own normal what crosses over it: then the
  /// edges are seen from where they are nearest to each other.
  [[nodiscard]] std::optional<Crossing> crossing_askew(LocalEdge e, LocalEdge f, const FacePair& p, double size) const {
    const auto way = [&](std::size_t s, LocalEdge edge) {
      return l_.at(s, m_.side[s].ends(edge)[1]) - l_.at(s, m_.side[s].ends(edge)[0]);
    };
    const Vec3 along = normalized(cross(way(0, e), way(1, f)));
    const Vec3 n = unit_normal(l_.triangle(0, p[0])), m = unit_normal(l_.triangle(1, p[1]));
    if (!l_.rule.is_flat(along, normalized(dot(n, m) < 0 ? n - m : n + m))) return std::nullopt;
    auto found = crossing(e, f, along, size);
    if (found) found->is_askew = true;
    return found;
  }

  /// Where a border edge of one side passes over or under one of the other.
  void cross_edges() {
    std::vector<Crossing> found;
    for (const FacePair& p : l_.pairs) {
      const Vec3 n = unit_normal(l_.triangle(l_.stays, p[l_.stays]));
      const double size = std::min(l_.size(0, p[0]), l_.size(1, p[1]));
      for (const LocalEdge e : m_.side[0].edges(p[0])) {
        if (!l_.border_edge[0][e]) continue;
        for (const LocalEdge f : m_.side[1].edges(p[1])) {
          if (!l_.border_edge[1][f] || share_symbol(e, f)) continue;
          auto seen = crossing(e, f, n, size);
          if (!seen) seen = crossing_askew(e, f, p, size);
          if (seen) found.push_back(*seen);
        }
      }
    }
    std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) {
      return std::tie(a.edge, a.is_askew) < std::tie(b.edge, b.is_askew);
    });
    for (const Crossing& c : found) {
      if (!m_.crossed_edges.insert(c.edge).second) continue;
      add_on_edges(l_, {Carrier{Carrier::kEdge, c.edge[0], c.t[0]}, Carrier{Carrier::kEdge, c.edge[1], c.t[1]}},
                   c.point);
    }
  }

  [[nodiscard]] bool share_symbol(LocalEdge e, LocalEdge f) const {
    for (const std::size_t s : kSides)
      for (const VertexId v : m_.side[s].ends(s == 0 ? e : f))
        if (m_.any_symbol(s, v, [&](const Symbol& a) { return m_.on_edge(a, 1 - s, s == 0 ? f : e); })) return true;
    return false;
  }

  LyingMeeting& l_;
  Meeting& m_;
};

}  // namespace

std::uint32_t add_on_edges(LyingMeeting& l, const std::array<Carrier, 2>& on, const std::array<Vec3, 2>& at) {
  const VertexId v = l.meeting.new_vertex(at[l.stays], on);
  for (const std::size_t s : kSides) l.meeting.chart[s].push_back(at[s]);
  return l.meeting.add({v, on});
}

void find_imprinted(LyingMeeting& l) {
  for (const std::size_t s : kSides) {
    l.border_edge[s].assign(l.meeting.side[s].n_edges(), 0);
    l.imprinted_edge[s].assign(l.meeting.side[s].n_edges(), 0);
    l.imprinted_vertex[s].assign(l.meeting.complex.n_vertices(), 0);
  }
  mark_edges_that_go(l);
  mark_edges_that_stay(l);
  mark_folds(l);
  for (const std::size_t s : kSides)
    for (LocalEdge e = 0; e < l.meeting.side[s].n_edges(); ++e)
      if (l.imprinted_edge[s][e])
        for (const VertexId v : l.meeting.side[s].ends(e)) l.imprinted_vertex[s][v.value] = 1;
}

void build_cover(LyingMeeting& l, std::size_t s) {
  std::vector<Triangle> triangles;
  std::vector<double> sizes;
  std::vector<Vec3> normals;
  std::vector<std::array<VertexId, 3>> corners;
  l.cover_face[s].clear();
  for (LocalFace f = 0; f < l.meeting.side[s].n_faces(); ++f) {
    if (!l.in_contact[s][f]) continue;
    l.cover_face[s].push_back(f);
    triangles.push_back(l.triangle(s, f));
    sizes.push_back(l.size(s, f));
    normals.push_back(l.normal(s, f));
    corners.push_back(l.meeting.side[s].corners(f));
  }
  l.cover[s] = Cover(std::move(triangles), std::move(sizes), std::move(normals), corners);
}

void declare_lying(LyingMeeting& l) { Declarer(l).run(); }

}  // namespace meshgraft
