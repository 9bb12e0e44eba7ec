// The merged model as arrays.
#include <algorithm>
#include <optional>
#include <set>

#include "merge/group_table.hpp"
#include "meshgraft/merge.hpp"

namespace meshgraft {
namespace {

/// Calls f(first, last) for each run of positions below n that are not in `removed` (ascending).
template <class Id, class F>
void for_each_kept_run(std::size_t n, const std::vector<Id>& removed, F&& f) {
  std::size_t first = 0;
  for (const Id id : removed) {
    if (id.value > first) f(first, std::size_t{id.value});
    first = std::size_t{id.value} + 1;
  }
  if (n > first) f(first, n);
}

/// Appends part of an array, each value through a table; a table that changes nothing costs nothing.
template <class Id>
void append(std::vector<Id>& to, const std::vector<Id>& from, std::size_t first, std::size_t last,
            const std::vector<Id>& table, bool is_identity) {
  const auto low = from.begin() + static_cast<std::ptrdiff_t>(first);
  to.insert(to.end(), low, low + static_cast<std::ptrdiff_t>(last - first));
  if (is_identity) return;
  for (Id& id : std::span(to).last(last - first))
    if (id.valid()) id = table[id.value];
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from, std::size_t first, std::size_t last) {
  const auto low = from.begin() + static_cast<std::ptrdiff_t>(first);
  to.insert(to.end(), low, low + static_cast<std::ptrdiff_t>(last - first));
}

template <class Id>
bool is_identity(const std::vector<Id>& table) {
  for (std::size_t k = 0; k < table.size(); ++k)
    if (table[k] != Id(k)) return false;
  return true;
}

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
    reserve();
    for (std::uint32_t k = 0; k < inputs_.size(); ++k) add_nodes(k);
    add_new_nodes();
    redirect_replaced();
    out_.first_node.push_back(0);
    for (std::uint32_t k = 0; k < inputs_.size(); ++k) add_elements(k);
    add_new_elements();
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

  void reserve() {
    std::size_t nodes = graft_.new_nodes.size(), elements = graft_.new_elements.size(), uses = 3 * elements;
    for (const Model* model : inputs_) {
      nodes += model->n_nodes(), elements += model->n_elements(), uses += model->nodes.size();
    }
    out_.position.reserve(nodes), out_.node_label.reserve(nodes), out_.node_groups.reserve(nodes);
    out_.element_label.reserve(elements), out_.element_attributes.reserve(elements);
    out_.element_groups.reserve(elements), out_.first_node.reserve(elements + 1), out_.nodes.reserve(uses);
  }

  /// Group sets of an input as merged ones, for all its sets.
  std::vector<GroupSetId> merged_sets(std::uint32_t k) {
    std::vector<GroupSetId> sets;
    for (std::size_t s = 0; s < inputs_[k]->group_sets.size(); ++s) sets.push_back((*translated_)(k, GroupSetId(s)));
    return sets;
  }

  void add_nodes(std::uint32_t k) {
    const Model& model = *inputs_[k];
    const std::vector<GroupSetId> sets = merged_sets(k);
    std::vector<NodeId>& ids = node_ids_.emplace_back(model.n_nodes());
    const bool same_sets = is_identity(sets);
    for_each_kept_run(model.n_nodes(), graft_.removed_nodes[k], [&](std::size_t first, std::size_t last) {
      std::size_t id = out_.position.size();
      for (std::size_t n = first; n < last; ++n) ids[n] = NodeId(id++);
      append(out_.position, model.position, first, last);
      append(out_.node_label, model.node_label, first, last);
      append(out_.node_groups, model.node_groups, first, last, sets, same_sets);
    });
    for (const NodeId n : labels_.shifted_nodes[k])
      if (ids[n.value].valid()) out_.node_label[ids[n.value].value] += labels_.node_shift[k];
    for (const Graft::MovedNode& m : graft_.moved_nodes)
      if (m.node.input == k) out_.position[ids[m.node.node.value].value] = m.to;
    for (const Graft::JoinedNode& j : graft_.joined_nodes) {
      if (j.node.input != k) continue;
      GroupSetId& groups = out_.node_groups[ids[j.node.node.value].value];
      groups = out_.group_sets.unite(groups, j.groups);
    }
  }

