#include "intersect/seams.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"

namespace meshgraft {
namespace {

constexpr double kWidest = 0.01;  // of the edge length: a wider gap is none of a seam, whatever tolerance is asked for

std::span<const LocalFace> faces_at(const Side& side, const Carrier& on) {
  switch (on.kind) {
    case Carrier::kVertex:
      return side.faces_at(VertexId(std::size_t{on.id}));
    case Carrier::kEdge:
      return side.faces_at_edge(on.id);
    case Carrier::kFace:
      break;
  }
  return {&on.id, 1};
}

std::vector<VertexId> ends(const Side& side, const Carrier& on) {
  if (on.kind == Carrier::kVertex) return {VertexId(std::size_t{on.id})};
  return {side.ends(on.id).begin(), side.ends(on.id).end()};
}

/// How far apart two borders of a seam may be where the faces have this size.
double widest(const Snap& snap, double size) { return std::min(snap.feature, std::max(snap.weld, kWidest * size)); }

/// The free edges of a side.
class Borders {
 public:
  Borders(const Meeting& m, std::size_t s) : m_(m), side_(m.side[s]) {
    std::vector<Box> boxes;
    for (LocalEdge e = 0; e < side_.n_edges(); ++e) {
      if (!side_.is_free(e)) continue;
      Box box;
      for (const VertexId v : side_.ends(e)) box.add(m.at(v));
      edges_.push_back(e), boxes.push_back(box);
    }
    tree_ = BoxTree(boxes);
  }
  [[nodiscard]] std::span<const LocalEdge> edges() const { return edges_; }

  /// The distance from the middle of a free edge to the nearest other one that is no neighbour of it, if there may be a
  /// seam between them; else 0.
  [[nodiscard]] double width(LocalEdge e) const {
    const auto& [a, b] = side_.ends(e);
    const Vec3 middle = midpoint(m_.at(a), m_.at(b));
    const FaceId face = side_.face(side_.faces_at_edge(e).front());
    if (!m_.exact.empty() && m_.exact[face.value] != 0) return 0;
    const double size = m_.size[face.value], limit = widest(m_.rule.at(size), size);
    double least = limit;
    bool found = false;
    Box place;
    place.add(middle);
    tree_.overlapping(place.grown(limit), [&](std::uint32_t i) {
      const auto& [c, d] = side_.ends(edges_[i]);
      if (are_connected(e, edges_[i])) return;
      const double apart = distance(middle, closest_on_segment(middle, m_.at(c), m_.at(d)).point);
      if (apart <= least) least = apart, found = true;
    });
    return found ? least : 0;
  }

 private:
  [[nodiscard]] bool are_connected(LocalEdge e, LocalEdge f) const {
    return std::ranges::any_of(side_.ends(e), [&](VertexId v) {
      return std::ranges::any_of(side_.ends(f), [&](VertexId w) { return v == w || side_.find(v, w) != kNowhere; });
    });
  }

