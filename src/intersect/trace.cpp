// The straight way of an imprinted edge over the faces of the other side.
#include <algorithm>
#include <cmath>

#include "core/distinct.hpp"
#include "geometry/predicates.hpp"
#include "geometry/quality.hpp"
#include "intersect/lying.hpp"

namespace meshgraft {
namespace {

/// Cosine of the least angle that what stands upright on a way ought to make with it: the normals of a fold that the
/// way ends on may point along it.
constexpr double kMostLeaning = 0.9;

class Tracer {
 public:
  explicit Tracer(LyingMeeting& l) : l_(l), m_(l.meeting) {}

  std::optional<JunctionFault> run() {
    for (const std::size_t s : {l_.goes(), l_.stays}) {
      index_symbols(s);
      for (LocalEdge e = 0; e < m_.side[s].n_edges(); ++e)
        if (l_.imprinted_edge[s][e])
          if (auto fault = trace_edge(s, e)) return fault;
    }
    make_distinct(l_.walls);
    return std::nullopt;
  }

 private:
  struct Stop {
    double t = 0;  // along the edge
    std::uint32_t symbol = 0;
    auto operator<=>(const Stop&) const = default;
  };

  /// Symbols inside the edges of side s, as they are before any of them is followed.
  void index_symbols(std::size_t s) {
    inside_.assign(m_.side[s].n_edges(), {});
    for (std::uint32_t i = 0; i < m_.symbols.size(); ++i)
      if (const Carrier& on = m_.symbols[i].on[s]; on.kind == Carrier::kEdge) inside_[on.id].push_back({on.t, i});
  }

  std::optional<JunctionFault> trace_edge(std::size_t s, LocalEdge e) {
    std::vector<Stop> stops = inside_[e];
    for (std::size_t k = 0; k < 2; ++k)
      if (const VertexId v = m_.side[s].ends(e)[k]; m_.has_symbol(s, v))
        stops.push_back({static_cast<double>(k), m_.symbol_of[s][v.value]});
    std::sort(stops.begin(), stops.end());
    for (std::size_t i = 1; i < stops.size(); ++i)
      if (is_covered(s, e, stops[i - 1], stops[i]) && !follow(s, e, stops[i - 1], stops[i]))
        return fault(s, e, stops[i - 1]);
    return std::nullopt;
  }

  [[nodiscard]] Vec3 on_edge(std::size_t s, LocalEdge e, double t) const {
    return lerp(l_.at(s, m_.side[s].ends(e)[0]), l_.at(s, m_.side[s].ends(e)[1]), t);
  }

  /// True if the middle of a piece lies on the other side: as it is, or as that one sees it, whose surface may curve
  /// away from the chord.
  [[nodiscard]] bool is_covered(std::size_t s, LocalEdge e, const Stop& from, const Stop& to) const {
    const Vec3 own = on_edge(s, e, 0.5 * (from.t + to.t));
    const Vec3 seen =
        midpoint(l_.at(1 - s, m_.symbols[from.symbol].vertex), l_.at(1 - s, m_.symbols[to.symbol].vertex));
    const auto faces = m_.side[s].faces_at_edge(e);
    return std::any_of(faces.begin(), faces.end(), [&](LocalFace f) {
      const Vec3 n = l_.normal(s, f);
      const Cover& cover = l_.cover[1 - s];
      return l_.in_contact[s][f] && (cover.covers(seen, n, l_.rule) || cover.covers(own, n, l_.rule));
    });
  }

  [[nodiscard]] std::vector<LocalFace> faces_at(std::size_t s, const Carrier& on) const {
    const Side& side = m_.side[s];
    if (on.kind == Carrier::kFace) return {on.id};
    const auto at = on.kind == Carrier::kEdge ? side.faces_at_edge(on.id) : side.faces_at(VertexId(std::size_t{on.id}));
    return {at.begin(), at.end()};
  }

  /// Both on one edge of the face: the edge itself joins them.
  [[nodiscard]] bool on_one_edge(std::size_t o, LocalFace g, const Symbol& a, const Symbol& b) const {
    const auto& edges = m_.side[o].edges(g);
    return std::any_of(edges.begin(), edges.end(),
                       [&](LocalEdge e) { return m_.on_edge(a, o, e) && m_.on_edge(b, o, e); });
  }

  void link(std::size_t o, LocalFace g, std::uint32_t a, std::uint32_t b) {
    const Symbol &p = m_.symbols[a], &q = m_.symbols[b];
    const auto [low, high] = std::minmax(p.vertex, q.vertex);
    l_.walls.push_back({low, high});
    if (!on_one_edge(o, g, p, q)) l_.segments[o].push_back({g, {low, high}});
  }

