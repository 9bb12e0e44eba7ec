#include "merge/stitch.hpp"

#include <algorithm>
#include <array>

#include "core/blocks.hpp"
#include "core/distinct.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kFaceBlock = 2048;  // faces compared with their parents in one go

template <class T>
bool contains(const std::vector<T>& set, const T& x) {
  return std::binary_search(set.begin(), set.end(), x);
}

/// A node of a part and the node it became one with.
struct Swap {
  NodeRef node;
  VertexId vertex;  // of the final complex
  friend constexpr auto operator<=>(Swap, Swap) = default;
};

class Stitcher {
 public:
  Stitcher(Inputs inputs, const Complex& original, const Corefined& corefined, const Complex& final_complex,
           Graft& graft)
      : inputs_(inputs), original_(original), corefined_(corefined), final_(final_complex), graft_(graft) {}

  Stitched run() {
    identify_vertices();
    find_swaps();
    sort_elements();
    number_new_nodes();
    remove_elements();
    remove_nodes();
    replace_nodes();
    move_nodes();
    return std::move(out_);
  }

 private:
  Vec3 input_position(NodeRef n) const { return inputs_[n.input]->position[n.node.value]; }

  const Corefined::Move* move_of(NodeRef n) const {
    const auto it = std::ranges::lower_bound(corefined_.moves, n, {}, &Corefined::Move::node);
    return it != corefined_.moves.end() && it->node == n ? &*it : nullptr;
  }

  /// The input node each vertex of the final complex is: it stands where the node stood, or where
  /// the node was pulled to. Any other vertex is new, whatever it descends from.
  void identify_vertices() {
    out_.node.resize(final_.n_vertices());
    for (std::size_t v = 0; v < final_.n_vertices(); ++v)
      if (const NodeRef n = final_.node[v]; n.valid() && final_.position[v] == place_of_node(n)) out_.node[v] = n;
    index_vertices();
    give_back_nodes();
    index_vertices();
  }

  Vec3 place_of_node(NodeRef n) const {
    const Corefined::Move* move = move_of(n);
    return move != nullptr ? move->to : input_position(n);
  }

  using Place = std::array<double, 3>;
  static Place key_of(Vec3 p) { return {p.x, p.y, p.z}; }

  void index_vertices() {
    vertex_of_.clear();
    for (std::size_t v = 0; v < out_.node.size(); ++v)
      if (out_.node[v].valid()) vertex_of_.emplace_back(out_.node[v], VertexId(v));
    std::sort(vertex_of_.begin(), vertex_of_.end());
  }

  /// A vertex put exactly where a node was that nothing else claims is that node: its label stays.
  void give_back_nodes() {
    std::vector<std::pair<Place, NodeRef>> left;  // the base first where several inputs had one
    for (std::size_t v = 0; v < original_.n_vertices(); ++v) {
      const NodeRef n = original_.node[v];
      const bool replaced = std::ranges::binary_search(corefined_.replaced, n, {}, &Corefined::Replaced::node);
      if (n.valid() && !replaced && !vertex_of(n).valid()) left.emplace_back(key_of(place_of_node(n)), n);
    }
    std::sort(left.begin(), left.end());
    std::vector<bool> taken(left.size());
    for (std::size_t v = 0; v < out_.node.size(); ++v) {
      if (out_.node[v].valid()) continue;
      const auto it = std::ranges::lower_bound(left, key_of(final_.position[v]), {}, &std::pair<Place, NodeRef>::first);
      const auto k = static_cast<std::size_t>(it - left.begin());
      if (it == left.end() || it->first != key_of(final_.position[v]) || taken[k]) continue;
      taken[k] = true;
      out_.node[v] = it->second;
    }
  }

  VertexId vertex_of(NodeRef n) const {
    const auto it = std::ranges::lower_bound(vertex_of_, n, {}, &std::pair<NodeRef, VertexId>::first);
    return it != vertex_of_.end() && it->first == n ? it->second : VertexId{};
  }

  using NewVertices = std::vector<std::pair<Place, VertexId>>;  // ascending

  NewVertices new_vertices() const {
    NewVertices all;
    for (std::size_t v = 0; v < final_.n_vertices(); ++v)
      if (!out_.node[v].valid()) all.emplace_back(key_of(final_.position[v]), v);
    std::sort(all.begin(), all.end());
    return all;
  }

  /// The first new vertex of the final complex at a place; for vertices made by the intersection.
  static VertexId vertex_at(Vec3 p, const NewVertices& among) {
    const auto it = std::ranges::lower_bound(among, key_of(p), {}, &NewVertices::value_type::first);
    return it != among.end() && it->first == key_of(p) ? it->second : VertexId{};
  }

