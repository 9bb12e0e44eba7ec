// Groups of the output: records of the base whose members change are written anew, those of the
// parts join groups of the same name or follow after the last one.
#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "core/blocks.hpp"
#include "io/removed_labels.hpp"
#include "io/splice_context.hpp"
#include "io/unv_format.hpp"
#include "io/unv_groups.hpp"

namespace meshgraft::unv {
namespace {

constexpr std::int64_t kNewGroupDataset = 2467;

template <class Id>
std::vector<std::int64_t> labels_of(const std::vector<Id>& ids, const std::vector<std::int64_t>& labels) {
  std::vector<std::int64_t> of;
  for (const Id id : ids) of.push_back(labels[id.value]);
  return of;
}

/// Members that a merged group gains, labels of the output.
struct Gained {
  std::vector<std::int64_t> nodes, elements;
  [[nodiscard]] bool empty() const { return nodes.empty() && elements.empty(); }
};

class GroupSplicer {
 public:
  explicit GroupSplicer(Splice& splice)
      : s_(splice),
        removed_(s_.n_inputs()),
        gained_(s_.graft.groups.size()),
        last_(s_.last_dataset(DatasetKind::kGroups)) {
    layout_ = group_layout_of(last_ != nullptr ? last_->number : kNewGroupDataset);
    for (const GroupPlace& place : s_.base().groups)
      if (last_ != nullptr && &s_.base().datasets[place.dataset] == last_) layout_ = place.layout;
  }

  void run() {
    for (std::uint32_t k = 0; k < s_.n_inputs(); ++k) {
      removed_[k].nodes = LabelSet(labels_of(s_.graft.removed_nodes[k], s_.models[k]->node_label));
      removed_[k].elements = LabelSet(labels_of(s_.graft.removed_elements[k], s_.models[k]->element_label));
    }
    for (const Group& group : s_.models.front()->groups) numbers_.insert(group.number);
    collect_gained();
    find_shrinking();
    for (std::size_t g = 0; g < s_.graft.groups.size(); ++g) write(g);
    if (last_ != nullptr) {
      s_.insert_records(*last_, std::move(new_groups_));
    } else {
      const Dataset* after = s_.last_dataset(DatasetKind::kElements);
      s_.insert_dataset(after != nullptr ? after : s_.last_dataset(DatasetKind::kNodes), kNewGroupDataset,
                        std::move(new_groups_));
    }
  }

 private:
  void collect_gained() {
    const GroupSets& sets = s_.graft.group_sets;
    for (std::size_t i = 0; i < s_.graft.new_nodes.size(); ++i)
      for (const GroupId g : sets.members(s_.graft.new_nodes[i].groups))
        gained_[g.value].nodes.push_back(s_.names.of(NodeRef{kNew, NodeId(i)}));
    for (std::size_t i = 0; i < s_.graft.new_elements.size(); ++i)
      for (const GroupId g : sets.members(s_.graft.new_elements[i].groups))
        gained_[g.value].elements.push_back(s_.names.of(ElementRef{kNew, ElementId(i)}));
    for (const Graft::JoinedNode& joined : s_.graft.joined_nodes)
      for (const GroupId g : sets.members(joined.groups))
        if (!is_member_already(joined.node, g)) gained_[g.value].nodes.push_back(s_.names.of(joined.node));
    for (const Graft::JoinedElement& joined : s_.graft.joined_elements)
      for (const GroupId g : sets.members(joined.groups))
        gained_[g.value].elements.push_back(s_.names.of(joined.element));
    for (Gained& gained : gained_) {
      std::ranges::sort(gained.nodes), std::ranges::sort(gained.elements);
      gained.nodes.erase(std::ranges::unique(gained.nodes).begin(), gained.nodes.end());
    }
  }

  [[nodiscard]] bool is_member_already(NodeRef node, GroupId merged) const {
    const Model& model = *s_.models[node.input];
    return std::ranges::any_of(s_.graft.groups[merged.value].from, [&](const MergedGroup::From& from) {
      return from.input == node.input && model.group_sets.contains(model.node_groups[node.node.value], from.group);
    });
  }

  /// Marks the groups of the base that lose a member: one look at each distinct group set.
  void find_shrinking() {
    const Model& base = *s_.models.front();
    std::vector<bool> seen(base.group_sets.size());
    shrinks_.resize(base.groups.size());
    const auto mark = [&](GroupSetId set) {
      if (seen[set.value]) return;
      seen[set.value] = true;
      for (const GroupId g : base.group_sets.members(set)) shrinks_[g.value] = true;
    };
    for (const NodeId n : s_.graft.removed_nodes.front()) mark(base.node_groups[n.value]);
    for (const ElementId e : s_.graft.removed_elements.front()) mark(base.element_groups[e.value]);
  }

