#include "meshgraft/model.hpp"

#include <algorithm>

#include "core/source.hpp"

namespace meshgraft {
namespace {

Place place_at(const Model& model, const std::vector<std::uint64_t>& places, std::uint32_t position) {
  if (!model.source || position >= places.size()) return {model.path, 0};
  return {model.path, model.source->line_of(places[position])};
}

// UNV descriptors; every format maps these two from its own ids.
constexpr std::int64_t kThinShellTriangle = 91, kLinearBeam = 21;
constexpr std::int64_t kDefaultColour = 7;

ElementAttributes simple(Shape shape, std::int64_t type, std::int64_t physical, std::int64_t material) {
  ElementAttributes a;
  a.shape = shape, a.type = type, a.physical = physical, a.material = material, a.colour = kDefaultColour;
  return a;
}

}  // namespace

Place place_of(const Model& model, NodeId node) { return place_at(model, model.node_place, node.value); }
Place place_of(const Model& model, ElementId element) { return place_at(model, model.element_place, element.value); }

CoordinateSystem Model::coordinate_system(std::int64_t label) const {
  const auto at = std::ranges::lower_bound(coordinate_systems, label, {}, &CoordinateSystem::label);
  if (at != coordinate_systems.end() && at->label == label) return *at;
  CoordinateSystem global;
  global.label = label;
  return global;
}

NodeId ModelBuilder::add_node(Vec3 position, std::int64_t label) {
  model_.position.push_back(position);
  model_.node_label.push_back(label != 0 ? label : static_cast<std::int64_t>(model_.position.size()));
  model_.node_groups.push_back(GroupSets::kEmpty);
  return NodeId(model_.position.size() - 1);
}

ElementId ModelBuilder::add_element(const ElementAttributes& a, std::span<const NodeId> nodes, std::int64_t label) {
  if (model_.first_node.empty()) model_.first_node.push_back(0);
  model_.nodes.insert(model_.nodes.end(), nodes.begin(), nodes.end());
  model_.first_node.push_back(static_cast<std::uint32_t>(model_.nodes.size()));
  model_.element_attributes.push_back(attributes(a));
  model_.element_groups.push_back(GroupSets::kEmpty);
  model_.element_label.push_back(label != 0 ? label : static_cast<std::int64_t>(model_.element_label.size() + 1));
  return ElementId(model_.element_label.size() - 1);
}

ElementId ModelBuilder::add_face(NodeId a, NodeId b, NodeId c, std::int64_t physical, std::int64_t material) {
  return add_element(simple(Shape::kTriangle, kThinShellTriangle, physical, material), std::array{a, b, c});
}

ElementId ModelBuilder::add_line(NodeId a, NodeId b, std::int64_t physical, std::int64_t material) {
  return add_element(simple(Shape::kLine, kLinearBeam, physical, material), std::array{a, b});
}

void ModelBuilder::add_to_group(const std::string& name, NodeId node) {
  const GroupId g = group(name);
  GroupSetId& set = model_.node_groups[node.value];
  model_.groups[g.value].n_nodes += model_.group_sets.contains(set, g) ? 0 : 1;
  set = model_.group_sets.with(set, g);
}

void ModelBuilder::add_to_group(const std::string& name, ElementId element) {
  const GroupId g = group(name);
  GroupSetId& set = model_.element_groups[element.value];
  model_.groups[g.value].n_elements += model_.group_sets.contains(set, g) ? 0 : 1;
  set = model_.group_sets.with(set, g);
}

Model ModelBuilder::build(std::string path) {
  if (model_.first_node.empty()) model_.first_node.push_back(0);
  model_.path = std::move(path);
  return std::exchange(model_, Model{});
}

GroupId ModelBuilder::group(const std::string& name) {
  const auto it = std::ranges::find(model_.groups, name, &Group::name);
  if (it != model_.groups.end()) return GroupId(static_cast<std::size_t>(it - model_.groups.begin()));
  Group g;
  g.name = name, g.number = static_cast<std::int64_t>(model_.groups.size() + 1);
  model_.groups.push_back(std::move(g));
  return GroupId(model_.groups.size() - 1);
}

AttributesId ModelBuilder::attributes(const ElementAttributes& a) {
  const auto it = std::ranges::find(model_.attributes, a);
  if (it != model_.attributes.end()) return AttributesId(static_cast<std::size_t>(it - model_.attributes.begin()));
  model_.attributes.push_back(a);
  return AttributesId(model_.attributes.size() - 1);
}

}  // namespace meshgraft
