#include "intersect/assembly.hpp"

#include <algorithm>

#include "core/distinct.hpp"

namespace meshgraft {
namespace {

/// Node groups by component of one vertex become those of another.
void copy_groups(const Complex& from, VertexId v, Complex& to, VertexId w) {
  for (auto g = from.component_groups.lower_bound({v, 0}); g != from.component_groups.end() && g->first.first == v; ++g)
    to.component_groups[{w, g->first.second}] = g->second;
}

std::vector<std::array<VertexId, 2>> ends_of(const std::vector<Complex::Line>& lines) {
  std::vector<std::array<VertexId, 2>> ends;
  for (const Complex::Line& line : lines) ends.push_back(line.ends);
  return ends;
}

}  // namespace

template <class Item>
ItemsAt::ItemsAt(std::size_t n_vertices, const std::vector<Item>& items)
    : item_(n_vertices,
            [&](auto&& add) {
              for (std::uint32_t i = 0; i < items.size(); ++i)
                for (const VertexId v : items[i]) add(v.value, i);
            }),
      more_(n_vertices) {}

std::vector<std::uint32_t> ItemsAt::at(std::span<const VertexId> vertices) const {
  std::vector<std::uint32_t> found;
  for (const VertexId v : vertices) {
    if (v.value < item_.size()) found.insert(found.end(), item_[v.value].begin(), item_[v.value].end());
    found.insert(found.end(), more_[v.value].begin(), more_[v.value].end());
  }
  make_distinct(found);
  return found;
}

Assembly::Assembly(const Complex& complex, std::span<const double> size)
    : input_(complex),
      whole_(complex),
      size_(size),
      faces_at_(complex.n_vertices(), complex.face),
      lines_at_(complex.n_vertices(), ends_of(complex.lines)),
      fixed_at_(complex.n_vertices(), complex.fixed_edges),
      cut_face_(complex.n_faces(), kWhole),
      cut_line_(complex.lines.size(), kWhole) {}

std::vector<Assembly::Piece> Assembly::pieces_of(std::uint32_t face) const {
  if (cut_face_[face] != kWhole) return face_pieces_[cut_face_[face]];
  return {{whole_.face[face], 0, 0, whole_.face_groups[face], {}, {}, {}}};
}

std::vector<Complex::Line> Assembly::pieces_of_line(std::uint32_t line) const {
  if (cut_line_[line] != kWhole) return line_pieces_[cut_line_[line]];
  return {whole_.lines[line]};
}

CutOut Assembly::around(std::span<const FaceId> faces) const {
  CutOut out;
  std::vector<VertexId> inner;
  for (const FaceId f : faces)
    for (const Piece& p : pieces_of(f.value)) inner.insert(inner.end(), p.corners.begin(), p.corners.end());
  make_distinct(inner);

  std::vector<Piece> pieces;
  for (const std::uint32_t f : faces_at_.at(inner))
    for (const Piece& p : pieces_of(f)) {
      pieces.push_back(p), out.face.push_back(f);
      out.vertex.insert(out.vertex.end(), p.corners.begin(), p.corners.end());
    }
  std::vector<Complex::Line> lines;
  for (const std::uint32_t l : lines_at_.at(inner))
    for (const Complex::Line& p : pieces_of_line(l)) {
      lines.push_back(p), out.line.push_back(l);
      out.vertex.insert(out.vertex.end(), p.ends.begin(), p.ends.end());
    }
  out.fixed_edge = fixed_at_.at(inner);
  for (const std::uint32_t e : out.fixed_edge)
    out.vertex.insert(out.vertex.end(), whole_.fixed_edges[e].begin(), whole_.fixed_edges[e].end());
  make_distinct(out.vertex);

  const auto local = [&](VertexId v) {
    return VertexId(
        static_cast<std::size_t>(std::lower_bound(out.vertex.begin(), out.vertex.end(), v) - out.vertex.begin()));
  };
  Complex& c = out.complex;
  c.joins = whole_.joins;
  for (const VertexId v : out.vertex)
    copy_groups(whole_, v, c,
                c.add_vertex(whole_.position[v.value], whole_.node[v.value], whole_.state[v.value],
                             whole_.vertex_groups[v.value]));
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto& v = pieces[i].corners;
    c.add_face({local(v[0]), local(v[1]), local(v[2])}, whole_, FaceId(std::size_t{out.face[i]}));
    out.marks.size.push_back(size_[out.face[i]]);
    out.marks.input.push_back(input_.corners(FaceId(std::size_t{out.face[i]})));
    c.face_groups.back() = pieces[i].groups;
    if (!pieces[i].layers.empty()) c.layers.resize(pieces.size()), c.layers[i] = pieces[i].layers;
    if (pieces[i].kept) out.marks.kept.resize(pieces.size()), out.marks.kept[i] = 1;
    if (pieces[i].reach != Reach{}) out.marks.reach.resize(pieces.size()), out.marks.reach[i] = pieces[i].reach;
    if (!pieces[i].over.empty()) out.marks.over.resize(pieces.size()), out.marks.over[i] = pieces[i].over;
    out.marks.touched.push_back(pieces[i].touched);
    out.marks.active.push_back(1);
    out.marks.from.emplace_back(i);
  }
  for (Complex::Line line : lines) {
    line.ends = {local(line.ends[0]), local(line.ends[1])};
    c.lines.push_back(line);
  }
  for (const std::uint32_t e : out.fixed_edge)
    c.fixed_edges.push_back({local(whole_.fixed_edges[e][0]), local(whole_.fixed_edges[e][1])});
  return out;
}