  /// What the straight way from a symbol leaves a face through.
  struct Exit {
    double along = 0;  // the way; in a route as a share of what was left of it
    LocalFace face = 0;
    Carrier on;
    Vec3 point;
  };

  /// The straight way from one symbol to another, in the surface of one side.
  struct Way {
    Vec3 from, to, up;  // `up`: over the start
    Vec3 dir;
    double length = 0, weld = 0;
    [[nodiscard]] bool is_upright() const { return std::abs(dot(normalized(up - from), dir)) <= kMostLeaning; }
    [[nodiscard]] double along(Vec3 p) const { return dot(p - from, dir); }
    /// Cosine of the angle between the way and the straight line to a point.
    [[nodiscard]] double straightness(Vec3 p) const { return dot(normalized(p - from), dir); }
    /// On which side of the way a point lies.
    [[nodiscard]] int sign(Vec3 p) const { return orientation_sign(from, to, up, p); }
  };

  /// Where a way has come to on the other side.
  struct Spot {
    Carrier on;
    Vec3 point;
  };
  [[nodiscard]] Spot spot(std::size_t o, const Symbol& symbol) const { return {symbol.on[o], l_.at(o, symbol.vertex)}; }

  /// What stands upright on a way. Where facets make a large angle with each other, as those of a coarse pipe, each may
  /// lead the way astray.
  enum class Upright { kFirstFaces, kAllFaces, kOwnFaces };
  static constexpr std::array kUprights{Upright::kFirstFaces, Upright::kAllFaces, Upright::kOwnFaces};

  void add_normals(std::size_t s, std::span<const LocalFace> faces, Vec3& sum) const {
    for (const LocalFace f : faces) {
      const Vec3 n = unit_normal(l_.triangle(s, f));
      sum += dot(n, sum) < 0 ? -1.0 * n : n;
    }
  }

  /// `e`: the edge of the first side that is followed over the other.
  [[nodiscard]] Vec3 upright(Upright which, std::size_t o, LocalEdge e, const Spot& a, const Spot& b) const {
    std::vector<LocalFace> at_a = faces_at(o, a.on), at_b = faces_at(o, b.on);
    if (which == Upright::kFirstFaces) at_a.resize(1), at_b.resize(1);
    Vec3 sum;
    if (which == Upright::kOwnFaces) {
      for (const LocalFace f : m_.side[1 - o].faces_at_edge(e))
        if (l_.in_contact[1 - o][f]) add_normals(1 - o, std::array{f}, sum);
    } else {
      add_normals(o, at_a, sum), add_normals(o, at_b, sum);
    }
    return normalized(sum);
  }

  [[nodiscard]] Way way(Upright which, std::size_t o, LocalEdge e, const Spot& a, const Spot& b) const {
    Way w;
    w.from = a.point, w.to = b.point;
    w.length = distance(w.from, w.to);
    w.dir = normalized(w.to - w.from);
    const double size = std::min(l_.size(o, faces_at(o, a.on)[0]), l_.size(o, faces_at(o, b.on)[0]));
    w.up = w.from + size * upright(which, o, e, a, b);
    w.weld = l_.rule.weld(size);
    return w;
  }

  /// A symbol may be passed on the way along an edge of the other side only if it lies on that edge.
  [[nodiscard]] bool is_passable(std::size_t o, VertexId x) const { return !m_.has_symbol(o, x); }

  /// Where the way goes through the edge (a, b), if it does so ahead: in a vertex that is no farther than the
  /// weld length from there, else inside.
  [[nodiscard]] std::optional<Exit> through(std::size_t o, LocalFace g, LocalEdge e, const Way& w) const {
    const auto& ends = m_.side[o].ends(e);
    const Vec3 a = l_.at(o, ends[0]), b = l_.at(o, ends[1]);
    const int at_a = w.sign(a), at_b = w.sign(b);
    if (at_a * at_b > 0 || (at_a == 0 && at_b == 0)) return std::nullopt;
    const Vec3 across = cross(w.up - w.from, w.dir);
    const double da = std::abs(dot(across, a - w.from)), db = std::abs(dot(across, b - w.from));
    const double t = at_a == 0 ? 0 : at_b == 0 ? 1 : da + db > 0 ? da / (da + db) : 0.5;
    const Vec3 point = lerp(a, b, t);
    if (w.along(point) <= 0) return std::nullopt;
    for (const std::size_t k : {0, 1}) {
      const Vec3 end = l_.at(o, ends[k]);
      const bool is_there = (k == 0 ? at_a : at_b) == 0;
      if (is_there || (distance(point, end) <= w.weld && w.along(end) > 0 && is_passable(o, ends[k])))
        return Exit{w.along(end), g, {Carrier::kVertex, ends[k].value, 0}, end};
    }
    return Exit{w.along(point), g, {Carrier::kEdge, e, t}, point};
  }

