#include "search/workpiece.hpp"

#include <algorithm>

#include "core/bits.hpp"
#include "core/blocks.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

double longest_edge(const Triangle& t) {
  return std::max({distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])});
}

Box box_of(const Triangle& t) {
  Box box;
  for (const Vec3 p : t) box.add(p);
  return box;
}

/// The boxes of the candidates, each grown by its reach.
BoxTree region_around(std::span<const Model* const> inputs, std::span<const std::vector<ElementId>> candidates,
                      const WorkpieceOptions& options) {
  std::vector<Box> boxes;
  for (std::size_t k = 0; k < inputs.size(); ++k)
    for (const ElementId f : candidates[k]) {
      const Triangle t = inputs[k]->corners(f);
      boxes.push_back(box_of(t).grown(std::max(options.reach * longest_edge(t), options.least)));
    }
  return BoxTree(boxes);
}

Bits nodes_inside(const Model& model, const BoxTree& region) {
  Bits inside(model.n_nodes());
  const auto point = [&](std::size_t i) { return Box{model.position[i], model.position[i]}; };
  for_blocks(model.n_nodes(), [&](std::size_t first_of_block, std::size_t last_of_block) {
    for_runs(first_of_block, last_of_block, point, [&](std::size_t first, std::size_t last, const Box& run) {
      if (!region.meets(run)) return;
      for (std::size_t i = first; i < last; ++i)
        if (region.meets(point(i))) inside.set(i);
    });
  });
  return inside;
}

bool any_in(const Bits& set, std::span<const NodeId> nodes) {
  return std::any_of(nodes.begin(), nodes.end(), [&](NodeId v) { return v.valid() && set[v.value]; });
}

bool all_in(const Bits& set, std::span<const NodeId> nodes) {
  return std::all_of(nodes.begin(), nodes.end(), [&](NodeId v) { return v.valid() && set[v.value]; });
}

bool all_valid(std::span<const NodeId> nodes) {
  return std::all_of(nodes.begin(), nodes.end(), [](NodeId v) { return v.valid(); });
}

/// Faces of an input that meet the region and have all their nodes.
std::vector<ElementId> faces_inside(const Model& model, std::uint32_t input, const FaceRuns& runs,
                                    const BoxTree& region, const Bits& inside) {
  const auto near = [&](std::size_t, std::size_t, const Box& run) { return region.meets(run); };
  return runs.collected_by_run<ElementId>(
      input, model.n_elements(), near, [&](ElementId e, std::vector<ElementId>& out) {
        const Box box = box_of_face(model, e);
        if (!box.empty() && (any_in(inside, model.nodes_of(e)) || region.meets(box))) out.push_back(e);
      });
}

/// Elements other than faces that touch the region or lie between nodes in `taken`.
std::vector<ElementId> others_near(const Model& model, const Bits& inside, const Bits& taken) {
  return collected<ElementId>(model.n_elements(), [&](std::size_t i, std::vector<ElementId>& out) {
    const ElementId e(i);
    if (model.is_face(e)) return;
    const auto nodes = model.nodes_of(e);
    if (any_in(inside, nodes) || (model.shape(e) == Shape::kLine ? all_in(taken, nodes) : any_in(taken, nodes)))
      out.push_back(e);
  });
}

/// The attributes that occur in a complex, one id each whatever the input.
class AttributesTable {
 public:
  AttributesId id(const ElementAttributes& attributes) {
    const auto at = static_cast<std::size_t>(std::find(table_.begin(), table_.end(), attributes) - table_.begin());
    if (at == table_.size()) table_.push_back(attributes);
    return AttributesId(at);
  }

 private:
  std::vector<ElementAttributes> table_;
};

/// Ids of one input in terms of the complex; each is translated once.
class Translation {
 public:
  Translation(const Model& model, std::span<const GroupId> merged_group, GroupSets& merged_sets, AttributesTable& table)
      : model_(model),
        merged_group_(merged_group),
        merged_sets_(merged_sets),
        table_(table),
        sets_(model.group_sets.size()),
        attributes_(model.attributes.size()) {}

  GroupSetId groups(GroupSetId set) {
    GroupSetId& to = sets_[set.value];
    if (!to.valid()) {
      std::vector<GroupId> members;
      for (const GroupId g : model_.group_sets.members(set)) members.push_back(merged_group_[g.value]);
      to = merged_sets_.intern(std::move(members));
    }
    return to;
  }

  AttributesId attributes(AttributesId own) {
    AttributesId& to = attributes_[own.value];
    if (!to.valid()) to = table_.id(model_.attributes[own.value]);
    return to;
  }

 private:
  const Model& model_;
  std::span<const GroupId> merged_group_;
  GroupSets& merged_sets_;
  AttributesTable& table_;
  std::vector<GroupSetId> sets_;
  std::vector<AttributesId> attributes_;
};

/// Adds one input to the complex.
class Cutter {
 public:
  Cutter(Complex& complex, const Model& model, std::uint32_t input, const Components& components,
         Translation translation)
      : complex_(complex),
        model_(model),
        input_(input),
        components_(components),
        translation_(std::move(translation)),
        taken_(model.n_nodes()) {}

