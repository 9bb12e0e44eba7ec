// A finite-element model as read from a file: nodes, elements of every kind, attributes, groups.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "meshgraft/group_sets.hpp"
#include "meshgraft/id.hpp"
#include "meshgraft/result.hpp"
#include "meshgraft/vec3.hpp"

namespace meshgraft {

/// What an element is geometrically. Only kTriangle is ever remeshed and only kLine is ever
/// rebuilt along resampled edges; all others pass through, and pin the nodes they use.
enum class Shape : std::uint8_t {
  kPoint,      // masses, springs to ground
  kLine,       // 2 nodes: beams, rods, edges
  kLine3,      // 3 nodes in the order corner, middle, corner
  kTriangle,   // 3 nodes
  kTriangle6,  // parabolic, corner and middle nodes alternate
  kQuad,       // 4 nodes
  kQuad8,      // parabolic or higher quadrilateral, corner and middle nodes alternate
  kSolid,      // any solid
  kOther,      // rigid, spring, gap, unknown: keeps its nodes, has no surface
};

/// Everything the record of an element says besides its label and nodes; interned.
struct ElementAttributes {
  Shape shape = Shape::kOther;
  std::int64_t type = 0;  // id of the element type in its format (UNV: FE descriptor id)
  std::int64_t physical = 0, material = 0, colour = 0;
  std::int64_t physical_bin = 0, material_bin = 0;  // dataset 780 only
  friend bool operator==(const ElementAttributes&, const ElementAttributes&) = default;
};

/// A further node that the record of an element refers to (orientation node of a beam). It must
/// stay, but is not a node of the element.
struct OrientationNode {
  ElementId element;
  NodeId node;
};

/// A named set of nodes, of elements, or of both.
struct Group {
  std::string name;                           // trailing blanks removed; the raw bytes stay in the source
  std::int64_t number = 0;                    // payload; neither unique nor ordered
  std::uint64_t n_nodes = 0, n_elements = 0;  // entries that name an existing entity
  std::uint64_t n_other = 0, n_dangling = 0;  // other entity codes; entities that do not exist
  std::uint64_t place = 0;                    // byte offset of its first record in the source
};

/// Dataset 164: value in SI = value in the file divided by the factor.
struct Units {
  std::int64_t code = 0;
  double length = 1, force = 1, temperature = 1, temperature_offset = 0;
  friend bool operator==(const Units&, const Units&) = default;
};

/// A coordinate system that a file defines (UNV: datasets 2420 and 18) or that its nodes name: for their
/// coordinates, for showing them, or for their displacements. One that is named without being defined is
/// taken as the global one. Coordinates are never transformed.
struct CoordinateSystem {
  std::int64_t label = 0;
  std::int64_t type = 0;                                            // 0 Cartesian, 1 cylindrical, 2 spherical
  std::array<double, 12> axes{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};  // three rows of rotation, then the origin
  NodeId first_node;                                                // of those that name it; may be invalid
  NodeId first_placed = {};  // of those whose coordinates are given in it (UNV: datasets 15 and 781); may be invalid
  [[nodiscard]] bool same_as(const CoordinateSystem& other) const { return type == other.type && axes == other.axes; }
  [[nodiscard]] bool is_global() const { return same_as({}); }
};

/// The text a model was read from; defined by the reader, needed by the writer.
class Source;

/// n = nodes, m = elements, in file order. Lengths are in the unit of the file, never converted.
struct Model {
  std::string path;  // as given by the user; names the model in messages

  std::vector<Vec3> position;             // n
  std::vector<std::int64_t> node_label;   // n, unique
  std::vector<GroupSetId> node_groups;    // n
  std::vector<std::uint64_t> node_place;  // n byte offsets in the source; empty without a source

  std::vector<std::int64_t> element_label;       // m, unique
  std::vector<AttributesId> element_attributes;  // m
  std::vector<GroupSetId> element_groups;        // m
  std::vector<std::uint64_t> element_place;      // m byte offsets; empty without a source
  std::vector<std::uint32_t> first_node;         // m + 1 offsets into `nodes`
  std::vector<NodeId> nodes;                     // of all elements; invalid where the record has 0

  std::vector<ElementAttributes> attributes;       // distinct
  std::vector<OrientationNode> orientation_nodes;  // ascending by element
  std::vector<Group> groups;                       // file order; equal names and numbers can occur
  GroupSets group_sets;                            // of GroupId into `groups`
  std::optional<Units> units;
  std::vector<CoordinateSystem> coordinate_systems;  // ascending by label
  std::vector<Warning> warnings;                     // what the reader repaired or doubted
  std::shared_ptr<const Source> source;              // null for a model made in memory

  [[nodiscard]] std::size_t n_nodes() const { return position.size(); }
  [[nodiscard]] std::size_t n_elements() const { return element_label.size(); }
  [[nodiscard]] std::span<const NodeId> nodes_of(ElementId e) const {
    return std::span(nodes).subspan(first_node[e.value], first_node[e.value + 1] - first_node[e.value]);
  }
  [[nodiscard]] const ElementAttributes& attributes_of(ElementId e) const {
    return attributes[element_attributes[e.value].value];
  }
  /// The global one if the file does not define it.
  [[nodiscard]] CoordinateSystem coordinate_system(std::int64_t label) const;
  [[nodiscard]] Shape shape(ElementId e) const { return attributes_of(e).shape; }
  [[nodiscard]] bool is_face(ElementId e) const { return shape(e) == Shape::kTriangle; }
  [[nodiscard]] std::array<Vec3, 3> corners(ElementId face) const {
    const NodeId* v = nodes.data() + first_node[face.value];
    return {position[v[0].value], position[v[1].value], position[v[2].value]};
  }
};

/// Where a node or element stands in the file of the user; line 0 without a source.
[[nodiscard]] Place place_of(const Model& model, NodeId node);
[[nodiscard]] Place place_of(const Model& model, ElementId element);

/// Builds a Model in memory (no source). Groups are given by name; the arrays of groups grow on
/// demand. Labels default to position + 1.
class ModelBuilder {
 public:
  NodeId add_node(Vec3 position, std::int64_t label = 0);
  ElementId add_element(const ElementAttributes& attributes, std::span<const NodeId> nodes, std::int64_t label = 0);
  /// A linear thin-shell triangle (UNV descriptor 91) with the given property numbers.
  ElementId add_face(NodeId a, NodeId b, NodeId c, std::int64_t physical = 1, std::int64_t material = 1);
  /// A linear beam (UNV descriptor 21).
  ElementId add_line(NodeId a, NodeId b, std::int64_t physical = 1, std::int64_t material = 1);
  void add_to_group(const std::string& group, NodeId node);
  void add_to_group(const std::string& group, ElementId element);
  /// The finished model; the builder is empty afterwards.
  [[nodiscard]] Model build(std::string path = "memory");

 private:
  GroupId group(const std::string& name);
  AttributesId attributes(const ElementAttributes& attributes);
  Model model_;
};

}  // namespace meshgraft
