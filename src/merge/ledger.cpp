#include "merge/ledger.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/blocks.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kSumBlock = 65536;  // entities summed in one go: each block has a sum for each set of groups

using Sum = GroupSum;
using enum GroupSum::Kind;
constexpr std::array<const char*, kKinds> kKindNames{"nodes", "faces", "lines", "other"};

Sum node() {
  Sum s;
  s.members[kNodes] = 1;
  return s;
}

/// One element of shape `shape`, nodes found by `position_of`.
template <class Node, class F>
Sum element(Shape shape, std::span<const Node> nodes, F&& position_of) {
  Sum s;
  const std::size_t n = nodes.size();
  if (shape == Shape::kTriangle && n == 3) {  // nearly all of them
    s.members[kFaces] = 1;
    s.area = area({position_of(nodes[0]), position_of(nodes[1]), position_of(nodes[2])});
  } else if (shape == Shape::kLine && n == 2) {
    s.members[kLines] = 1;
    s.length = distance(position_of(nodes[0]), position_of(nodes[1]));
  } else {
    s.members[kOthers] = 1;
  }
  return s;
}

template <class F>
Sum element(const Model& model, ElementId e, F&& at) {
  const Shape shape = model.shape(e);
  if (shape == Shape::kTriangle || shape == Shape::kLine) return element(shape, model.nodes_of(e), at);
  Sum s;
  const Corners c = corners_of(shape, model.nodes_of(e));
  s.members[c.is_surface() ? kFaces : c.n == 2 ? kLines : kOthers] = 1;
  if (c.is_surface()) s.area = area({at(c.node[0]), at(c.node[1]), at(c.node[2])});
  if (c.n == 4) s.area += area({at(c.node[0]), at(c.node[2]), at(c.node[3])});
  if (c.n == 2) s.length = distance(at(c.node[0]), at(c.node[1]));
  return s;
}

Sum element(const Model& model, ElementId e) {
  return element(model, e, [&](NodeId n) { return model.position[n.value]; });
}

/// All groups of one input, by group of that input. Blocks are summed by themselves, then in their order.
std::vector<Sum> sums_of(const Model& model) {
  const std::size_t n_sets = model.group_sets.size();
  const auto by_set = [&](std::size_t n, auto&& add) {
    return collected_by_block<Sum>(
        n,
        [&](std::size_t first, std::size_t last, std::vector<Sum>& sums) {
          sums.resize(n_sets);
          for (std::size_t i = first; i < last; ++i) add(i, sums);
        },
        kSumBlock);
  };
  const std::vector<Sum> elements = by_set(model.n_elements(), [&](std::size_t e, std::vector<Sum>& sums) {
    if (const GroupSetId s = model.element_groups[e]; s != GroupSets::kEmpty)
      sums[s.value].add(element(model, ElementId(e)));
  });
  const std::vector<Sum> nodes = by_set(model.n_nodes(), [&](std::size_t n, std::vector<Sum>& sums) {
    if (const GroupSetId s = model.node_groups[n]; s != GroupSets::kEmpty) sums[s.value].add(node());
  });
  std::vector<Sum> by_group(model.groups.size());
  for (const auto* sums : {&elements, &nodes})
    for (std::size_t i = 0; i < sums->size(); ++i)
      for (const GroupId g : model.group_sets.members(GroupSetId(i % n_sets))) by_group[g.value].add((*sums)[i]);
  return by_group;
}

/// What the graft adds to and takes from the merged groups.
struct Change {
  std::vector<Sum> sum;
  std::vector<std::uint8_t> inherited, reduced, joined, overlaid;  // by merged group: whether it happened
};

class ChangeCounter {
 public:
  ChangeCounter(Inputs inputs, const Graft& graft) : inputs_(inputs), graft_(graft) {
    const std::size_t n = graft.groups.size();
    change_.sum.resize(n);
    change_.inherited.resize(n), change_.reduced.resize(n), change_.joined.resize(n), change_.overlaid.resize(n);
    for (const Model* model : inputs) merged_of_.emplace_back(model->groups.size());
    for (std::size_t g = 0; g < n; ++g)
      for (const MergedGroup::From from : graft.groups[g].from) merged_of_[from.input][from.group.value] = GroupId(g);
  }

  Change run() {
    for (std::uint32_t k = 0; k < inputs_.size(); ++k) {
      for (const ElementId e : graft_.removed_elements[k])
        take(k, inputs_[k]->element_groups[e.value], element(*inputs_[k], e));
      for (const NodeId n : graft_.removed_nodes[k]) take(k, inputs_[k]->node_groups[n.value], node());
      stretch(k);
    }
    for (const NewElement& e : graft_.new_elements) {
      const std::span<const NodeRef> nodes(e.nodes.data(), e.nodes[2].valid() ? 3 : 2);
      const Sum s = element(nodes.size() == 3 ? Shape::kTriangle : Shape::kLine, nodes,
                            [&](NodeRef n) { return position_of(n); });
      give(e.groups, s, change_.inherited);
    }
    for (const NewNode& n : graft_.new_nodes) give(n.groups, node(), change_.inherited);
    for (const Graft::JoinedNode& j : graft_.joined_nodes) give(j.groups, node(), change_.joined);
    for (const Graft::JoinedElement& j : graft_.joined_elements)
      give(j.groups, element(*inputs_[j.element.input], j.element.element), change_.overlaid);
    return std::move(change_);
  }

