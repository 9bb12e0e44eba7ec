#include "merge/components.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <tuple>

#include "core/union_find.hpp"

namespace meshgraft {
namespace {

bool is_surface(Shape s) {
  return s == Shape::kTriangle || s == Shape::kTriangle6 || s == Shape::kQuad || s == Shape::kQuad8;
}

/// By element: the smallest node of the connected mesh that a surface element is in.
std::vector<std::uint32_t> connected_meshes(const Model& model) {
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  UnionFind sets(model.n_nodes());
  std::vector<std::uint32_t> mesh(model.n_elements(), kNone);
  const auto first_node = [&](std::size_t e) {
    const auto nodes = model.nodes_of(ElementId(e));
    const auto first = std::ranges::find_if(nodes, &NodeId::valid);
    return is_surface(model.shape(ElementId(e))) && first != nodes.end() ? *first : NodeId{};
  };
  for (std::size_t e = 0; e < mesh.size(); ++e)
    if (const NodeId first = first_node(e); first.valid())
      for (const NodeId n : model.nodes_of(ElementId(e)))
        if (n.valid()) sets.unite(first.value, n.value);
  for (std::size_t e = 0; e < mesh.size(); ++e)
    if (const NodeId first = first_node(e); first.valid()) mesh[e] = sets.find(first.value);
  return mesh;
}

std::vector<std::string> names_of_groups(const Model& model) {
  std::vector<std::string> names;
  for (const Group& group : model.groups) names.push_back(group.name);
  return names;
}

/// The base, then the parts by number of elements, and those of equal numbers by their groups, labels and elements:
/// wherever they are and however they are given, the order is the same. Only what has all these in common is told apart
/// by its place.
std::vector<std::uint32_t> order_of(Inputs inputs) {
  std::vector<std::uint32_t> order(inputs.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto coordinates = [](Vec3 a, Vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  std::stable_sort(order.begin() + 1, order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const Model &a = *inputs[i], &b = *inputs[j];
    if (a.n_elements() != b.n_elements()) return a.n_elements() > b.n_elements();
    if (const auto names = names_of_groups(a) <=> names_of_groups(b); names != 0) return names < 0;
    const auto numbers =
        std::tie(a.node_label, a.element_label, a.nodes) <=> std::tie(b.node_label, b.element_label, b.nodes);
    if (numbers != 0) return numbers < 0;
    return std::lexicographical_compare(a.position.begin(), a.position.end(), b.position.begin(), b.position.end(),
                                        coordinates);
  });
  return order;
}

/// The groups named in joins, as sets of one or more.
class JoinGroups {
 public:
  explicit JoinGroups(const std::vector<JoinedGroups>& joins) : joins_(joins) {
    for (const JoinedGroups& j : joins) names_.insert(names_.end(), {j.a, j.b});
    std::sort(names_.begin(), names_.end());
    names_.erase(std::unique(names_.begin(), names_.end()), names_.end());
    seen_.resize(names_.size());
  }

  /// By group set of a model: the kind of the faces in it.
  std::vector<std::uint32_t> kinds_in(const Model& model) {
    std::vector<std::uint32_t> kinds(model.group_sets.size());
    for (std::size_t s = 0; s < kinds.size(); ++s) {
      std::vector<std::uint32_t> named;
      for (const GroupId g : model.group_sets.members(GroupSetId(s)))
        if (const auto at = std::ranges::lower_bound(names_, model.groups[g.value].name);
            at != names_.end() && *at == model.groups[g.value].name)
          named.push_back(static_cast<std::uint32_t>(at - names_.begin()));
      std::sort(named.begin(), named.end());
      named.erase(std::unique(named.begin(), named.end()), named.end());
      kinds[s] = kind_of_.try_emplace(named, static_cast<std::uint32_t>(kind_of_.size())).first->second;
    }
    return kinds;
  }

  void has_face(std::uint32_t kind) {
    for (const auto& [named, k] : kind_of_)
      if (k == kind)
        for (const std::uint32_t name : named) seen_[name] = 1;
  }

  [[nodiscard]] const std::string* without_faces() const {
    const auto at = std::ranges::find(seen_, 0);
    return at == seen_.end() ? nullptr : &names_[static_cast<std::size_t>(at - seen_.begin())];
  }

  /// Components::in_groups.
  [[nodiscard]] std::vector<std::vector<std::uint8_t>> in_groups() const {
    std::vector<std::vector<std::uint8_t>> in(kind_of_.size());
    for (const auto& [named, kind] : kind_of_)
      for (const JoinedGroups& j : joins_)
        in[kind].push_back(static_cast<std::uint8_t>((holds(named, j.a) ? 1 : 0) | (holds(named, j.b) ? 2 : 0)));
    return in;
  }

 private:
  [[nodiscard]] bool holds(const std::vector<std::uint32_t>& named, const std::string& name) const {
    return std::ranges::any_of(named, [&](std::uint32_t k) { return names_[k] == name; });
  }

  const std::vector<JoinedGroups>& joins_;
  std::vector<std::string> names_;  // ascending
  std::vector<std::uint8_t> seen_;  // by name: some face is in the group
  std::map<std::vector<std::uint32_t>, std::uint32_t> kind_of_;
};

/// A component before it has its number.
struct Draft {
  std::uint32_t mesh = 0, kind = 0;  // mesh: of the input
  std::size_t faces = 0;
  std::uint32_t first = 0;  // element
  friend bool operator<(const Draft& a, const Draft& b) {
    return a.faces != b.faces ? a.faces > b.faces : a.first < b.first;
  }
};

/// Adds the components of an input that is more than one.
void add_parted(const Model& model, std::uint32_t input, const std::vector<std::uint32_t>& mesh,
                const std::vector<std::uint32_t>& kind_of_set, Components& all) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Draft> drafts;
  const auto key = [&](std::size_t e) { return std::pair(mesh[e], kind_of_set[model.element_groups[e].value]); };
  for (std::uint32_t e = 0; e < model.n_elements(); ++e) {
    if (!is_surface(model.shape(ElementId(std::size_t{e})))) continue;
    Draft& draft = drafts.try_emplace(key(e), Draft{key(e).first, key(e).second, 0, e}).first->second;
    draft.faces += model.is_face(ElementId(std::size_t{e})) ? 1 : 0;
  }
  std::vector<Draft> sorted;
  for (const auto& [k, draft] : drafts) sorted.push_back(draft);
  std::sort(sorted.begin(), sorted.end());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> number;
  std::map<std::uint32_t, std::uint32_t> mesh_number;
  const auto n_meshes = all.joins.mesh.empty() ? 0 : 1 + *std::ranges::max_element(all.joins.mesh);
  for (const Draft& draft : sorted) {
    number[{draft.mesh, draft.kind}] = static_cast<std::uint32_t>(all.size());
    all.input.push_back(input);
    all.joins.kind.push_back(draft.kind);
    const auto fresh = n_meshes + static_cast<std::uint32_t>(mesh_number.size());
    all.joins.mesh.push_back(mesh_number.try_emplace(draft.mesh, fresh).first->second);
  }
  all.of_element[input].assign(model.n_elements(), 0);
  for (std::size_t e = 0; e < model.n_elements(); ++e)
    if (is_surface(model.shape(ElementId(e)))) all.of_element[input][e] = number[key(e)];
}

/// Sets what is joined from what the kinds are in.
void join_kinds(std::vector<std::vector<std::uint8_t>> in_groups, Components& all) {
  for (std::uint32_t a = 0; a < in_groups.size(); ++a)
    for (std::uint32_t b = 0; b < in_groups.size(); ++b)
      for (std::size_t j = 0; j < in_groups[a].size(); ++j)
        if (((in_groups[a][j] & 1) != 0 && (in_groups[b][j] & 2) != 0) ||
            ((in_groups[a][j] & 2) != 0 && (in_groups[b][j] & 1) != 0))
          all.joins.kinds.push_back({a, b});
  all.in_groups = std::move(in_groups);
}

}  // namespace

Result<Components> components_of(Inputs inputs, const MergeOptions& options) {
  Components all;
  all.input_order = order_of(inputs);
  all.of_input.resize(inputs.size());
  all.of_element.resize(inputs.size());
  if (inputs.size() > 1 && options.joins.empty()) {
    all.input = all.input_order;
    for (std::uint32_t c = 0; c < all.size(); ++c) all.of_input[all.input[c]] = c;
    return all;
  }
  JoinGroups groups(options.joins);
  for (const std::uint32_t k : all.input_order) {
    const Model& model = *inputs[k];
    const std::vector<std::uint32_t> kinds = groups.kinds_in(model);
    const bool one_mesh = inputs.size() > 1;
    add_parted(model, k, one_mesh ? std::vector<std::uint32_t>(model.n_elements()) : connected_meshes(model), kinds,
               all);
    std::vector<std::uint8_t> has_face(kinds.size());  // by group set
    for (std::size_t e = 0; e < model.n_elements(); ++e)
      if (model.is_face(ElementId(e))) has_face[model.element_groups[e].value] = 1;
    for (std::size_t s = 0; s < kinds.size(); ++s)
      if (has_face[s] != 0) groups.has_face(kinds[s]);
  }
  if (const std::string* name = groups.without_faces())
    return failure(ErrorCode::kUsage, "no triangle is in a group named " + *name + ", which is to be joined",
                   "meshgraft info -v FILE lists the groups of a file; names are compared letter by letter");
  if (options.joins.empty())
    all.joins.kind.clear();
  else
    join_kinds(groups.in_groups(), all);
  return all;
}

std::vector<ComponentSummary> summaries_of(Inputs inputs, const Components& components) {
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<ComponentSummary> all(components.size());
  std::vector<GroupSetId> common(components.size());
  std::vector<std::uint32_t> first(components.size(), kNone);
  std::vector<GroupSets> sets;
  for (const Model* model : inputs) sets.push_back(model->group_sets);
  for (std::uint32_t k = 0; k < inputs.size(); ++k) {
    const Model& model = *inputs[k];
    for (std::size_t i = 0; i < model.n_elements(); ++i) {
      const ElementId e(i);
      if (!model.is_face(e)) continue;
      const std::uint32_t c = components.of({k, e});
      if (all[c].faces++ == 0)
        all[c].input = k, all[c].element = model.element_label[i], common[c] = model.element_groups[i];
      if (common[c] != model.element_groups[i]) common[c] = sets[k].intersect(common[c], model.element_groups[i]);
    }
  }
  for (std::size_t c = 0; c < all.size(); ++c)
    if (common[c].valid())
      for (const GroupId g : sets[all[c].input].members(common[c]))
        all[c].groups.push_back(inputs[all[c].input]->groups[g.value].name);
  return all;
}

}  // namespace meshgraft