  void write(std::size_t g) {
    const MergedGroup& merged = s_.graft.groups[g];
    const bool in_base = !merged.from.empty() && merged.from.front().input == 0;
    for (const MergedGroup::From& from : merged.from) {
      if (from.input != 0) continue;
      const bool first = &from == &merged.from.front();
      if (shrinks_[from.group.value] || (first && grows(g)) || names_too_much(from))
        rewrite(from, first ? &merged : nullptr, g);
    }
    if (!in_base) append_new(merged, g);
  }

  [[nodiscard]] bool grows(std::size_t g) const {
    if (!gained_[g].empty()) return true;
    return std::ranges::any_of(s_.graft.groups[g].from, [&](const MergedGroup::From& from) {
      const Group& group = s_.models[from.input]->groups[from.group.value];
      return from.input > 0 && group.n_nodes + group.n_elements + group.n_other + group.n_dangling > 0;
    });
  }

  /// Whether an entry that names nothing in its input would name something in the output.
  [[nodiscard]] bool names_too_much(const MergedGroup::From& from) {
    if (s_.models[from.input]->groups[from.group.value].n_dangling == 0) return false;
    bool found = false;
    for_each_entity(from, [&](const Entity& e, std::string_view) { found = found || appears(from.input, e); });
    return found;
  }

  [[nodiscard]] bool appears(std::uint32_t input, const Entity& e) {
    return (e.code == kNodeCode && s_.names.node_appears(input, e.tag)) ||
           (e.code == kElementCode && s_.names.element_appears(input, e.tag));
  }

  /// A group of the base in its place; `merged` is null if it receives nothing.
  void rewrite(const MergedGroup::From& from, const MergedGroup* merged, std::size_t g) {
    const Document& d = s_.base();
    const GroupPlace& place = d.groups[from.group.value];
    const Kept kept = kept_lines(from);
    std::string entities;
    const std::int64_t count = merged != nullptr
                                   ? write_members(*merged, g, place.layout, kept, entities)
                                   : write_members({{}, {from}}, kNothingGained, place.layout, kept, entities);
    TextPieces text;
    const Line header = d.lines.at(place.begin), name = d.lines.at(header.next);
    add_header(d.lines.view(header), std::nullopt, static_cast<std::int64_t>(kept.count) + count, place.layout,
               text.made());
    text.made().append(d.lines.view(name)).append(s_.line_end());
    for (const std::string_view run : kept.runs) text.add_span(run);
    text.made() += entities;
    s_.edits.replace(place.begin, place.end, std::move(text));
  }

  /// What a group of the base keeps: its full lines of which no entity goes stay as they are; the entities that are
  /// left of the other lines follow after them, so that a comparison of the texts shows nothing else.
  struct Kept {
    bool any = false;                     // else all its entities have to be written anew
    std::uint64_t count = 0;              // of entities in the runs
    std::vector<std::string_view> runs;   // of lines
    std::vector<std::string_view> loose;  // columns of entities

    void add_lines(std::string_view lines, std::size_t n_entities) {
      count += n_entities;
      if (!runs.empty() && runs.back().data() + runs.back().size() == lines.data())
        runs.back() = {runs.back().data(), runs.back().size() + lines.size()};
      else
        runs.push_back(lines);
    }
    void add(const Kept& after) {
      for (const std::string_view lines : after.runs) add_lines(lines, 0);
      count += after.count;
      loose.insert(loose.end(), after.loose.begin(), after.loose.end());
    }
  };
  [[nodiscard]] Kept kept_lines(const MergedGroup::From& from) {
    const Document& d = s_.base();
    const GroupPlace& place = d.groups[from.group.value];
    RegularGroup group;
    if (!place.regular || s_.models.front()->groups[from.group.value].n_dangling > 0 ||
        !regular_group(d, place.begin, place.end, place.layout, group))
      return {};
    Kept kept;
    kept.any = true;
    const std::size_t per_line = entities_per_line(place.layout);
    const auto parts = collected_by_block<Kept>((group.count + per_line - 1) / per_line,
                                                [&](std::size_t first, std::size_t last, std::vector<Kept>& out) {
                                                  out.push_back(kept_lines(group, place.layout, first, last));
                                                });
    for (const Kept& part : parts) kept.add(part);
    return kept;
  }