  void find_swaps() {
    if (corefined_.replaced.empty()) return;
    const NewVertices made = new_vertices();
    for (const Corefined::Replaced& r : corefined_.replaced) {
      const NodeRef by = corefined_.complex.node[r.by.value];
      const VertexId v = by.valid() ? vertex_of(by) : vertex_at(corefined_.complex.position[r.by.value], made);
      if (v.valid()) swaps_.push_back({r.node, v});
    }
    std::sort(swaps_.begin(), swaps_.end());
  }

  const Swap* swap_of(NodeRef n) const {
    const auto it = std::ranges::lower_bound(swaps_, n, {}, &Swap::node);
    return it != swaps_.end() && it->node == n ? &*it : nullptr;
  }

  /// Whether vertex v is node n of an input, or what replaced it.
  bool is_node(VertexId v, NodeRef n) const {
    if (out_.node[v.value] == n) return true;
    const Swap* swap = swap_of(n);
    return swap != nullptr && swap->vertex == v;
  }

  bool is_kept_face(std::size_t f) const {
    const ElementRef parent = final_.parent[f];
    const auto nodes = inputs_[parent.input]->nodes_of(parent.element);
    const auto& v = final_.face[f];
    const auto same = [&](std::size_t corner, std::size_t k) { return is_node(v[corner], {parent.input, nodes[k]}); };
    for (std::size_t turn = 0; turn < 3; ++turn)
      if (same(0, turn) && same(1, (turn + 1) % 3) && same(2, (turn + 2) % 3)) return true;
    return false;
  }

  /// Whether a corner of a kept face is at another place than in its input.
  bool is_moved_face(std::size_t f) const {
    const ElementRef parent = final_.parent[f];
    const Triangle before = inputs_[parent.input]->corners(parent.element);
    return std::ranges::any_of(final_.face[f], [&](VertexId v) {
      return std::ranges::find(before, final_.position[v.value]) == before.end();
    });
  }

  bool is_kept_line(const Complex::Line& line) const {
    const auto nodes = inputs_[line.parent.input]->nodes_of(line.parent.element);
    return is_node(line.ends[0], {line.parent.input, nodes[0]}) && is_node(line.ends[1], {line.parent.input, nodes[1]});
  }

  /// Tells kept from new elements; positions of the new ones follow their parents.
  void sort_elements() {
    out_.new_element.assign(final_.n_faces(), Stitched::kKept);
    out_.changed.assign(final_.n_faces(), 0);
    const auto n_faces = static_cast<std::uint32_t>(final_.n_faces());
    std::vector<std::uint8_t> kept(n_faces);
    for_blocks(
        n_faces,
        [&](std::size_t first, std::size_t last) {
          for (std::size_t f = first; f < last; ++f) {
            kept[f] = is_kept_face(f) ? 1 : 0;
            out_.changed[f] = kept[f] == 0 || is_moved_face(f) ? 1 : 0;
          }
        },
        kFaceBlock);
    std::vector<std::pair<ElementRef, std::uint32_t>> fresh;  // faces, then lines
    for (std::uint32_t f = 0; f < n_faces; ++f) {
      if (kept[f] != 0)
        kept_.push_back(final_.parent[f]);
      else
        fresh.emplace_back(final_.parent[f], f);
      if (kept[f] != 0 && !final_.layers_of(FaceId(f)).empty()) join_groups(f);
    }
    for (std::uint32_t k = 0; k < final_.lines.size(); ++k)
      if (is_kept_line(final_.lines[k]))
        kept_.push_back(final_.lines[k].parent);
      else
        fresh.emplace_back(final_.lines[k].parent, n_faces + k);
    std::ranges::sort(graft_.joined_elements, {}, &Graft::JoinedElement::element);
    std::sort(fresh.begin(), fresh.end());
    make_distinct(kept_);
    for (const auto& [parent, item] : fresh) {
      if (item < n_faces) out_.new_element[item] = static_cast<std::uint32_t>(new_items_.size());
      new_items_.push_back(item);
    }
  }

  /// A kept face that stands for others too is in their groups as well.
  void join_groups(std::size_t f) {
    const ElementRef parent = final_.parent[f];
    if (faces_of_inputs_.empty()) {
      for (std::size_t k = 0; k < original_.n_faces(); ++k)
        faces_of_inputs_.emplace_back(original_.parent[k], original_.face_groups[k]);
      std::ranges::sort(faces_of_inputs_);
    }
    const auto own = std::ranges::lower_bound(faces_of_inputs_, parent, {}, &std::pair<ElementRef, GroupSetId>::first);
    const GroupSetId beyond = graft_.group_sets.subtract(final_.face_groups[f], own->second);
    if (beyond != GroupSets::kEmpty) graft_.joined_elements.push_back({parent, beyond});
  }

