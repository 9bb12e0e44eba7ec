#include "cut/elements.hpp"

#include <algorithm>

#include "core/union_find.hpp"
#include "merge/edges.hpp"
#include "merge/inputs.hpp"

namespace meshgraft {
namespace {

/// What is known of a node: whether it belongs to something that stays, and to something that goes.
enum : std::uint8_t { kStays = 1, kGoes = 2 };

bool is_structure(Shape s) { return s == Shape::kLine || s == Shape::kLine3 || s == Shape::kSolid; }
bool is_link(Shape s) { return s == Shape::kPoint || s == Shape::kOther; }

class Sorter {
 public:
  Sorter(const Model& base, const Complex& complex, const BasePieces& pieces, std::span<const std::uint8_t> goes,
         const TriangleSurface& tool, bool is_closed, const Drop& drop)
      : tool_(tool),
        is_closed_(is_closed),
        drop_(drop),
        base_(base),
        complex_(complex),
        pieces_(pieces),
        goes_(goes),
        at_node_(base.n_nodes()),
        settled_(base.n_elements()) {}

  Result<DroppedElements> run() {
    look_at_surfaces();
    settle_lines_on_edges();
    const std::vector<std::uint8_t> on_surface = at_node_;
    if (const auto good = spread_over_structures(on_surface); !good) return Failure(good.error());
    take_structures();
    take_links();
    std::ranges::sort(out_.elements);
    return std::move(out_);
  }

 private:
  void look_at_surfaces() {
    for (std::size_t f = 0; f < complex_.n_faces(); ++f) {
      const std::uint32_t piece = pieces_.of_face[f];
      if (piece == BasePieces::kNone) continue;
      settled_[complex_.parent[f].element.value] = 1;
      for (const VertexId v : complex_.face[f])
        if (const NodeRef n = complex_.node[v.value]; n.valid())
          at_node_[n.node.value] |= goes_[piece] != 0 ? kGoes : kStays;
    }
    for (std::size_t e = 0; e < base_.n_elements(); ++e) {
      const std::uint32_t piece = pieces_.of_element[e];
      if (piece == BasePieces::kNone) continue;
      settled_[e] = 1;
      if (goes_[piece] != 0) out_.elements.emplace_back(e);
      for (const NodeId n : base_.nodes_of(ElementId(e)))
        if (n.valid()) at_node_[n.value] |= goes_[piece] != 0 ? kGoes : kStays;
    }
  }

  /// They go, stay or are cut with the faces of the complex.
  void settle_lines_on_edges() {
    if (complex_.lines.empty()) return;
    const std::vector<FaceOnEdge> uses = edge_uses(complex_);
    for (const Complex::Line& line : complex_.lines) {
      const auto [low, high] = std::minmax(line.ends[0], line.ends[1]);
      const auto at = std::ranges::lower_bound(uses, FaceOnEdge{low, high, FaceId(std::size_t{0})});
      if (at != uses.end() && at->low == low && at->high == high) settled_[line.parent.element.value] = 1;
    }
  }

  /// Of the nodes of an element: what they belong to together.
  [[nodiscard]] std::uint8_t belongs(ElementId e, const std::vector<std::uint8_t>& at_node) const {
    std::uint8_t all = 0;
    for (const NodeId n : base_.nodes_of(e))
      if (n.valid()) all |= (at_node[n.value] & kStays) != 0 ? std::uint8_t{kStays} : at_node[n.value];
    return all;
  }

  /// Of a line: whether the tool goes through it between its ends.
  [[nodiscard]] bool is_crossed(ElementId e) const {
    const Corners c = corners_of(base_.shape(e), base_.nodes_of(e));
    return c.n == 2 && tool_.crosses(base_.position[c.node[0].value], base_.position[c.node[1].value]);
  }

  [[nodiscard]] bool is_dropped_place(Vec3 p) const {
    if (!is_closed_ || drop_.what == Drop::What::kGroup) return false;
    return tool_.contains(p) == (drop_.what == Drop::What::kInside);
  }

