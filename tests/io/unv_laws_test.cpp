// Laws of reading, writing and splicing, over random models, texts and grafts.
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "io/grafts.hpp"
#include "io/unv_samples.hpp"

namespace meshgraft {
namespace {

using namespace samples;

void law(const char* name, const std::function<void()>& property) {
  if (!rc::check(name, property)) ADD_FAILURE() << name;
}

std::size_t below(std::size_t n) { return *rc::gen::inRange<std::size_t>(0, n); }

/// Coordinates without short decimal forms, of all sizes.
double coordinate() {
  const double thirds = static_cast<double>(*rc::gen::inRange(-3000, 3000)) / 3.0;
  return thirds * std::pow(10.0, *rc::gen::inRange(-12, 12));
}

/// Triangles, beams and opaque elements on random nodes; labels with gaps; overlapping groups.
Model random_model() {
  ModelBuilder b;
  std::int64_t label = *rc::gen::inRange(1, 5);
  const std::size_t n = 3 + below(12);
  std::vector<NodeId> nodes;
  for (std::size_t i = 0; i < n; ++i) {
    nodes.push_back(b.add_node({coordinate(), coordinate(), coordinate()}, label));
    label += *rc::gen::element<std::int64_t>(1, 1, 1, 7, 1000);
  }
  const auto any = [&] { return nodes[below(n)]; };
  std::int64_t element_label = 1;
  const std::size_t m = below(14);
  for (std::size_t e = 0; e < m; ++e) {
    ElementId id;
    switch (below(4)) {
      case 0:
        id = b.add_line(any(), any(), 1 + static_cast<std::int64_t>(below(3)));
        break;
      case 1: {
        ElementAttributes rigid;
        rigid.type = 122, rigid.physical = 1, rigid.material = 2, rigid.colour = 3;
        std::vector<NodeId> of(1 + below(20));
        for (NodeId& v : of) v = any();
        id = b.add_element(rigid, of, element_label);
        break;
      }
      default:
        id = b.add_face(any(), any(), any(), 1 + static_cast<std::int64_t>(below(3)));
    }
    element_label = static_cast<std::int64_t>(id.value) + 2;
    for (const char* group : {"ALL", "SOME", "FEW"})
      if (below(3) == 0) b.add_to_group(group, id);
  }
  for (const NodeId v : nodes)
    if (below(4) == 0) b.add_to_group(below(2) == 0 ? "NODES" : "SOME", v);
  return b.build();
}

/// What a model means, by labels.
struct Meaning {
  std::map<std::int64_t, std::array<double, 3>> nodes;
  std::map<std::int64_t, std::pair<std::vector<std::int64_t>, std::vector<std::int64_t>>> elements;
  std::map<std::string, std::pair<std::set<std::int64_t>, std::set<std::int64_t>>> groups;
  friend bool operator==(const Meaning&, const Meaning&) = default;
};

Meaning meaning(const Model& m) {
  Meaning result;
  for (std::size_t i = 0; i < m.n_nodes(); ++i)
    result.nodes[m.node_label[i]] = {m.position[i].x, m.position[i].y, m.position[i].z};
  for (std::size_t e = 0; e < m.n_elements(); ++e) {
    const ElementAttributes& a = m.attributes_of(ElementId(e));
    auto& [attributes, nodes] = result.elements[m.element_label[e]];
    attributes = {a.type, a.physical, a.material, a.colour};
    for (const NodeId v : m.nodes_of(ElementId(e))) nodes.push_back(m.node_label[v.value]);
  }
  for (std::size_t g = 0; g < m.groups.size(); ++g) {
    const auto nodes = nodes_in(m, g), elements = elements_in(m, g);
    result.groups[m.groups[g].name] = {{nodes.begin(), nodes.end()}, {elements.begin(), elements.end()}};
  }
  return result;
}

Model reread(const std::string& text) {
  auto model = read_unv_text(text, "law.unv");
  RC_ASSERT(model.has_value());
  RC_ASSERT(*unv_text(*model) == text);
  return std::move(*model);
}

TEST(UnvLaws, WhatIsWrittenReadsBackEqual) {
  law("write, read", [] {
    const Model made = random_model();
    const auto text = unv_text(made);
    RC_ASSERT(text.has_value());
    const Model read = reread(*text);
    RC_ASSERT(meaning(read) == meaning(made));
    RC_ASSERT(read.warnings.empty());
  });
}

TEST(UnvLaws, WhiteSpaceAndLineEndsChangeNothingButBytes) {
  law("white space", [] {
    const Model made = random_model();
    const std::string text = *unv_text(made);
    const std::string end = *rc::gen::element<std::string>("\n", "\r\n", "\r");
    std::string changed;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t next = text.find('\n', at);
      changed += text.substr(at, next - at);
      if (below(5) == 0) changed.append(below(4), ' ');
      changed += end;
      at = next + 1;
    }
    if (below(3) == 0) changed += "\x1A";
    RC_ASSERT(meaning(reread(changed)) == meaning(made));
  });
}

TEST(UnvLaws, FreeFormatMeansTheSame) {
  law("free format", [] {
    const Model made = random_model();
    const std::string text = *unv_text(made);
    // Records of nodes and elements with single blanks between their fields.
    std::string changed;
    bool inside = false;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t next = text.find('\n', at);
      const std::string line = text.substr(at, next - at);
      if (line == "  2411" || line == "  2412") inside = true;
      if (line == "    -1") inside = false;
      std::string squeezed;
      for (const char c : line)
        if (c != ' ' || (!squeezed.empty() && squeezed.back() != ' ')) squeezed += c;
      changed += (inside && line.size() > 6 ? squeezed : line) + "\n";
      at = next + 1;
    }
    RC_ASSERT(meaning(reread(changed)) == meaning(made));
  });
}