  /// The next edge or vertex on the way, out of the face at the symbol that it runs in: around a fold others may be
  /// ahead too.
  [[nodiscard]] std::optional<Exit> exit(std::size_t o, const Carrier& at, const Way& w) const {
    std::optional<Exit> first;
    for (const LocalFace g : faces_at(o, at)) {
      if (!l_.is_flat[o][g]) continue;
      for (const LocalEdge e : m_.side[o].edges(g)) {
        if (m_.on_edge(at, o, e)) continue;
        const auto found = through(o, g, e, w);
        if (found && (!first || w.straightness(found->point) > w.straightness(first->point))) first = found;
      }
    }
    return first;
  }

  /// What a way passes on the other side, and the face that it ends in.
  struct Route {
    std::vector<Exit> passed;
    LocalFace last = 0;
  };

  /// Straight towards the last symbol: a vertex that the way comes too near to bends it.
  [[nodiscard]] std::optional<Route> route(Upright which, bool may_lean, std::size_t s, LocalEdge e, std::uint32_t from,
                                           std::uint32_t to) const {
    const std::size_t o = 1 - s;
    const Spot end = spot(o, m_.symbols[to]);
    Spot now = spot(o, m_.symbols[from]);
    Route route;
    for (std::size_t step = 0; step <= m_.side[o].n_edges(); ++step) {
      for (const LocalFace g : faces_at(o, now.on))
        if (m_.on_face(m_.symbols[to], o, g)) {
          route.last = g;
          return route;
        }
      const Way w = way(which, o, e, now, end);
      if (!may_lean && !w.is_upright()) return std::nullopt;
      const auto next = exit(o, now.on, w);
      if (!next || next->along >= w.length) return std::nullopt;
      if (next->on.kind == Carrier::kEdge && l_.border_edge[o][next->on.id]) return std::nullopt;
      if (next->on.kind == Carrier::kVertex && !is_passable(o, VertexId(std::size_t{next->on.id}))) return std::nullopt;
      route.passed.push_back(*next);
      route.passed.back().along = next->along / w.length;
      now = {next->on, next->point};
    }
    return std::nullopt;
  }

  /// From symbol to symbol.
  bool follow(std::size_t s, LocalEdge e, const Stop& from, const Stop& to) {
    const std::size_t o = 1 - s;
    std::optional<Route> found;
    for (const bool may_lean : {false, true})
      for (const Upright which : kUprights)
        if (!found) found = route(which, may_lean, s, e, from.symbol, to.symbol);
    if (!found) return false;
    std::uint32_t now = from.symbol;
    double t = from.t;
    for (const Exit& passed : found->passed) {
      t += (to.t - t) * passed.along;
      const std::uint32_t symbol = pass(s, {Carrier::kEdge, e, t}, passed.on, passed.point);
      link(o, passed.face, now, symbol);
      now = symbol;
    }
    link(o, found->last, now, to.symbol);
    return true;
  }

  std::uint32_t pass(std::size_t s, const Carrier& own, const Carrier& other, Vec3 point) {
    const std::size_t o = 1 - s;
    std::array<Carrier, 2> on;
    on[s] = own, on[o] = other;
    std::array<Vec3, 2> at;
    at[s] = on_edge(s, own.id, own.t), at[o] = point;
    if (other.kind == Carrier::kEdge) return add_on_edges(l_, on, at);
    const VertexId x(std::size_t{other.id});
    m_.chart[s][x.value] = at[s];
    m_.join_groups(x, s, own);
    return m_.add({x, on});
  }

  JunctionFault fault(std::size_t s, LocalEdge e, const Stop& from) const {
    const auto own = m_.side[s].faces_at_edge(e);
    const auto other = faces_at(1 - s, m_.symbols[from.symbol].on[1 - s]);
    return {ErrorCode::kOverlap,
            "faces lie on each other over an area whose border cannot be followed",
            {m_.complex.parent[m_.side[s].face(own[0]).value], m_.complex.parent[m_.side[1 - s].face(other[0]).value]},
            on_edge(s, e, from.t)};
  }

  LyingMeeting& l_;
  Meeting& m_;
  std::vector<std::vector<Stop>> inside_;  // by edge
};

}  // namespace

std::optional<JunctionFault> trace_imprinted(LyingMeeting& lying) { return Tracer(lying).run(); }

}  // namespace meshgraft