  void add_new_nodes() {
    first_new_ = out_.position.size();
    std::int64_t label = labels_.first_new_node;
    for (const NewNode& n : graft_.new_nodes) {
      out_.position.push_back(n.position);
      out_.node_label.push_back(label++);
      out_.node_groups.push_back(n.groups);
    }
  }

  void redirect_replaced() {
    for (const Graft::ReplacedNode& r : graft_.replaced_nodes) node_ids_[r.node.input][r.node.node.value] = id_of(r.by);
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

  void add_elements(std::uint32_t k) {
    const Model& model = *inputs_[k];
    const std::vector<GroupSetId> sets = merged_sets(k);
    const std::vector<NodeId>& ids = node_ids_[k];
    std::vector<AttributesId>& attribute_ids = attribute_ids_.emplace_back();
    for (const ElementAttributes& a : model.attributes) attribute_ids.push_back(attributes(a));
    const std::size_t first_element = out_.element_label.size();
    const bool same_sets = is_identity(sets), same_attributes = is_identity(attribute_ids);
    for_each_kept_run(model.n_elements(), graft_.removed_elements[k], [&](std::size_t first, std::size_t last) {
      append(out_.element_label, model.element_label, first, last);
      append(out_.element_attributes, model.element_attributes, first, last, attribute_ids, same_attributes);
      append(out_.element_groups, model.element_groups, first, last, sets, same_sets);
      const auto ahead = static_cast<std::uint32_t>(out_.nodes.size()) - model.first_node[first];  // modulo 2^32
      append(out_.first_node, model.first_node, first + 1, last + 1);
      for (std::uint32_t& offset : std::span(out_.first_node).last(last - first)) offset += ahead;
      append(out_.nodes, model.nodes, model.first_node[first], model.first_node[last], ids, false);
    });
    first_of_input_.push_back(first_element);
    for (const Graft::JoinedElement& j : graft_.joined_elements) {
      if (j.element.input != k) continue;
      GroupSetId& groups = out_.element_groups[id_of(j.element).value];
      groups = out_.group_sets.unite(groups, j.groups);
    }
    for (const ElementId e : labels_.shifted_elements[k])
      if (const ElementId id = id_of(ElementRef{k, e}); id.valid())
        out_.element_label[id.value] += labels_.element_shift[k];
  }

  /// Position in the result; invalid if removed.
  ElementId id_of(ElementRef e) const {
    const auto& removed = graft_.removed_elements[e.input];
    const auto it = std::ranges::lower_bound(removed, e.element);
    if (it != removed.end() && *it == e.element) return {};
    return ElementId(first_of_input_[e.input] + e.element.value - static_cast<std::size_t>(it - removed.begin()));
  }

  void add_new_elements() {
    first_new_element_ = out_.element_label.size();
    std::int64_t label = labels_.first_new_element;
    for (const NewElement& e : graft_.new_elements) {
      out_.element_label.push_back(label++);
      const AttributesId own = inputs_[e.parent.input]->element_attributes[e.parent.element.value];
      out_.element_attributes.push_back(attribute_ids_[e.parent.input][own.value]);
      out_.element_groups.push_back(e.groups);
      for (const NodeRef n : e.nodes)
        if (n.valid()) out_.nodes.push_back(id_of(n));
      out_.first_node.push_back(static_cast<std::uint32_t>(out_.nodes.size()));
    }
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
  std::vector<std::vector<NodeId>> node_ids_;             // [input][node]: position in the result
  std::vector<std::vector<AttributesId>> attribute_ids_;  // [input][attributes]
  std::vector<std::size_t> first_of_input_;               // [input]
  std::size_t first_new_ = 0, first_new_element_ = 0;
};

}  // namespace

Model apply(const Model& base, std::span<const Model> parts, const Merged& merged) {
  std::vector<const Model*> inputs{&base};
  for (const Model& part : parts) inputs.push_back(&part);
  return Assembly(inputs, merged).run();
}

}  // namespace meshgraft