  /// The same of lines `first` to `last` - 1.
  [[nodiscard]] Kept kept_lines(const RegularGroup& group, GroupLayout layout, std::size_t first,
                                std::size_t last) const {
    const Document& d = s_.base();
    const std::size_t per_line = entities_per_line(layout), width = layout.entity_size * kIntegerWidth;
    const std::size_t size = per_line * width + d.line_end.size();
    Kept kept;
    RemovedColumns removed(removed_[0]);
    for (std::size_t i = first; i < last; ++i) {
      const std::string_view line = d.text().substr(group.entities + i * size, size);
      const std::size_t n = std::min<std::uint64_t>(per_line, group.count - i * per_line);
      std::size_t n_staying = 0;
      for (std::size_t k = 0; k < n; ++k) n_staying += removed.contain(line.data() + k * width) ? 0 : 1;
      if (n_staying == per_line) {
        kept.add_lines(line, n);
        continue;
      }
      for (std::size_t k = 0; k < n; ++k)
        if (!removed.contain(line.data() + k * width)) kept.loose.push_back(line.substr(k * width, width));
    }
    return kept;
  }

  /// A group that only parts have.
  void append_new(const MergedGroup& merged, std::size_t g) {
    std::string entities, header, name = merged.name;
    const std::int64_t count = write_members(merged, g, layout_, {}, entities);
    std::int64_t number = 0;
    if (!merged.from.empty()) {
      const MergedGroup::From& from = merged.from.front();
      const LineScanner& lines = s_.documents[from.input]->lines;
      const Line header_line = lines.at(s_.documents[from.input]->groups[from.group.value].begin);
      header = lines.view(header_line);
      name = lines.view(lines.at(header_line.next));
      number = s_.models[from.input]->groups[from.group.value].number;
    }
    if (number <= 0 || numbers_.contains(number))
      number = numbers_.empty() ? 1 : std::max<std::int64_t>(*numbers_.rbegin(), 0) + 1;
    numbers_.insert(number);
    std::string& text = new_groups_.made();
    add_header(header, number, count, layout_, text);
    text.append(name).append(s_.line_end());
    text += entities;
  }

  /// Record 1 with another count, and number if given; all other columns as they are.
  void add_header(std::string_view line, std::optional<std::int64_t> number, std::int64_t count, GroupLayout layout,
                  std::string& text) {
    const Cut cut = parse_integers(line, values_);
    if (cut == Cut::kNone) values_.assign(layout.header_fields, 0);
    if (cut == Cut::kColumns && (!number || values_.size() == layout.header_fields)) {
      std::string header(line);
      if (number) set_column(header, 0, *number);
      set_column(header, values_.size() - 1, count);
      text += header;
      text += s_.line_end();
      return;
    }
    if (number) values_.back() = 0, values_.resize(layout.header_fields, 0), values_.front() = *number;
    values_.back() = count;
    append_integers(values_, s_.line_end(), text);
  }

  static constexpr std::size_t kNothingGained = static_cast<std::size_t>(-1);

  /// Entities of all inputs that stay, in input order, then those gained; returns their number. What `kept` has of
  /// a group of the base in whole lines is left out.
  std::int64_t write_members(const MergedGroup& merged, std::size_t g, GroupLayout layout, const Kept& kept,
                             std::string& text) {
    std::int64_t count = 0;
    EntityWriter writer(layout, s_.line_end(), text);
    bool first = true;
    for (const MergedGroup::From& from : merged.from) {
      // Another group of the base with this name has a record of its own.
      if (from.input == 0 && !std::exchange(first, false)) continue;
      first = false;
      if (from.input > 0 || !kept.any) {
        count += write_survivors(from, layout, writer);
        continue;
      }
      for (const std::string_view columns : kept.loose) writer.add_columns(columns);
      count += static_cast<std::int64_t>(kept.loose.size());
    }
    if (g != kNothingGained) {
      for (const std::int64_t label : gained_[g].nodes) writer.add({kNodeCode, label, 0, 0}), ++count;
      for (const std::int64_t label : gained_[g].elements) writer.add({kElementCode, label, 0, 0}), ++count;
    }
    writer.finish();
    return count;
  }