  const Meeting& m_;
  const Side& side_;
  std::vector<LocalEdge> edges_;
  BoxTree tree_;
};

}  // namespace

SeamWidths seam_widths(const Meeting& m) {
  SeamWidths widths;
  for (const std::size_t s : kSides) {
    widths.vertex[s].assign(m.complex.n_vertices(), 0), widths.edge[s].assign(m.side[s].n_edges(), 0);
    const Borders borders(m, s);
    for (const LocalEdge e : borders.edges()) {
      const double width = borders.width(e);
      widths.edge[s][e] = width;
      for (const VertexId v : m.side[s].ends(e)) widths.vertex[s][v.value] = std::max(widths.vertex[s][v.value], width);
    }
  }
  return widths;
}

Seams::Seams(Meeting& meeting) : m_(meeting) {
  for (const std::size_t s : kSides) {
    on_free_edge_[s].assign(m_.symbol_of[s].size(), 0);
    for (LocalEdge e = 0; e < m_.side[s].n_edges(); ++e)
      if (m_.side[s].is_free(e))
        for (const VertexId v : m_.side[s].ends(e)) on_free_edge_[s][v.value] = 1;
  }
}

bool Seams::is_on_border(std::size_t s, const Carrier& on) const {
  switch (on.kind) {
    case Carrier::kVertex:
      return on_free_edge_[s][on.id] != 0;
    case Carrier::kEdge:
      return m_.side[s].is_free(on.id);
    case Carrier::kFace:
      break;
  }
  return false;
}

/// How far apart two borders of one seam may be; negative if they are of none. A sliver has two of its edges in one
/// place and is no seam; borders with a common end are near each other there and are one only where they lie in one
/// place.
double Seams::width(std::size_t s, const Carrier& a, const Carrier& b) const {
  const Side& side = m_.side[s];
  const auto at_a = faces_at(side, a), at_b = faces_at(side, b);
  if (std::ranges::find_first_of(at_a, at_b) != at_a.end()) return -1;
  double size = std::numeric_limits<double>::infinity();
  bool exact = false;
  for (const LocalFace f : at_a) {
    const FaceId id = side.face(f);
    size = std::min(size, m_.size[id.value]);
    exact = exact || (!m_.exact.empty() && m_.exact[id.value] != 0);
  }
  const Snap snap = m_.rule.at(size);
  const auto ends_a = ends(side, a), ends_b = ends(side, b);
  const bool connected = std::ranges::any_of(ends_a, [&](VertexId v) {
    return std::ranges::any_of(ends_b, [&](VertexId w) { return v == w || side.find(v, w) != kNowhere; });
  });
  if (exact || connected) return snap.weld;
  return widest(snap, size);
}

/// An edge that has the vertex at an end goes through no seam there.
bool Seams::ends_in(std::size_t s, const Carrier& own, VertexId v) const {
  if (own.kind != Carrier::kEdge) return false;
  return std::ranges::any_of(m_.side[s].ends(own.id), [&](VertexId end) {
    return m_.any_symbol(s, end, [&](const Symbol& symbol) { return symbol.vertex == v; });
  });
}

/// A face of side s between its corner v and edge e of the other side fills the seam.
bool Seams::is_filled(std::size_t s, VertexId v, LocalEdge e) const {
  const auto is_at_seam = [&](VertexId w) {
    return w == v || m_.any_symbol(s, w, [&](const Symbol& symbol) { return m_.on_edge(symbol, 1 - s, e); });
  };
  return std::ranges::any_of(m_.side[s].faces_at(v),
                             [&](LocalFace f) { return std::ranges::all_of(m_.side[s].corners(f), is_at_seam); });
}

void Seams::note(std::size_t s, const Carrier& on, VertexId v) {
  const FaceId face = m_.side[s].face(faces_at(m_.side[s], on).front());
  m_.seams.push_back({m_.complex.parent[face.value], m_.at(v)});
}

void Seams::index_new_symbols() {
  for (; n_indexed_ < m_.symbols.size(); ++n_indexed_) {
    const auto& on = m_.symbols[n_indexed_].on;
    for (const std::size_t s : kSides)
      if (is_on_border(s, on[s]))
        for (const LocalFace f : faces_at(m_.side[1 - s], on[1 - s]))
          symbols_[{s, f}].push_back(static_cast<std::uint32_t>(n_indexed_));
    if (is_on_border(0, on[0]) && is_on_border(1, on[1]))
      crossings_.emplace(m_.at(m_.symbols[n_indexed_].vertex).x, static_cast<std::uint32_t>(n_indexed_));
  }
}

std::optional<std::uint32_t> Seams::find_crossing(Vec3 p, const std::array<Carrier, 2>& on) {
  if (!is_on_border(0, on[0]) || !is_on_border(1, on[1])) return std::nullopt;
  index_new_symbols();
  double reach = std::numeric_limits<double>::infinity();
  for (const std::size_t s : kSides) {
    const double size = m_.size[m_.side[s].face(faces_at(m_.side[s], on[s]).front()).value];
    reach = std::min(reach, widest(m_.rule.at(size), size));
  }
  std::optional<std::uint32_t> first;
  const auto end = crossings_.upper_bound(p.x + reach);
  for (auto at = crossings_.lower_bound(p.x - reach); at != end; ++at) {
    const Symbol& symbol = m_.symbols[at->second];
    const double apart = distance(p, m_.at(symbol.vertex));
    const auto crosses = [&](std::size_t s) {
      return apart <= width(s, on[s], symbol.on[s]) && !ends_in(s, on[s], symbol.vertex);
    };
    if (crosses(0) && crosses(1)) first = std::min(at->second, first.value_or(at->second));
  }
  return first;
}

std::optional<std::uint32_t> Seams::find(std::size_t s, const Carrier& own, const Carrier& other, Vec3 p) {
  if (!is_on_border(s, own)) return std::nullopt;
  index_new_symbols();
  for (const LocalFace f : faces_at(m_.side[1 - s], other))
    if (const auto at = symbols_.find({s, f}); at != symbols_.end())
      for (const std::uint32_t i : at->second) {
        const Symbol& symbol = m_.symbols[i];
        if (distance(p, m_.at(symbol.vertex)) <= width(s, own, symbol.on[s]) && !ends_in(s, own, symbol.vertex))
          return i;
      }
  return std::nullopt;
}

Symbol Seams::shared_or_new(Vec3 p, const std::array<Carrier, 2>& on) {
  for (const std::size_t s : kSides)
    if (const auto i = find(s, on[s], on[1 - s], p)) {
      Symbol symbol = m_.symbols[*i];
      symbol.on[s] = on[s];
      m_.join_groups(symbol.vertex, s, on[s]);
      note(s, on[s], symbol.vertex);
      return symbol;
    }
  if (const auto i = find_crossing(p, on)) {
    const VertexId v = m_.symbols[*i].vertex;
    for (const std::size_t s : kSides) m_.join_groups(v, s, on[s]), note(s, on[s], v);
    return {v, on};
  }
  return {m_.new_vertex(p, on), on};
}

bool Seams::close(std::size_t s, VertexId w, std::uint32_t symbol) {
  if (m_.complex.state[w.value] == VertexState::kFrozen) return false;
  Symbol closed = m_.symbols[symbol];
  const VertexId v = closed.vertex;
  closed.on[s] = {Carrier::kVertex, w.value, 0};
  m_.add(closed);
  m_.replaced.push_back({w, v});
  m_.join_groups(v, s, closed.on[s]);
  note(s, closed.on[s], v);
  m_.complex.state[v.value] = std::max(m_.complex.state[v.value], m_.complex.state[w.value]);
  m_.has_closed_gap |= distance(m_.at(w), m_.at(v)) > m_.rule.noise();
  m_.complex.position[w.value] = m_.at(v);
  return true;
}

void Seams::close_at_symbols() {
  for (const FacePair& p : m_.pairs)
    for (const std::size_t s : kSides)
      for (const VertexId w : m_.side[s].corners(p[s])) {
        if (m_.has_symbol(s, w)) continue;
        const auto symbol = find(s, {Carrier::kVertex, w.value, 0}, {Carrier::kFace, p[1 - s], 0}, m_.at(w));
        if (symbol) close(s, w, *symbol);
      }
}

void Seams::declare_edges_at_vertices() {
  for (const FacePair& p : m_.pairs)
    for (const std::size_t s : kSides) {
      const Side& other = m_.side[1 - s];
      for (const LocalEdge e : other.edges(p[1 - s])) {
        if (!other.is_free(e)) continue;
        const auto& [low, high] = other.ends(e);
        for (const VertexId v : m_.side[s].corners(p[s])) {
          if (!m_.has_symbol(s, v)) continue;
          const SegmentPoint c = closest_on_segment(m_.at(v), m_.at(low), m_.at(high));
          Symbol on_edge = m_.symbols[m_.symbol_of[s][v.value]];
          const Carrier border = on_edge.on[1 - s], own{Carrier::kEdge, e, c.t};
          if (c.t <= 0 || c.t >= 1 || !is_on_border(1 - s, border)) continue;
          if (distance(m_.at(v), c.point) > width(1 - s, own, border)) continue;
          if (m_.any_symbol(s, v, [&](const Symbol& symbol) { return m_.on_edge(symbol, 1 - s, e); })) continue;
          if (is_filled(s, v, e)) continue;
          on_edge.on[1 - s] = own;
          on_edge.on[s] = {Carrier::kVertex, v.value, 0};
          m_.add(on_edge);
          m_.join_groups(on_edge.vertex, 1 - s, own);
          note(1 - s, own, on_edge.vertex);
        }
      }
    }
}

}  // namespace meshgraft
