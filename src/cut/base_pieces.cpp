#include "cut/base_pieces.hpp"

#include <tbb/parallel_sort.h>

#include <algorithm>

#include "core/union_find.hpp"
#include "geometry/quality.hpp"
#include "merge/inputs.hpp"

namespace meshgraft {
namespace {

/// One side of one cell. Cells are the faces of the complex and then the elements of the base.
struct Use {
  std::uint64_t edge = 0;  // smaller and larger corner
  std::uint32_t cell = 0;
  friend constexpr auto operator<=>(const Use&, const Use&) = default;
};

std::uint64_t key(std::uint32_t a, std::uint32_t b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

class Gatherer {
 public:
  Gatherer(const Model& base, const Complex& complex, std::uint32_t tool)
      : base_(base), complex_(complex), tool_(tool), in_complex_(base.n_elements()) {
    for (std::size_t f = 0; f < complex.n_faces(); ++f)
      if (complex.component[f] != tool) in_complex_[complex.parent[f].element.value] = 1;
  }

  BasePieces run(std::span<const std::array<VertexId, 2>> cuts) {
    collect_sides();
    std::vector<std::uint64_t> cut;
    for (const auto& [a, b] : cuts) cut.push_back(key(corner(a), corner(b)));
    std::ranges::sort(cut);
    const auto n_faces = static_cast<std::uint32_t>(complex_.n_faces());
    UnionFind sets(n_faces + base_.n_elements());
    std::vector<std::uint8_t> on_tool(n_faces + base_.n_elements());
    for (std::size_t i = 0, j = 0; i < uses_.size(); i = j) {
      const bool is_cut = std::ranges::binary_search(cut, uses_[i].edge);
      for (j = i; j < uses_.size() && uses_[j].edge == uses_[i].edge; ++j)
        if (is_cut)
          on_tool[uses_[j].cell] = 1;
        else
          sets.unite(uses_[i].cell, uses_[j].cell);
    }
    number(sets, on_tool);
    return std::move(pieces_);
  }

 private:
  /// A node of the base, or a vertex that is new.
  [[nodiscard]] std::uint32_t corner(VertexId v) const {
    const NodeRef n = complex_.node[v.value];
    return n.valid() ? n.node.value : static_cast<std::uint32_t>(base_.n_nodes()) + v.value;
  }

  void collect_sides() {
    for (std::uint32_t f = 0; f < complex_.n_faces(); ++f) {
      if (complex_.component[f] == tool_) continue;
      const auto& v = complex_.face[f];
      for (std::size_t k = 0; k < 3; ++k) uses_.push_back({key(corner(v[k]), corner(v[(k + 1) % 3])), f});
    }
    const auto first = static_cast<std::uint32_t>(complex_.n_faces());
    for (std::uint32_t e = 0; e < base_.n_elements(); ++e) {
      if (in_complex_[e] != 0) continue;
      const Corners c = corners_of(base_.shape(ElementId(std::size_t{e})), base_.nodes_of(ElementId(std::size_t{e})));
      if (!c.is_surface()) continue;
      for (std::size_t k = 0; k < c.n; ++k)
        uses_.push_back({key(c.node[k].value, c.node[(k + 1) % c.n].value), first + e});
    }
    tbb::parallel_sort(uses_.begin(), uses_.end());
  }

  void number(UnionFind& sets, const std::vector<std::uint8_t>& on_tool) {
    const auto n_faces = static_cast<std::uint32_t>(complex_.n_faces());
    std::vector<std::uint32_t> name(n_faces + base_.n_elements(), BasePieces::kNone);
    std::vector<double> largest;
    const auto assign = [&](std::uint32_t cell, const Triangle& t) {
      std::uint32_t& piece = name[sets.find(cell)];
      if (piece == BasePieces::kNone) {
        piece = pieces_.n++;
        pieces_.place.push_back(centroid(t)), pieces_.touched.push_back(0), largest.push_back(0);
      }
      if (const double a = area(t); a > largest[piece]) largest[piece] = a, pieces_.place[piece] = centroid(t);
      if (on_tool[cell] != 0) pieces_.touched[piece] = 1;
      return piece;
    };
    pieces_.of_face.assign(n_faces, BasePieces::kNone);
    for (std::uint32_t f = 0; f < n_faces; ++f)
      if (complex_.component[f] != tool_) pieces_.of_face[f] = assign(f, complex_.corners(FaceId(std::size_t{f})));
    pieces_.of_element.assign(base_.n_elements(), BasePieces::kNone);
    for (std::uint32_t e = 0; e < base_.n_elements(); ++e) {
      if (in_complex_[e] != 0) continue;
      const Corners c = corners_of(base_.shape(ElementId(std::size_t{e})), base_.nodes_of(ElementId(std::size_t{e})));
      if (!c.is_surface()) continue;
      const auto at = [&](std::size_t k) { return base_.position[c.node[k].value]; };
      pieces_.of_element[e] = assign(n_faces + e, {at(0), at(1), at(2)});
    }
  }

  const Model& base_;
  const Complex& complex_;
  std::uint32_t tool_;
  std::vector<std::uint8_t> in_complex_;  // by element of the base
  std::vector<Use> uses_;                 // ascending
  BasePieces pieces_;
};

}  // namespace

BasePieces base_pieces(const Model& base, const Complex& complex, std::span<const std::array<VertexId, 2>> cuts,
                       std::uint32_t tool) {
  return Gatherer(base, complex, tool).run(cuts);
}

}  // namespace meshgraft