  std::span<const VertexId> vertices_of(std::uint32_t item) const {
    const auto n_faces = static_cast<std::uint32_t>(final_.n_faces());
    if (item < n_faces) return final_.face[item];
    return final_.lines[item - n_faces].ends;
  }

  void number_new_nodes() {
    for (const std::uint32_t item : new_items_) {
      const std::size_t n_faces = final_.n_faces();
      NewElement e;
      e.parent = item < n_faces ? final_.parent[item] : final_.lines[item - n_faces].parent;
      e.groups = item < n_faces ? final_.face_groups[item] : final_.lines[item - n_faces].groups;
      std::size_t corner = 0;
      for (const VertexId v : vertices_of(item)) {
        NodeRef& node = out_.node[v.value];
        if (!node.valid()) {
          const NodeRef like{e.parent.input, inputs_[e.parent.input]->nodes_of(e.parent.element)[0]};
          node = {kNew, NodeId(graft_.new_nodes.size())};
          graft_.new_nodes.push_back({final_.position[v.value], like, final_.vertex_groups[v.value]});
        }
        e.nodes[corner++] = node;
      }
      graft_.new_elements.push_back(e);
    }
  }

  void remove_elements() {
    std::vector<ElementRef> before = original_.parent;
    for (const Complex::Line& line : original_.lines) before.push_back(line.parent);
    make_distinct(before);
    graft_.removed_elements.resize(inputs_.size());
    for (const ElementRef e : before)
      if (!contains(kept_, e)) graft_.removed_elements[e.input].push_back(e.element);
  }

  void remove_nodes() {
    std::vector<std::uint8_t> is_used(final_.n_vertices());
    const auto use = [&](VertexId v) { is_used[v.value] = 1; };
    for (const auto& face : final_.face) std::ranges::for_each(face, use);
    for (const Complex::Line& line : final_.lines) std::ranges::for_each(line.ends, use);
    std::vector<NodeRef> used;
    for (std::size_t v = 0; v < is_used.size(); ++v)
      if (const NodeRef n = out_.node[v]; is_used[v] != 0 && n.valid() && n.input != kNew) used.push_back(n);
    make_distinct(used);

    std::vector<NodeRef> removed;
    for (std::size_t v = 0; v < original_.n_vertices(); ++v) {
      const NodeRef n = original_.node[v];
      if (!n.valid() || contains(used, n)) continue;
      const bool must_stay = original_.state[v] != VertexState::kOpen;
      const bool replaced = swap_of(n) != nullptr;
      if (must_stay && !replaced && !vertex_of(n).valid()) out_.lost_nodes.push_back(n);
      if (!must_stay || replaced) removed.push_back(n);
    }
    make_distinct(removed);
    make_distinct(out_.lost_nodes);
    graft_.removed_nodes.resize(inputs_.size());
    for (const NodeRef n : removed) graft_.removed_nodes[n.input].push_back(n.node);
  }

  void replace_nodes() {
    for (const Swap& swap : swaps_)
      if (out_.node[swap.vertex.value].valid())
        graft_.replaced_nodes.push_back({swap.node, out_.node[swap.vertex.value]});
  }

  void move_nodes() {
    for (const Corefined::Move& move : corefined_.moves) {
      const bool stays = vertex_of(move.node).valid() &&
                         !std::ranges::binary_search(graft_.removed_nodes[move.node.input], move.node.node);
      if (stays && move.to != input_position(move.node)) graft_.moved_nodes.push_back({move.node, move.to});
    }
  }

  Inputs inputs_;
  const Complex& original_;
  const Corefined& corefined_;
  const Complex& final_;
  Graft& graft_;

  Stitched out_;
  std::vector<std::pair<NodeRef, VertexId>> vertex_of_;             // ascending; identified vertices
  std::vector<std::pair<ElementRef, GroupSetId>> faces_of_inputs_;  // ascending, filled when needed
  std::vector<Swap> swaps_;                                         // ascending
  std::vector<ElementRef> kept_;                                    // ascending
  std::vector<std::uint32_t> new_items_;                            // faces, then lines; in the order of new_elements
};

}  // namespace

Stitched stitch(Inputs inputs, const Complex& original, const Corefined& corefined, const Complex& final_complex,
                Graft& graft) {
  return Stitcher(inputs, original, corefined, final_complex, graft).run();
}

}  // namespace meshgraft