 private:
  void take(std::uint32_t input, GroupSetId set, const Sum& s) {
    for (const GroupId g : inputs_[input]->group_sets.members(set)) {
      const GroupId merged = merged_of_[input][g.value];
      change_.sum[merged.value].add(s, -1);
      change_.reduced[merged.value] = 1;
    }
  }

  /// Elements of an input that stay, with nodes that are not where they were.
  void stretch(std::uint32_t input) {
    const Model& model = *inputs_[input];
    std::vector<std::uint8_t> is_elsewhere;
    const auto mark = [&](NodeRef n) {
      if (n.input != input) return;
      is_elsewhere.resize(model.n_nodes());
      is_elsewhere[n.node.value] = 1;
    };
    for (const Graft::MovedNode& m : graft_.moved_nodes) mark(m.node);
    for (const Graft::ReplacedNode& r : graft_.replaced_nodes) mark(r.node);
    if (is_elsewhere.empty()) return;
    for (std::size_t i = 0; i < model.n_elements(); ++i) {
      const ElementId e(i);
      const auto is_moved = [&](NodeId n) { return n.valid() && is_elsewhere[n.value] != 0; };
      if (!std::ranges::any_of(model.nodes_of(e), is_moved) ||
          std::ranges::binary_search(graft_.removed_elements[input], e))
        continue;
      const Sum before = element(model, e), after = element(model, e, [&](NodeId n) { return place_of({input, n}); });
      for (const GroupId g : model.group_sets.members(model.element_groups[i])) {
        Sum& sum = change_.sum[merged_of_[input][g.value].value];
        sum.add(before, -1), sum.add(after);
      }
    }
  }

  void give(GroupSetId set, const Sum& s, std::vector<std::uint8_t>& how) {
    for (const GroupId g : graft_.group_sets.members(set)) {
      change_.sum[g.value].add(s);
      how[g.value] = 1;
    }
  }

  /// Of a node of an input, or of what took its place.
  Vec3 place_of(NodeRef n) const {
    const auto it = std::ranges::lower_bound(graft_.replaced_nodes, n, {}, &Graft::ReplacedNode::node);
    return position_of(it != graft_.replaced_nodes.end() && it->node == n ? it->by : n);
  }

  Vec3 position_of(NodeRef n) const {
    if (n.input == kNew) return graft_.new_nodes[n.node.value].position;
    const auto it = std::ranges::lower_bound(graft_.moved_nodes, n, {}, &Graft::MovedNode::node);
    if (it != graft_.moved_nodes.end() && it->node == n) return it->to;
    return inputs_[n.input]->position[n.node.value];
  }

  Inputs inputs_;
  const Graft& graft_;
  Change change_;
  std::vector<std::vector<GroupId>> merged_of_;  // [input][group]
};

std::string kind_of(const Sum& before, const Sum& after) {
  std::string kind;
  for (std::size_t k = 0; k < kKinds; ++k) {
    if (before.members[k] == 0 && after.members[k] == 0) continue;
    if (!kind.empty()) kind += '+';
    kind += kKindNames[k];
  }
  return kind;
}

std::string rule_of(const Change& change, const Dropped& dropped, std::size_t g, std::size_t n_inputs) {
  std::vector<std::string> rules;
  if (n_inputs > 1) rules.push_back("united from " + std::to_string(n_inputs) + " inputs");
  if (change.inherited[g] != 0 && dropped.filled_area.empty()) rules.emplace_back("inherited from parent");
  if (dropped.touches(GroupId(g)) && change.reduced[g] != 0) rules.emplace_back("reduced by what was dropped");
  if (change.inherited[g] == 0 && change.reduced[g] != 0 && !dropped.touches(GroupId(g)))
    rules.emplace_back("removed with their surroundings");
  if (change.inherited[g] != 0 && !dropped.filled_area.empty()) rules.emplace_back("extended over filled holes");
  if (dropped.stretched_area_of(GroupId(g)) != 0 || dropped.stretched_length_of(GroupId(g)) != 0)
    rules.emplace_back("stretched over gaps");
  if (change.joined[g] != 0) rules.emplace_back("joined by nodes that took another's place");
  if (change.overlaid[g] != 0) rules.emplace_back("joined by elements that stand for overlaid ones too");
  if (rules.empty()) return "untouched";
  std::string text = rules.front();
  for (std::size_t k = 1; k < rules.size(); ++k) text += "; " + rules[k];
  return text;
}