/// A graft of random removals and additions, and what the result must mean.
struct Case {
  Model base;
  std::vector<Model> parts;
  Merged merged;
  Meaning expected;
};

Case random_case() {
  Case c;
  c.base = reread(*unv_text(random_model()));
  const std::size_t n_parts = below(3);
  for (std::size_t k = 0; k < n_parts; ++k) c.parts.push_back(reread(*unv_text(random_model())));
  c.merged = nothing(c.base, c.parts);
  Graft& graft = c.merged.graft;
  const std::int64_t step = 100'000;
  for (std::uint32_t k = 1; k <= n_parts; ++k) shift_all(c.merged, k, c.parts[k - 1], step * k);
  for (std::size_t g = 0; g < graft.groups.size(); ++g) c.expected.groups[graft.groups[g].name];

  for (std::uint32_t k = 0; k <= n_parts; ++k) {
    const Model& m = k == 0 ? c.base : c.parts[k - 1];
    const std::int64_t shift = c.merged.labels.node_shift[k];
    std::vector<bool> used(m.n_nodes());
    for (std::size_t e = 0; e < m.n_elements(); ++e) {
      if (below(4) == 0) {
        graft.removed_elements[k].push_back(ElementId(e));
        continue;
      }
      const ElementAttributes& a = m.attributes_of(ElementId(e));
      auto& [attributes, nodes] = c.expected.elements[m.element_label[e] + shift];
      attributes = {a.type, a.physical, a.material, a.colour};
      for (const NodeId v : m.nodes_of(ElementId(e)))
        nodes.push_back(m.node_label[v.value] + shift), used[v.value] = true;
      for (const GroupId g : m.group_sets.members(m.element_groups[e]))
        c.expected.groups[m.groups[g.value].name].second.insert(m.element_label[e] + shift);
    }
    for (std::size_t i = 0; i < m.n_nodes(); ++i) {
      if (!used[i] && below(3) == 0) {
        graft.removed_nodes[k].push_back(NodeId(i));
        continue;
      }
      Vec3 p = m.position[i];
      if (k > 0 && below(5) == 0) {
        p = {coordinate(), coordinate(), coordinate()};
        graft.moved_nodes.push_back({{k, NodeId(i)}, p});
      }
      c.expected.nodes[m.node_label[i] + shift] = {p.x, p.y, p.z};
      for (const GroupId g : m.group_sets.members(m.node_groups[i]))
        c.expected.groups[m.groups[g.value].name].first.insert(m.node_label[i] + shift);
    }
  }

  const auto random_set = [&] {
    std::vector<GroupId> groups;
    for (std::size_t g = 0; g < graft.groups.size(); ++g)
      if (below(4) == 0) groups.emplace_back(g);
    return graft.group_sets.intern(groups);
  };
  const std::size_t n_new = below(5);
  for (std::size_t i = 0; i < n_new; ++i) {
    const Vec3 p{coordinate(), coordinate(), coordinate()};
    const GroupSetId set = random_set();
    const std::int64_t label = c.merged.labels.first_new_node + static_cast<std::int64_t>(i);
    graft.new_nodes.push_back({p, {0, NodeId(below(c.base.n_nodes()))}, set});
    c.expected.nodes[label] = {p.x, p.y, p.z};
    for (const GroupId g : graft.group_sets.members(set))
      c.expected.groups[graft.groups[g.value].name].first.insert(label);
  }
  for (std::uint32_t k = 0; n_new > 0 && k <= n_parts; ++k) {
    const Model& m = k == 0 ? c.base : c.parts[k - 1];
    for (std::size_t e = 0; e < m.n_elements(); ++e) {
      const ElementAttributes& a = m.attributes_of(ElementId(e));
      if (a.type == 122 || below(3) != 0) continue;
      NewElement made{{k, ElementId(e)}, {}, random_set()};
      const std::int64_t label =
          c.merged.labels.first_new_element + static_cast<std::int64_t>(graft.new_elements.size());
      auto& [attributes, nodes] = c.expected.elements[label];
      attributes = {a.type, a.physical, a.material, a.colour};
      for (std::size_t v = 0; v < (a.shape == Shape::kLine ? 2u : 3u); ++v) {
        const std::size_t i = below(n_new);
        made.nodes[v] = {kNew, NodeId(i)};
        nodes.push_back(c.merged.labels.first_new_node + static_cast<std::int64_t>(i));
      }
      graft.new_elements.push_back(made);
      for (const GroupId g : graft.group_sets.members(made.groups))
        c.expected.groups[graft.groups[g.value].name].second.insert(label);
    }
  }
  return c;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t next = text.find('\n', at);
    lines.push_back(text.substr(at, next - at));
    at = next + 1;
  }
  return lines;
}

