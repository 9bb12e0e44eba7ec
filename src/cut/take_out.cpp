#include "cut/take_out.hpp"

#include <algorithm>

#include "merge/edges.hpp"

namespace meshgraft {
namespace {

/// Consecutive items with one parent.
struct Range {
  std::uint32_t first = 0, last = 0;
  [[nodiscard]] std::uint32_t size() const { return last - first; }
};

template <class F>
std::vector<Range> ranges_of(std::size_t n, F&& parent) {
  std::vector<Range> ranges;
  for (std::uint32_t i = 0; i < n; ++i)
    if (!ranges.empty() && parent(i) == parent(i - 1))
      ranges.back().last = i + 1;
    else
      ranges.push_back({i, i + 1});
  return ranges;
}

class Remover {
 public:
  Remover(const Complex& original, const Corefined& from, std::span<const std::uint8_t> goes, std::uint32_t tool)
      : original_(original), from_(from.complex), old_touched_(from.touched), goes_(goes), tool_(tool) {}

  MarkedCut run() {
    find_ranges();
    find_whole();
    Complex& to = out_.corefined.complex;
    to.position = from_.position, to.node = from_.node, to.state = from_.state;
    to.vertex_groups = from_.vertex_groups, to.component_groups = from_.component_groups;
    to.fixed_edges = from_.fixed_edges;
    write_faces();
    write_lines();
    narrow_touched();
    return std::move(out_);
  }

 private:
  /// The faces of the base by parent, in the order of the original: pieces stand where the face stood.
  void find_ranges() {
    for (const Range r : ranges_of(from_.n_faces(), [&](std::uint32_t f) { return from_.parent[f]; }))
      if (from_.component[r.first] != tool_) ranges_.push_back(r);
  }

  [[nodiscard]] bool is_new(VertexId v) const { return v.value >= original_.n_vertices(); }

  /// A cut face becomes whole again if its pieces share one fate, and if none of its new vertices is
  /// needed by a face that does not become whole.
  void find_whole() {
    std::vector<std::uint8_t> needed(from_.n_vertices());
    whole_.assign(ranges_.size(), 0);
    const auto need = [&](const Range& r) {
      for (std::uint32_t f = r.first; f < r.last; ++f)
        for (const VertexId v : from_.face[f]) needed[v.value] = 1;
    };
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
      const auto pieces = goes_.subspan(ranges_[i].first, ranges_[i].size());
      const bool one_fate = std::ranges::all_of(pieces, [&](std::uint8_t g) { return g == pieces[0]; });
      whole_[i] = pieces.size() > 1 && one_fate ? 1 : 0;
      if (whole_[i] == 0) need(ranges_[i]);
    }
    for (bool again = true; again;) {
      again = false;
      for (std::size_t i = 0; i < ranges_.size(); ++i)
        if (whole_[i] != 0 && has_needed(ranges_[i], needed)) whole_[i] = 0, need(ranges_[i]), again = true;
    }
  }

  [[nodiscard]] bool has_needed(const Range& r, const std::vector<std::uint8_t>& needed) const {
    for (std::uint32_t f = r.first; f < r.last; ++f)
      for (const VertexId v : from_.face[f])
        if (is_new(v) && needed[v.value] != 0) return true;
    return false;
  }

  void write_faces() {
    Complex& to = out_.corefined.complex;
    const auto add = [&](const std::array<VertexId, 3>& v, std::uint32_t like, bool touched) {
      to.add_face(v, from_, FaceId(std::size_t{like}));
      out_.goes.push_back(goes_[like]);
      out_.corefined.touched.push_back(touched ? 1 : 0);
    };
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
      const Range& r = ranges_[i];
      if (whole_[i] != 0)
        add(original_.face[i], r.first, false);
      else
        for (std::uint32_t f = r.first; f < r.last; ++f) add(from_.face[f], f, old_touched_[f] != 0);
    }
  }

  /// A line whose inner vertices no face has any more is whole again, too.
  void write_lines() {
    Complex& to = out_.corefined.complex;
    std::vector<std::uint8_t> used(from_.n_vertices());
    for (const auto& face : to.face)
      for (const VertexId v : face) used[v.value] = 1;
    for (const Range& r : ranges_of(from_.lines.size(), [&](std::uint32_t k) { return from_.lines[k].parent; })) {
      const std::span pieces(from_.lines.begin() + r.first, r.size());
      const bool whole = std::ranges::none_of(pieces.subspan(1),
                                              [&](const Complex::Line& line) { return used[line.ends[0].value] != 0; });
      if (!whole || r.size() == 1) {
        to.lines.insert(to.lines.end(), pieces.begin(), pieces.end());
        continue;
      }
      to.lines.push_back(pieces.front());
      to.lines.back().ends[1] = pieces.back().ends[1];
    }
  }

  void narrow_touched() {
    const Complex& to = out_.corefined.complex;
    std::vector<std::uint8_t> on_border(to.n_vertices());
    for (const auto& edge : border_of(to, out_.goes))
      for (const VertexId v : edge) on_border[v.value] = 1;
    for (const Range& r : ranges_of(to.n_faces(), [&](std::uint32_t f) { return to.parent[f]; })) {
      bool concerned = r.size() > 1;
      for (std::uint32_t f = r.first; f < r.last; ++f)
        concerned = concerned || std::ranges::any_of(to.face[f], [&](VertexId v) { return on_border[v.value] != 0; });
      if (!concerned) std::fill_n(out_.corefined.touched.begin() + r.first, r.size(), std::uint8_t{0});
    }
  }

  const Complex& original_;
  const Complex& from_;
  const std::vector<std::uint8_t>& old_touched_;
  std::span<const std::uint8_t> goes_;
  std::uint32_t tool_;
  std::vector<Range> ranges_;        // of the base: one for each face of the original
  std::vector<std::uint8_t> whole_;  // by range: the cut through it is undone
  MarkedCut out_;
};

}  // namespace

MarkedCut without_tool(const Complex& original, const Corefined& corefined, std::span<const std::uint8_t> goes,
                       std::uint32_t tool) {
  return Remover(original, corefined, goes, tool).run();
}

std::vector<std::array<VertexId, 2>> border_of(const Complex& complex, std::span<const std::uint8_t> goes) {
  std::vector<std::array<VertexId, 2>> border;
  const std::vector<FaceOnEdge> uses = edge_uses(complex);
  for_each_edge(uses, [&](std::span<const FaceOnEdge> edge) {
    const auto n = std::ranges::count_if(edge, [&](const FaceOnEdge& u) { return goes[u.face.value] != 0; });
    if (n > 0 && n < static_cast<std::ptrdiff_t>(edge.size())) border.push_back({edge[0].low, edge[0].high});
  });
  return border;
}

}  // namespace meshgraft