Error broken(const std::string& name, const std::string& what) {
  return {ErrorCode::kPromiseBroken,
          "group " + name + " " + what,
          "protect its members by a smaller --bandwidth, or look at the place of the merge; this is not expected",
          {}};
}

/// What went beside the zone, added to the amounts that the zone has lost.
Dropped with_elements(Inputs inputs, const Graft& graft, Dropped dropped) {
  dropped.area.resize(graft.groups.size()), dropped.length.resize(graft.groups.size());
  dropped.touched.resize(graft.groups.size());
  for (std::uint32_t k = 0; k < dropped.elements.size(); ++k) {
    std::vector<GroupId> merged(inputs[k]->groups.size());
    for (std::size_t g = 0; g < graft.groups.size(); ++g)
      for (const MergedGroup::From from : graft.groups[g].from)
        if (from.input == k) merged[from.group.value] = GroupId(g);
    for (const ElementId e : dropped.elements[k]) {
      const Sum s = element(*inputs[k], e);
      for (const GroupId g : inputs[k]->group_sets.members(inputs[k]->element_groups[e.value])) {
        const std::size_t at = merged[g.value].value;
        dropped.area[at] += s.area, dropped.length[at] += s.length, dropped.touched[at] = 1;
      }
      for (const NodeId n : inputs[k]->nodes_of(e))
        if (n.valid())
          for (const GroupId g : inputs[k]->group_sets.members(inputs[k]->node_groups[n.value]))
            dropped.touched[merged[g.value].value] = 1;
    }
  }
  return dropped;
}

/// How far the area (or length) of a group is from what was there without what was dropped.
struct Expected {
  double area = 0, length = 0;
  double slack = 0;  // of the area
};

void check(const GroupEntry& e, const Expected& expected, const LedgerOptions& options, std::vector<Error>& errors) {
  const auto changed = [&](double before, double wanted, double after, double slack, const char* what) {
    if (std::abs(after - wanted) <= options.max_change * before + slack) return;
    errors.push_back(broken(e.name, std::string("had ") + what + " " + text_of(before) + " and has " + text_of(after) +
                                        " now, a change of " + text_of(100 * (after - before) / before) + " %" +
                                        (wanted == before ? "" : "; " + text_of(wanted) + " should be left")));
  };
  changed(e.area_before, expected.area, e.area_after, expected.slack, "area");
  changed(e.length_before, expected.length, e.length_after, 0, "length");
}

}  // namespace

std::vector<std::vector<GroupSum>> group_sums(Inputs inputs) {
  std::vector<std::vector<GroupSum>> sums;
  for (const Model* model : inputs) sums.push_back(sums_of(*model));
  return sums;
}

Ledger ledger_of(Inputs inputs, const Graft& graft, const Dropped& beside, const LedgerOptions& options) {
  return ledger_of(inputs, group_sums(inputs), graft, beside, options);
}

Ledger ledger_of(Inputs inputs, std::span<const std::vector<GroupSum>> sums, const Graft& graft, const Dropped& beside,
                 const LedgerOptions& options) {
  const Dropped dropped = with_elements(inputs, graft, beside);
  const Change change = ChangeCounter(inputs, graft).run();
  Ledger ledger;
  for (std::size_t g = 0; g < graft.groups.size(); ++g) {
    const MergedGroup& group = graft.groups[g];
    Sum before;
    for (const MergedGroup::From from : group.from) before.add(sums[from.input][from.group.value]);
    Sum after = before;
    after.add(change.sum[g]);
    // Sums of rounded numbers leave a little behind where everything went.
    if (after.members[kFaces] == 0) after.area = 0;
    if (after.members[kLines] == 0) after.length = 0;
    ledger.groups.push_back({group.name, kind_of(before, after), before.count(), after.count(), before.area, after.area,
                             before.length, after.length, rule_of(change, dropped, g, group.from.size())});
    const GroupEntry& entry = ledger.groups.back();
    const GroupId id(g);
    const std::string emptied = "had " + std::to_string(entry.members_before) + " members and is empty now";
    if (entry.members_before == 0 || entry.members_after > 0)
      check(entry,
            {before.area - dropped.area_of(id) + dropped.stretched_area_of(id) + dropped.filled_area_of(id),
             before.length - dropped.length_of(id) + dropped.stretched_length_of(id), dropped.slack_of(id)},
            options, ledger.broken);
    else if (dropped.touches(id))
      ledger.warnings.push_back({"emptied-group", "group " + group.name + " " + emptied + ": all were dropped", {}});
    else
      ledger.broken.push_back(broken(group.name, emptied));
  }
  return ledger;
}

}  // namespace meshgraft
