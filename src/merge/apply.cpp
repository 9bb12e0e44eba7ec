// The merged model as arrays.
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "core/room.hpp"
#include "merge/group_table.hpp"
#include "meshgraft/merge.hpp"

namespace meshgraft {
namespace {

using Run = std::array<std::size_t, 2>;  // first, last + 1

/// The runs of positions below n that are not in `removed` (ascending).
template <class Id>
std::vector<Run> kept_runs(std::size_t n, const std::vector<Id>& removed) {
  std::vector<Run> runs;
  std::size_t first = 0;
  for (const Id id : removed) {
    if (id.value > first) runs.push_back({first, id.value});
    first = std::size_t{id.value} + 1;
  }
  if (n > first) runs.push_back({first, n});
  return runs;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from, std::size_t first, std::size_t last) {
  const auto low = from.begin() + static_cast<std::ptrdiff_t>(first);
  to.insert(to.end(), low, low + static_cast<std::ptrdiff_t>(last - first));
}

/// Ids of an input in terms of the result; invalid ones stay invalid.
template <class Id>
class Table {
 public:
  explicit Table(std::vector<Id> to) : to_(std::move(to)) {
    for (std::size_t k = 0; k < to_.size(); ++k) is_identity_ = is_identity_ && to_[k] == Id(k);
  }
  [[nodiscard]] Id operator[](Id id) const { return to_[id.value]; }
  /// Translates the ids from position `first` on.
  void translate(std::vector<Id>& ids, std::size_t first) const {
    if (is_identity_) return;
    for (Id& id : std::span(ids).subspan(first))
      if (id.valid()) id = to_[id.value];
  }

 private:
  std::vector<Id> to_;
  bool is_identity_ = true;
};

class Assembly {
 public:
  Assembly(Inputs inputs, const Merged& merged)
      : inputs_(inputs), graft_(merged.graft), labels_(merged.labels), out_() {
    out_.group_sets = graft_.group_sets;
  }

  Model run() {
    out_.path = inputs_[0]->path;
    for (const Model* model : inputs_)
      if (!out_.units) out_.units = model->units;
    name_groups();
    number_nodes();
    number_elements();
    tbb::parallel_invoke([&] { add_nodes_of_elements(); }, [&] { add_positions(); }, [&] { add_element_labels(); },
                         [&] { add_first_nodes(); }, [&] { add_element_attributes(); }, [&] { add_element_groups(); },
                         [&] { add_node_labels(); }, [&] { add_node_groups(); });
    join_groups();
    add_orientation_nodes();
    count_members();
    return std::move(out_);
  }

 private:
  /// Groups of the first input that has them; a number already taken becomes the next free one.
  void name_groups() {
    std::set<std::int64_t> taken;
    of_input_.groups = graft_.groups;
    for (const Model* model : inputs_) of_input_.of_input.emplace_back(model->groups.size());
    for (std::size_t g = 0; g < graft_.groups.size(); ++g) {
      const MergedGroup& merged = graft_.groups[g];
      const MergedGroup::From first = merged.from.front();
      Group group = inputs_[first.input]->groups[first.group.value];
      group.place = 0, group.n_nodes = 0, group.n_elements = 0, group.n_other = 0, group.n_dangling = 0;
      if (first.input > 0 && taken.contains(group.number)) group.number = *taken.rbegin() + 1;
      taken.insert(group.number);
      for (const MergedGroup::From from : merged.from) {
        of_input_.of_input[from.input][from.group.value] = GroupId(g);
        group.n_other += inputs_[from.input]->groups[from.group.value].n_other;
        group.n_dangling += inputs_[from.input]->groups[from.group.value].n_dangling;
      }
      out_.groups.push_back(std::move(group));
    }
    translated_.emplace(inputs_, of_input_, out_.group_sets);
  }

  void number_nodes() {
    std::size_t id = 0;
    for (std::uint32_t k = 0; k < inputs_.size(); ++k) {
      const Model& model = *inputs_[k];
      node_runs_.push_back(kept_runs(model.n_nodes(), graft_.removed_nodes[k]));
      std::vector<NodeId>& ids = node_ids_.emplace_back(model.n_nodes());
      for (const auto [first, last] : node_runs_[k])
        for (std::size_t n = first; n < last; ++n) ids[n] = NodeId(id++);
    }
    first_new_ = id;
    for (const Graft::ReplacedNode& r : graft_.replaced_nodes) node_ids_[r.node.input][r.node.node.value] = id_of(r.by);
  }