std::vector<VertexId> Assembly::put_back(const CutOut& before, const Complex& now, const FaceMarks& marks) {
  std::vector<VertexId> vertex = before.vertex;
  for (std::size_t v = 0; v < now.n_vertices(); ++v) {
    if (v < vertex.size()) {
      const std::size_t here = vertex[v].value;
      whole_.position[here] = now.position[v], whole_.state[here] = now.state[v];
      whole_.vertex_groups[here] = now.vertex_groups[v];
    } else {
      vertex.push_back(whole_.add_vertex(now.position[v], now.node[v], now.state[v], now.vertex_groups[v]));
    }
    copy_groups(now, VertexId(v), whole_, vertex[v]);
  }
  for (ItemsAt* items : {&faces_at_, &lines_at_, &fixed_at_}) items->add_vertices(whole_.n_vertices());

  std::size_t i = 0;
  for (std::size_t b = 0; b < before.face.size(); ++b) {
    const std::uint32_t face = before.face[b];
    if (b > 0 && before.face[b - 1] == face) continue;
    std::vector<Piece> pieces;
    for (; i < now.n_faces() && before.face[marks.from[i].value] == face; ++i) {
      const auto& v = now.face[i];
      const std::uint8_t kept = marks.kept.empty() ? 0 : marks.kept[i];
      pieces.push_back({{vertex[v[0].value], vertex[v[1].value], vertex[v[2].value]},
                        marks.touched[i],
                        kept,
                        now.face_groups[i],
                        now.layers.empty() ? Complex::Layers{} : now.layers[i],
                        marks.reach.empty() ? Reach{} : marks.reach[i],
                        marks.over.empty() ? std::vector<std::uint32_t>{} : marks.over[i]});
    }
    set_pieces(face, std::move(pieces));
  }
  std::size_t of_line = 0;  // before.line, which the lines of now follow in order
  for (i = 0; i < now.lines.size();) {
    while (before.complex.lines[of_line].parent != now.lines[i].parent) ++of_line;
    std::vector<Complex::Line> pieces;
    for (; i < now.lines.size() && now.lines[i].parent == before.complex.lines[of_line].parent; ++i) {
      pieces.push_back(now.lines[i]);
      for (VertexId& v : pieces.back().ends) v = vertex[v.value];
    }
    set_pieces_of_line(before.line[of_line], std::move(pieces));
  }
  for (i = 0; i < now.fixed_edges.size(); ++i) {
    const std::array ends{vertex[now.fixed_edges[i][0].value], vertex[now.fixed_edges[i][1].value]};
    if (ends == whole_.fixed_edges[before.fixed_edge[i]]) continue;
    whole_.fixed_edges[before.fixed_edge[i]] = ends;
    for (const VertexId v : ends) fixed_at_.add(v, before.fixed_edge[i]);
  }
  return vertex;
}

void Assembly::set_pieces(std::uint32_t face, std::vector<Piece> pieces) {
  if (pieces == pieces_of(face)) return;
  std::vector<VertexId> vertices;
  for (const Piece& p : pieces) vertices.insert(vertices.end(), p.corners.begin(), p.corners.end());
  make_distinct(vertices);
  for (const VertexId v : vertices) faces_at_.add(v, face);
  if (cut_face_[face] == kWhole) {
    cut_face_[face] = static_cast<std::uint32_t>(face_pieces_.size());
    face_pieces_.emplace_back();
  }
  face_pieces_[cut_face_[face]] = std::move(pieces);
}

void Assembly::set_pieces_of_line(std::uint32_t line, std::vector<Complex::Line> pieces) {
  for (const Complex::Line& p : pieces)
    for (const VertexId v : p.ends) lines_at_.add(v, line);
  if (cut_line_[line] == kWhole) {
    cut_line_[line] = static_cast<std::uint32_t>(line_pieces_.size());
    line_pieces_.emplace_back();
  }
  line_pieces_[cut_line_[line]] = std::move(pieces);
}

Complex Assembly::finished(std::vector<std::uint8_t>& touched, std::vector<std::uint8_t>& kept) const {
  Complex c;
  c.position = whole_.position, c.node = whole_.node, c.state = whole_.state, c.vertex_groups = whole_.vertex_groups;
  c.component_groups = whole_.component_groups;
  const auto any_piece = [&](auto&& is) {
    return std::ranges::any_of(face_pieces_, [&](const auto& pieces) { return std::ranges::any_of(pieces, is); });
  };
  const bool any_layer = any_piece([](const Piece& p) { return !p.layers.empty(); });
  const bool any_kept = any_piece([](const Piece& p) { return p.kept != 0; });
  for (std::uint32_t f = 0; f < whole_.n_faces(); ++f)
    for (const Piece& p : pieces_of(f)) {
      c.add_face(p.corners, whole_, FaceId(std::size_t{f}));
      c.face_groups.back() = p.groups;
      touched.push_back(p.touched);
      if (any_kept) kept.push_back(p.kept);
      if (any_layer) c.layers.push_back(p.layers);
    }
  for (std::uint32_t l = 0; l < whole_.lines.size(); ++l)
    for (const Complex::Line& p : pieces_of_line(l)) c.lines.push_back(p);
  c.fixed_edges = whole_.fixed_edges;
  c.joins = whole_.joins;
  return c;
}

}  // namespace meshgraft
