// What a merge changes, in terms of its inputs; everything not named here stays as it is.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "meshgraft/group_sets.hpp"
#include "meshgraft/id.hpp"
#include "meshgraft/vec3.hpp"

namespace meshgraft {

/// One group of the merged model and the groups of the inputs that it unites (same name and kind).
struct MergedGroup {
  struct From {
    std::uint32_t input = 0;
    GroupId group;
  };
  std::string name;
  std::vector<From> from;  // ascending by input; the first one gives record layout, number and place
};

/// A node of the merged model: NodeRef::input is an input, or kNew for Graft::new_nodes.
inline constexpr std::uint32_t kNew = 0xFFFFFFFE;

struct NewNode {
  Vec3 position;
  NodeRef like;       // input node whose coordinate systems and colour are copied
  GroupSetId groups;  // in Graft::group_sets
};

struct NewElement {
  ElementRef parent;             // attributes, record layout and beam record are copied from it
  std::array<NodeRef, 3> nodes;  // the last one invalid for a line
  GroupSetId groups;             // in Graft::group_sets
};

/// The difference between the inputs and the merged model. Inputs: 0 the base, then the parts.
/// All lists are ascending, so that equal merges give equal grafts.
struct Graft {
  std::vector<MergedGroup> groups;  // order of the output; GroupId of `group_sets` points here
  GroupSets group_sets;

  std::vector<std::vector<NodeId>> removed_nodes;        // by input
  std::vector<std::vector<ElementId>> removed_elements;  // by input
  std::vector<NewNode> new_nodes;
  std::vector<NewElement> new_elements;

  struct MovedNode {
    NodeRef node;
    Vec3 to;
  };
  std::vector<MovedNode> moved_nodes;  // keep their labels; of the base only where it is joined with itself

  struct ReplacedNode {
    NodeRef node;  // in removed_nodes too
    NodeRef by;    // what elements that stay refer to instead
  };
  std::vector<ReplacedNode> replaced_nodes;

  struct JoinedNode {
    NodeRef node;       // a node that stays
    GroupSetId groups;  // merged groups it joins, beyond those its own input gives it
  };
  std::vector<JoinedNode> joined_nodes;

  struct JoinedElement {
    ElementRef element;  // an element that stays
    GroupSetId groups;   // merged groups it joins: those of an element it now stands for too
  };
  std::vector<JoinedElement> joined_elements;
};

/// Labels of the merged model. Base labels never change; a label of a part moves by the constant
/// of its input only where an earlier input has it (removed entities included).
struct Labels {
  std::vector<std::int64_t> node_shift, element_shift;  // by input; 0 for the base
  std::vector<std::vector<NodeId>> shifted_nodes;       // by input, ascending
  std::vector<std::vector<ElementId>> shifted_elements;
  std::int64_t first_new_node = 1, first_new_element = 1;  // new entities count up from these
};

}  // namespace meshgraft