  void number_elements() {
    std::size_t id = 0;
    for (std::uint32_t k = 0; k < inputs_.size(); ++k) {
      const Model& model = *inputs_[k];
      element_runs_.push_back(kept_runs(model.n_elements(), graft_.removed_elements[k]));
      first_of_input_.push_back(id);
      for (const auto [first, last] : element_runs_[k]) id += last - first;
      std::vector<AttributesId> own;
      for (const ElementAttributes& a : model.attributes) own.push_back(attributes(a));
      attribute_ids_.emplace_back(std::move(own));
      std::vector<GroupSetId> sets;
      for (std::size_t s = 0; s < model.group_sets.size(); ++s) sets.push_back((*translated_)(k, GroupSetId(s)));
      sets_.emplace_back(std::move(sets));
    }
    first_new_element_ = id;
  }

  // Each of the following makes one array, so that they can do so at the same time.

  /// What is kept of an array of each input, and room for `n_new` more. Calls done(k, first) when that of input k is
  /// there, from position `first` on.
  template <class T, class F>
  void gather(std::vector<T>& to, std::vector<T> Model::*array, const std::vector<std::vector<Run>>& runs,
              std::size_t n_new, F&& done) const {
    std::size_t n = n_new;
    for (const auto& of_input : runs)
      for (const auto [first, last] : of_input) n += last - first;
    make_room(to, n);
    for (std::uint32_t k = 0; k < inputs_.size(); ++k) {
      const std::size_t begin = to.size();
      for (const auto [first, last] : runs[k]) append(to, inputs_[k]->*array, first, last);
      done(k, begin);
    }
  }

  void add_positions() {
    gather(out_.position, &Model::position, node_runs_, graft_.new_nodes.size(), [](std::uint32_t, std::size_t) {});
    for (const Graft::MovedNode& m : graft_.moved_nodes) out_.position[id_of(m.node).value] = m.to;
    for (const NewNode& n : graft_.new_nodes) out_.position.push_back(n.position);
  }

  void add_node_labels() {
    gather(out_.node_label, &Model::node_label, node_runs_, graft_.new_nodes.size(), [&](std::uint32_t k, std::size_t) {
      for (const NodeId n : labels_.shifted_nodes[k])
        if (!std::ranges::binary_search(graft_.removed_nodes[k], n))
          out_.node_label[node_ids_[k][n.value].value] += labels_.node_shift[k];
    });
    for (std::size_t i = 0; i < graft_.new_nodes.size(); ++i)
      out_.node_label.push_back(labels_.first_new_node + static_cast<std::int64_t>(i));
  }

  void add_node_groups() {
    gather(out_.node_groups, &Model::node_groups, node_runs_, graft_.new_nodes.size(),
           [&](std::uint32_t k, std::size_t first) { sets_[k].translate(out_.node_groups, first); });
    for (const NewNode& n : graft_.new_nodes) out_.node_groups.push_back(n.groups);
  }

  void add_element_labels() {
    gather(out_.element_label, &Model::element_label, element_runs_, graft_.new_elements.size(),
           [&](std::uint32_t k, std::size_t) {
             for (const ElementId e : labels_.shifted_elements[k])
               if (const ElementId id = id_of(ElementRef{k, e}); id.valid())
                 out_.element_label[id.value] += labels_.element_shift[k];
           });
    for (std::size_t i = 0; i < graft_.new_elements.size(); ++i)
      out_.element_label.push_back(labels_.first_new_element + static_cast<std::int64_t>(i));
  }

  void add_element_attributes() {
    gather(out_.element_attributes, &Model::element_attributes, element_runs_, graft_.new_elements.size(),
           [&](std::uint32_t k, std::size_t first) { attribute_ids_[k].translate(out_.element_attributes, first); });
    for (const NewElement& e : graft_.new_elements) {
      const AttributesId own = inputs_[e.parent.input]->element_attributes[e.parent.element.value];
      out_.element_attributes.push_back(attribute_ids_[e.parent.input][own]);
    }
  }

  void add_element_groups() {
    gather(out_.element_groups, &Model::element_groups, element_runs_, graft_.new_elements.size(),
           [&](std::uint32_t k, std::size_t first) { sets_[k].translate(out_.element_groups, first); });
    for (const NewElement& e : graft_.new_elements) out_.element_groups.push_back(e.groups);
  }

  void add_first_nodes() {
    make_room(out_.first_node, first_new_element_ + graft_.new_elements.size() + 1);
    out_.first_node.push_back(0);
    for (std::uint32_t k = 0; k < inputs_.size(); ++k) {
      const Model& model = *inputs_[k];
      for (const auto [first, last] : element_runs_[k]) {
        const std::uint32_t ahead = out_.first_node.back() - model.first_node[first];  // modulo 2^32
        append(out_.first_node, model.first_node, first + 1, last + 1);
        for (std::uint32_t& offset : std::span(out_.first_node).last(last - first)) offset += ahead;
      }
    }
    for (const NewElement& e : graft_.new_elements) {
      const auto n_nodes = std::ranges::count_if(e.nodes, [](NodeRef n) { return n.valid(); });
      out_.first_node.push_back(out_.first_node.back() + static_cast<std::uint32_t>(n_nodes));
    }
  }