  void cut(const BoxTree& region, const FaceRuns& runs) {
    const Bits inside = nodes_inside(model_, region);
    const std::vector<ElementId> faces = faces_inside(model_, input_, runs, region, inside);
    for (const ElementId f : faces)
      for (const NodeId v : model_.nodes_of(f)) taken_.set(v.value);
    const std::vector<ElementId> others = others_near(model_, inside, taken_);
    for (const ElementId e : others)
      if (is_line(e))
        for (const NodeId v : model_.nodes_of(e)) taken_.set(v.value);

    add_vertices(inside);
    for (const ElementId f : faces) add_face(f);
    for (const ElementId e : others) {
      if (is_line(e))
        add_line(e);
      else
        constrain(e);
    }
    for (const OrientationNode& o : model_.orientation_nodes) pin(o.node);
    keep_fixed_edges_of_faces();
  }

 private:
  [[nodiscard]] bool is_line(ElementId e) const {
    return model_.shape(e) == Shape::kLine && all_valid(model_.nodes_of(e));
  }

  void add_vertices(const Bits& inside) {
    first_vertex_ = complex_.n_vertices();
    taken_.count();
    taken_.each([&](std::size_t i) {
      complex_.add_vertex(model_.position[i], {input_, NodeId(i)},
                          inside[i] ? VertexState::kOpen : VertexState::kFrozen,
                          translation_.groups(model_.node_groups[i]));
    });
  }

  /// The vertex of a node; invalid if it is not in the complex.
  [[nodiscard]] VertexId vertex(NodeId node) const {
    return taken_[node.value] ? VertexId(first_vertex_ + taken_.rank(node.value)) : VertexId{};
  }

  void add_face(ElementId e) {
    const auto nodes = model_.nodes_of(e);
    complex_.face.push_back({vertex(nodes[0]), vertex(nodes[1]), vertex(nodes[2])});
    complex_.parent.push_back({input_, e});
    complex_.component.push_back(components_.of({input_, e}));
    complex_.face_groups.push_back(translation_.groups(model_.element_groups[e.value]));
    complex_.face_attributes.push_back(translation_.attributes(model_.element_attributes[e.value]));
  }

  void add_line(ElementId e) {
    const auto nodes = model_.nodes_of(e);
    complex_.lines.push_back({{vertex(nodes[0]), vertex(nodes[1])},
                              {input_, e},
                              translation_.groups(model_.element_groups[e.value]),
                              translation_.attributes(model_.element_attributes[e.value])});
  }

  void pin(NodeId node) {
    const VertexId v = node.valid() ? vertex(node) : VertexId{};
    if (v.valid() && complex_.state[v.value] == VertexState::kOpen) complex_.state[v.value] = VertexState::kPinned;
  }

  /// An element that is not remeshed keeps its nodes and, if it has sides, its edges.
  void constrain(ElementId e) {
    const auto nodes = model_.nodes_of(e);
    for (const NodeId v : nodes) pin(v);
    const Shape shape = model_.shape(e);
    if (shape == Shape::kPoint || shape == Shape::kOther) return;
    std::vector<VertexId> corners;
    for (const NodeId v : nodes)
      if (v.valid() && vertex(v).valid()) corners.push_back(vertex(v));
    for (std::size_t i = 0; i < corners.size(); ++i)
      for (std::size_t j = i + 1; j < corners.size(); ++j)
        if (corners[i] != corners[j])
          fixed_.push_back({std::min(corners[i], corners[j]), std::max(corners[i], corners[j])});
  }

  /// Of all pairs of nodes of the elements that are not remeshed, those that are an edge of a face
  /// here: the order of nodes differs between kinds of elements, but an edge of a face between two
  /// nodes of such an element is always one of its sides.
  void keep_fixed_edges_of_faces() {
    std::sort(fixed_.begin(), fixed_.end());
    fixed_.erase(std::unique(fixed_.begin(), fixed_.end()), fixed_.end());
    if (fixed_.empty()) return;
    std::vector<std::uint8_t> found(fixed_.size());
    for (const auto& f : complex_.face)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::array<VertexId, 2> edge{std::min(f[k], f[(k + 1) % 3]), std::max(f[k], f[(k + 1) % 3])};
        const auto at = std::lower_bound(fixed_.begin(), fixed_.end(), edge);
        if (at != fixed_.end() && *at == edge) found[static_cast<std::size_t>(at - fixed_.begin())] = 1;
      }
    for (std::size_t i = 0; i < fixed_.size(); ++i)
      if (found[i]) complex_.fixed_edges.push_back(fixed_[i]);
  }

  Complex& complex_;
  const Model& model_;
  std::uint32_t input_;
  const Components& components_;
  Translation translation_;
  Bits taken_;  // nodes that become vertices
  std::size_t first_vertex_ = 0;
  std::vector<std::array<VertexId, 2>> fixed_;
};

}  // namespace

Complex workpiece(std::span<const Model* const> inputs, const FaceRuns& runs, const Components& components,
                  std::span<const std::vector<ElementId>> candidates,
                  std::span<const std::vector<GroupId>> groups_of_input, GroupSets& merged_sets,
                  const WorkpieceOptions& options) {
  const BoxTree region = region_around(inputs, candidates, options);
  Complex complex;
  complex.joins = components.joins;
  AttributesTable table;
  for (const std::uint32_t k : components.input_order)
    Cutter(complex, *inputs[k], k, components, Translation(*inputs[k], groups_of_input[k], merged_sets, table))
        .cut(region, runs);
  return complex;
}

}  // namespace meshgraft