  [[nodiscard]] Failure crossed(ElementId e) const {
    Vec3 at;
    double n = 0;
    for (const NodeId node : base_.nodes_of(e))
      if (node.valid()) at += base_.position[node.value], ++n;
    return failure(ErrorCode::kUnsupportedElement,
                   "element " + std::to_string(base_.element_label[e.value]) + " of " + base_.path +
                       ", which cannot be cut, is on both sides of the cut, at " + text_of(at / n),
                   "divide or remove it, or move the tool", place_of(base_, e));
  }

  /// Gives each node without a surface what the structure on it hangs on.
  Result<void> spread_over_structures(const std::vector<std::uint8_t>& on_surface) {
    UnionFind sets(base_.n_nodes());
    std::vector<std::uint8_t> of_set(base_.n_nodes());
    const auto each_structure = [&](auto&& f) -> Result<void> {
      for (std::size_t e = 0; e < base_.n_elements(); ++e)
        if (settled_[e] == 0 && is_structure(base_.shape(ElementId(e))))
          if (Result<void> good = f(ElementId(e)); !good) return good;
      return {};
    };
    (void)each_structure([&](ElementId e) -> Result<void> {
      NodeId first;
      for (const NodeId n : base_.nodes_of(e)) {
        if (!n.valid() || on_surface[n.value] != 0) continue;
        if (!first.valid()) first = n;
        sets.unite(first.value, n.value);
      }
      return {};
    });
    (void)each_structure([&](ElementId e) -> Result<void> {
      const std::uint8_t all = belongs(e, on_surface);
      for (const NodeId n : base_.nodes_of(e))
        if (n.valid() && on_surface[n.value] == 0) of_set[sets.find(n.value)] |= all;
      return {};
    });
    return each_structure([&](ElementId e) -> Result<void> {
      std::uint8_t all = belongs(e, on_surface);
      for (const NodeId n : base_.nodes_of(e)) {
        if (!n.valid() || on_surface[n.value] != 0) continue;
        std::uint8_t& at = at_node_[n.value];
        at = of_set[sets.find(n.value)];
        if (at == 0) at = is_dropped_place(base_.position[n.value]) ? kGoes : kStays;
        all |= at;
      }
      if (all == (kStays | kGoes) || is_crossed(e)) return crossed(e);
      return {};
    });
  }

  void take_structures() {
    for (std::size_t e = 0; e < base_.n_elements(); ++e)
      if (settled_[e] == 0 && is_structure(base_.shape(ElementId(e))) && belongs(ElementId(e), at_node_) == kGoes)
        out_.elements.emplace_back(e);
  }

  void take_links() {
    std::size_t n_spanning = 0;
    ElementId first;
    for (std::size_t e = 0; e < base_.n_elements(); ++e) {
      if (!is_link(base_.shape(ElementId(e)))) continue;
      const std::uint8_t all = belongs(ElementId(e), at_node_);
      if (all == kGoes) out_.elements.emplace_back(e);
      if (all == (kStays | kGoes) && n_spanning++ == 0) first = ElementId(e);
    }
    if (n_spanning == 0) return;
    out_.warnings.push_back({"spanning-element",
                             std::to_string(n_spanning) + (n_spanning == 1 ? " element joins" : " elements join") +
                                 " what stays with nodes whose faces are dropped, element " +
                                 std::to_string(base_.element_label[first.value]) + " the first; " +
                                 (n_spanning == 1 ? "it stays, with these nodes" : "they stay, with these nodes"),
                             place_of(base_, first)});
  }

  const TriangleSurface& tool_;
  bool is_closed_;
  const Drop& drop_;
  const Model& base_;
  const Complex& complex_;
  const BasePieces& pieces_;
  std::span<const std::uint8_t> goes_;  // by piece
  std::vector<std::uint8_t> at_node_;   // by node of the base
  std::vector<std::uint8_t> settled_;   // by element of the base: what becomes of it is known already
  DroppedElements out_;
};

}  // namespace

Result<DroppedElements> dropped_elements(const Model& base, const Complex& complex, const BasePieces& pieces,
                                         std::span<const std::uint8_t> goes, const TriangleSurface& tool,
                                         bool is_closed, const Drop& drop) {
  return Sorter(base, complex, pieces, goes, tool, is_closed, drop).run();
}

}  // namespace meshgraft