  void add_nodes_of_elements() {
    std::size_t uses = 3 * graft_.new_elements.size();
    for (const Model* model : inputs_) uses += model->nodes.size();
    make_room(out_.nodes, uses);
    for (std::uint32_t k = 0; k < inputs_.size(); ++k) {
      const Model& model = *inputs_[k];
      for (const auto [first, last] : element_runs_[k]) {
        const std::size_t begin = out_.nodes.size();
        append(out_.nodes, model.nodes, model.first_node[first], model.first_node[last]);
        for (NodeId& n : std::span(out_.nodes).subspan(begin))
          if (n.valid()) n = node_ids_[k][n.value];
      }
    }
    for (const NewElement& e : graft_.new_elements)
      for (const NodeRef n : e.nodes)
        if (n.valid()) out_.nodes.push_back(id_of(n));
  }

  void join_groups() {
    for (const Graft::JoinedNode& j : graft_.joined_nodes) {
      GroupSetId& groups = out_.node_groups[id_of(j.node).value];
      groups = out_.group_sets.unite(groups, j.groups);
    }
    for (const Graft::JoinedElement& j : graft_.joined_elements) {
      GroupSetId& groups = out_.element_groups[id_of(j.element).value];
      groups = out_.group_sets.unite(groups, j.groups);
    }
  }

  NodeId id_of(NodeRef n) const {
    return n.input == kNew ? NodeId(first_new_ + n.node.value) : node_ids_[n.input][n.node.value];
  }

  AttributesId attributes(const ElementAttributes& a) {
    const auto it = std::ranges::find(out_.attributes, a);
    if (it != out_.attributes.end()) return AttributesId(static_cast<std::size_t>(it - out_.attributes.begin()));
    out_.attributes.push_back(a);
    return AttributesId(out_.attributes.size() - 1);
  }

  /// Position in the result; invalid if removed.
  ElementId id_of(ElementRef e) const {
    const auto& removed = graft_.removed_elements[e.input];
    const auto it = std::ranges::lower_bound(removed, e.element);
    if (it != removed.end() && *it == e.element) return {};
    return ElementId(first_of_input_[e.input] + e.element.value - static_cast<std::size_t>(it - removed.begin()));
  }

  /// The orientation node of an element, invalid if it has none.
  NodeRef orientation_node(ElementRef e) const {
    const auto& all = inputs_[e.input]->orientation_nodes;
    const auto it = std::ranges::lower_bound(all, e.element, {}, &OrientationNode::element);
    return it != all.end() && it->element == e.element ? NodeRef{e.input, it->node} : NodeRef{};
  }

  void add_orientation_nodes() {
    for (std::uint32_t k = 0; k < inputs_.size(); ++k)
      for (const OrientationNode& o : inputs_[k]->orientation_nodes)
        if (const ElementId id = id_of(ElementRef{k, o.element}); id.valid())
          out_.orientation_nodes.push_back({id, id_of(NodeRef{k, o.node})});
    for (std::size_t i = 0; i < graft_.new_elements.size(); ++i)
      if (const NodeRef n = orientation_node(graft_.new_elements[i].parent); n.valid())
        out_.orientation_nodes.push_back({ElementId(first_new_element_ + i), id_of(n)});
  }

  void count_members() {
    std::vector<std::uint64_t> nodes(out_.group_sets.size()), elements(out_.group_sets.size());
    for (const GroupSetId s : out_.node_groups) ++nodes[s.value];
    for (const GroupSetId s : out_.element_groups) ++elements[s.value];
    for (std::size_t s = 0; s < nodes.size(); ++s)
      for (const GroupId g : out_.group_sets.members(GroupSetId(s)))
        out_.groups[g.value].n_nodes += nodes[s], out_.groups[g.value].n_elements += elements[s];
  }

  Inputs inputs_;
  const Graft& graft_;
  const Labels& labels_;
  Model out_;
  GroupTable of_input_;
  std::optional<SetTranslation> translated_;
  std::vector<std::vector<Run>> node_runs_, element_runs_;  // by input: what is kept
  std::vector<std::vector<NodeId>> node_ids_;               // [input][node]: position of it, or of what replaced it
  std::vector<Table<AttributesId>> attribute_ids_;          // by input
  std::vector<Table<GroupSetId>> sets_;                     // by input
  std::vector<std::size_t> first_of_input_;                 // by input: position of its first element
  std::size_t first_new_ = 0, first_new_element_ = 0;
};

}  // namespace

Model apply(const Model& base, std::span<const Model> parts, const Merged& merged) {
  std::vector<const Model*> inputs{&base};
  for (const Model& part : parts) inputs.push_back(&part);
  return Assembly(inputs, merged).run();
}

}  // namespace meshgraft