  std::int64_t write_survivors(const MergedGroup::From& from, GroupLayout layout, EntityWriter& writer) {
    const std::uint32_t k = from.input;
    const bool dangling = s_.models[k]->groups[from.group.value].n_dangling > 0;
    const bool relabelled = !s_.labels.shifted_nodes[k].empty() || !s_.labels.shifted_elements[k].empty();
    const bool same_layout = s_.documents[k]->groups[from.group.value].layout.entity_size == layout.entity_size;
    std::int64_t count = 0, left_out = 0;
    for_each_entity(from, [&](Entity e, std::string_view columns) {
      if (removed_[k].contains(e)) return;
      if (dangling && appears(k, e)) {
        ++left_out;
        return;
      }
      ++count;
      const std::int64_t tag = e.tag;
      if (relabelled) e.tag = output_label(k, e);
      if (same_layout && !columns.empty() && e.tag == tag)
        writer.add_columns(columns);
      else
        writer.add(e);
    });
    if (left_out > 0)
      s_.report.warnings.push_back(s_.documents[k]->warning(
          "dangling-members",
          "group " + s_.models[k]->groups[from.group.value].name + ": " + std::to_string(left_out) +
              " entries that named nothing would name something of another input now, and were left out",
          s_.documents[k]->groups[from.group.value].begin));
    return count;
  }

  [[nodiscard]] std::int64_t output_label(std::uint32_t k, const Entity& e) {
    if (e.code == kNodeCode) {
      const std::uint32_t at = index(node_index_, k, s_.models[k]->node_label).find(e.tag);
      return at == LabelIndex::kNone ? e.tag : s_.names.of(NodeRef{k, NodeId(std::size_t{at})});
    }
    if (e.code == kElementCode) {
      const std::uint32_t at = index(element_index_, k, s_.models[k]->element_label).find(e.tag);
      return at == LabelIndex::kNone ? e.tag : s_.names.of(ElementRef{k, ElementId(std::size_t{at})});
    }
    return e.tag;
  }

  const LabelIndex& index(std::vector<std::optional<LabelIndex>>& indices, std::uint32_t k,
                          const std::vector<std::int64_t>& labels) {
    if (indices.empty()) indices.resize(s_.n_inputs());
    if (!indices[k]) indices[k].emplace(labels);
    return *indices[k];
  }

  /// Calls f(entity, its columns) for each entry; the columns are empty if there are none to copy.
  template <class F>
  void for_each_entity(const MergedGroup::From& from, F&& f) {
    const Document& d = *s_.documents[from.input];
    const GroupPlace& place = d.groups[from.group.value];
    RegularGroup regular;
    if (place.regular && regular_group(d, place.begin, place.end, place.layout, regular)) {
      for_each_regular(d, place.layout, regular, f);
      return;
    }
    (void)group_record(d.lines, place.begin, d.datasets[place.dataset].body_end, place.layout, record_);
    for (const Entity& e : record_.entities) f(e, std::string_view{});
  }

  /// The same for a group that the reader found regular.
  template <class F>
  static void for_each_regular(const Document& d, GroupLayout layout, const RegularGroup& group, F&& f) {
    const std::size_t per_line = entities_per_line(layout), width = layout.entity_size * kIntegerWidth;
    std::size_t at = group.entities;
    for (std::uint64_t i = 0; i < group.count; ++i) {
      const char* field = d.lines.text.data() + at;
      Entity e;
      fast_integer(field, e.code), fast_integer(field + kIntegerWidth, e.tag);
      // The reader made sure that nodes and elements have zeros here.
      if (layout.entity_size == 4 && e.code != kNodeCode && e.code != kElementCode) {
        std::vector<std::int64_t> values;
        if (parse_integers(d.lines.text.substr(at, width), values) == Cut::kColumns && values.size() == 4)
          e.leaf = values[2], e.component = values[3];
      }
      f(e, d.lines.text.substr(at, width));
      at += width;
      if ((i + 1) % per_line == 0) at += d.line_end.size();
    }
  }

  Splice& s_;
  std::vector<Removed> removed_;
  std::vector<Gained> gained_;
  const Dataset* last_;
  GroupLayout layout_;
  std::vector<bool> shrinks_;       // by group of the base
  std::set<std::int64_t> numbers_;  // of the base's groups and those written so far
  TextPieces new_groups_;
  GroupRecord record_;
  std::vector<std::int64_t> values_;
  std::vector<std::optional<LabelIndex>> node_index_, element_index_;  // by input, when needed
};

}  // namespace

void splice_groups(Splice& splice) { GroupSplicer(splice).run(); }

}  // namespace meshgraft::unv
