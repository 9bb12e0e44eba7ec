#include "merge/loose_pieces.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "core/union_find.hpp"
#include "merge/mesh_distance.hpp"

namespace meshgraft {
namespace {

/// Elements of an input that hang together, named by their smallest node.
class Pieces {
 public:
  explicit Pieces(const Model& model) : model_(model), sets_(model.n_nodes()), met_(model.n_nodes()) {
    for (std::size_t e = 0; e < model.n_elements(); ++e)
      if (const NodeId first = first_node(ElementId(e)); first.valid())
        for (const NodeId n : model.nodes_of(ElementId(e)))
          if (n.valid()) sets_.unite(first.value, n.value);
  }

  [[nodiscard]] std::uint32_t of(ElementId e) { return sets_.find(first_node(e).value); }
  void mark_met(ElementId face) { met_[of(face)] = 1; }
  [[nodiscard]] bool has_met(ElementId e) { return met_[of(e)] != 0; }
  [[nodiscard]] bool any_met() const { return std::ranges::find(met_, 1) != met_.end(); }

  struct Loose {
    std::size_t pieces = 0;
    std::vector<ElementId> first;  // the elements of the first one
  };
  [[nodiscard]] Loose loose() {
    std::vector<std::uint8_t> counted(model_.n_nodes());
    Loose found;
    for (std::size_t e = 0; e < model_.n_elements(); ++e) {
      const ElementId id(e);
      if (!can_be_joined(id) || has_met(id) || std::exchange(counted[of(id)], 1) != 0) continue;
      if (found.pieces++ == 0) found.first.push_back(id);
    }
    if (found.pieces == 0) return found;
    const std::uint32_t piece = of(found.first.front());
    for (std::size_t e = found.first.front().value + std::size_t{1}; e < model_.n_elements(); ++e)
      if (first_node(ElementId(e)).valid() && of(ElementId(e)) == piece) found.first.emplace_back(e);
    return found;
  }

 private:
  [[nodiscard]] NodeId first_node(ElementId e) const {
    const auto nodes = model_.nodes_of(e);
    const auto first = std::ranges::find_if(nodes, &NodeId::valid);
    return first == nodes.end() ? NodeId{} : *first;
  }
  /// Masses and springs that stand alone are what they were.
  [[nodiscard]] bool can_be_joined(ElementId e) const {
    const Shape shape = model_.shape(e);
    return shape != Shape::kPoint && shape != Shape::kOther && first_node(e).valid();
  }

  const Model& model_;
  UnionFind sets_;
  std::vector<std::uint8_t> met_;  // by piece
};

/// Calls f(parent) for each input face that has a node in common with another component now, or lay on one.
template <class F>
void for_each_met(const Outcome& outcome, F&& f) {
  constexpr std::uint32_t kNone = 0xFFFFFFFF, kSeveral = kNone - 1;
  const Complex& c = outcome.final_complex;
  std::vector<std::uint32_t> component(c.n_vertices(), kNone);
  for (std::size_t k = 0; k < c.n_faces(); ++k)
    for (const VertexId v : c.face[k]) {
      std::uint32_t& of = component[v.value];
      of = of == kNone || of == c.component[k] ? c.component[k] : kSeveral;
    }
  for (std::size_t k = 0; k < c.n_faces(); ++k) {
    const auto layers = c.layers_of(FaceId(k));
    const auto is_shared = [&](VertexId v) { return component[v.value] == kSeveral; };
    if (layers.empty() && std::ranges::none_of(c.face[k], is_shared)) continue;
    f(c.parent[k]);
    for (const Complex::Layer& layer : layers) f(layer.parent);
  }
  for (const Corefined::Covered& covered : outcome.corefined.covered) f(covered.face);
}

/// From the nodes of a piece of input k to the faces of other inputs, or to other pieces of the only one.
double distance_to_others(Inputs inputs, std::uint32_t k, std::span<const ElementId> piece, Pieces& pieces) {
  const Model& model = *inputs[k];
  std::vector<Vec3> points;
  for (const ElementId e : piece)
    for (const NodeId n : model.nodes_of(e))
      if (n.valid()) points.push_back(model.position[n.value]);
  const std::uint32_t own = pieces.of(piece.front());
  if (inputs.size() == 1)
    return distance_to_faces(points, model, faces_of(model, [&](ElementId e) { return pieces.of(e) != own; }));
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t other = 0; other < inputs.size(); ++other)
    if (other != k) least = std::min(least, distance_to_faces(points, *inputs[other], faces_of(*inputs[other])));
  return least;
}

}  // namespace

std::vector<Warning> loose_piece_warnings(const Outcome& outcome) {
  const Inputs inputs = outcome.inputs;
  const bool with_itself = inputs.size() == 1;
  if (!outcome.components.joins.kind.empty() || (with_itself && !outcome.components.are_parted())) return {};
  std::vector<Warning> warnings;
  for (std::uint32_t k = with_itself ? 0 : 1; k < inputs.size(); ++k) {
    const Model& model = *inputs[k];
    Pieces pieces(model);
    for_each_met(outcome, [&](ElementRef face) {
      if (face.input == k) pieces.mark_met(face.element);
    });
    if (!pieces.any_met()) continue;  // the input as a whole is told to be apart
    const auto [n, first] = pieces.loose();
    if (n == 0) continue;
    const std::string size = first.size() == 1 ? "" : ", with " + std::to_string(first.size() - 1) + " more elements,";
    std::string text = text_of(inputs, {k, first.front()}) + size + " is a piece that meets nothing; its nodes are " +
                       text_of(distance_to_others(inputs, k, first, pieces)) + " or more away from the triangles of " +
                       (with_itself ? "other pieces" : "the other meshes");
    if (n > 1) text += "; so are " + std::to_string(n - 1) + " more pieces";
    warnings.push_back({"piece-apart", std::move(text), place_of(model, first.front())});
  }
  return warnings;
}

}  // namespace meshgraft