TEST(UnvLaws, SpliceMeansWhatTheGraftSays) {
  law("splice", [] {
    const Case c = random_case();
    Report report;
    const auto text = unv_text(c.base, c.parts, c.merged, report);
    RC_ASSERT(text.has_value());
    const Model out = reread(*text);
    RC_ASSERT(out.warnings.empty());
    RC_ASSERT(meaning(out) == c.expected);
  });
}

TEST(UnvLaws, SpliceKeepsEveryOtherLineOfTheBaseInOrder) {
  law("untouched lines", [] {
    Case c = random_case();
    // Lines that the graft may change: records of removed entities, and groups.
    const std::string base = *unv_text(c.base);
    std::set<std::size_t> may_change;
    const auto mark = [&](std::size_t begin, std::size_t end) {
      for (std::size_t at = begin; at < end; ++at)
        if (base[at] == '\n')
          may_change.insert(
              static_cast<std::size_t>(std::count(base.begin(), base.begin() + static_cast<std::ptrdiff_t>(at), '\n')));
    };
    const auto end_of = [&](const std::vector<std::uint64_t>& places, std::size_t i) {
      return i + 1 < places.size() ? places[i + 1] : base.find("    -1\n", places[i]);
    };
    for (const NodeId v : c.merged.graft.removed_nodes[0])
      mark(c.base.node_place[v.value], end_of(c.base.node_place, v.value));
    for (const ElementId e : c.merged.graft.removed_elements[0])
      mark(c.base.element_place[e.value], end_of(c.base.element_place, e.value));
    if (!c.base.groups.empty()) mark(c.base.groups[0].place, base.find("    -1\n", c.base.groups[0].place));

    Report report;
    const std::vector<std::string> before = lines_of(base),
                                   after = lines_of(*unv_text(c.base, c.parts, c.merged, report));
    std::size_t at = 0;
    for (std::size_t k = 0; k < before.size(); ++k) {
      if (may_change.contains(k)) continue;
      while (at < after.size() && after[at] != before[k]) ++at;
      RC_ASSERT(at < after.size());
      ++at;
    }
  });
}

TEST(UnvLaws, GroupsThatKeepTheirMembersKeepTheirBytes) {
  law("groups", [] {
    Case c = random_case();
    for (Model& part : c.parts) part = reread(*unv_text(ModelBuilder().build()));
    c.merged = nothing(c.base, c.parts);
    if (c.base.n_elements() > 0) c.merged.graft.removed_elements[0] = {ElementId(below(c.base.n_elements()))};
    Report report;
    const std::string base = *unv_text(c.base), text = *unv_text(c.base, c.parts, c.merged, report);
    for (std::size_t g = 0; g < c.base.groups.size(); ++g) {
      const auto& removed = c.merged.graft.removed_elements[0];
      if (!removed.empty() && c.base.group_sets.contains(c.base.element_groups[removed[0].value], GroupId(g))) continue;
      const std::size_t begin = c.base.groups[g].place;
      const std::size_t end = g + 1 < c.base.groups.size() ? c.base.groups[g + 1].place : base.find("    -1\n", begin);
      RC_ASSERT(text.find(base.substr(begin, end - begin)) != std::string::npos);
    }
  });
}

}  // namespace
}  // namespace meshgraft
