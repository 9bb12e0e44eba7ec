// Nodes of the output: records of the base without the removed ones, then those of the parts, then
// new ones.
#include <algorithm>

#include "io/splice_context.hpp"
#include "io/unv_format.hpp"
#include "io/unv_nodes.hpp"

namespace meshgraft::unv {
namespace {

constexpr std::int64_t kNewNodeDataset = 2411;
constexpr std::array<std::int64_t, 3> kDefaultFields{1, 1, 11};  // systems and colour

class NodeSplicer {
 public:
  explicit NodeSplicer(Splice& splice) : s_(splice), exponent_(exponent_of_base()) {}

  void run() {
    cut_records(s_, s_.models.front()->node_place, s_.graft.removed_nodes.front(), s_.base().double_nodes);
    move_base();
    for (std::uint32_t k = 1; k < s_.n_inputs(); ++k) add_part(k);
    add_new();
    // Dataset 15 has no room for the digits of new coordinates: nodes that join it get a dataset
    // of their own.
    const Dataset* last = s_.last_dataset(DatasetKind::kNodes);
    if (last != nullptr && node_layout_of(last->number) == NodeLayout::kTwoLines)
      s_.insert_records(*last, std::move(text_));
    else
      s_.insert_dataset(last, kNewNodeDataset, std::move(text_));
  }

 private:
  /// The letter that the first real of the base's nodes has before its exponent.
  [[nodiscard]] char exponent_of_base() const {
    const Model& base = *s_.models.front();
    constexpr std::size_t kRecordBytes = 120;
    if (base.node_place.empty()) return 'D';
    const std::string_view record = s_.base().text().substr(base.node_place.front(), kRecordBytes);
    const std::size_t at = record.find_first_of("EeDd");
    return at == std::string_view::npos ? 'D' : record[at];
  }

  /// Nodes of the base that were moved, when it was joined with itself. Dataset 15 has no room for
  /// the digits of their coordinates.
  void move_base() {
    const Document& d = s_.base();
    const Model& model = *s_.models.front();
    for (const Graft::MovedNode& moved : s_.graft.moved_nodes) {
      if (moved.node.input != 0) break;
      const std::size_t i = moved.node.node.value, begin = model.node_place[i];
      const std::size_t end = d.record_end(model.node_place, i, d.double_nodes);
      const Dataset& dataset = d.datasets[d.dataset_at(begin)];
      const std::int64_t label = s_.names.of(moved.node);
      if (node_layout_of(dataset.number) == NodeLayout::kTwoLines) {
        TextPieces text;
        add_changed(d, begin, dataset.body_end, label, &moved, text);
        s_.edits.replace(begin, end, std::move(text));
      } else {
        s_.edits.cut(begin, end);
        add_in_other_form(d, begin, dataset, label, &moved);
      }
    }
  }

  void add_part(std::uint32_t k) {
    const Document& d = *s_.documents[k];
    const Model& model = *s_.models[k];
    for_each_kept(model.n_nodes(), s_.graft.removed_nodes[k], [&](std::size_t i) {
      const NodeRef node{k, NodeId(i)};
      const Graft::MovedNode* moved = moved_node(node);
      const std::size_t begin = model.node_place[i], end = d.record_end(model.node_place, i, d.double_nodes);
      const Dataset& dataset = d.datasets[d.dataset_at(begin)];
      const bool same_form = node_layout_of(dataset.number) == NodeLayout::kTwoLines;
      const std::string_view record = d.text().substr(begin, end - begin);
      if (same_form && moved == nullptr && !s_.names.changes(node) && d.line_end == s_.line_end() &&
          record.ends_with(s_.line_end()))
        text_.add_span(record);
      else if (same_form)
        add_changed(d, begin, dataset.body_end, s_.names.of(node), moved, text_);
      else
        add_in_other_form(d, begin, dataset, s_.names.of(node), moved);
    });
  }

  /// The record with another label or other coordinates; everything else as it is.
  void add_changed(const Document& d, std::size_t begin, std::size_t limit, std::int64_t label,
                   const Graft::MovedNode* moved, TextPieces& into) {
    const Line first = d.lines.at(begin, limit), second = d.lines.at(first.next, limit);
    std::string header(d.lines.view(first));
    if (parse_integers(header, values_) == Cut::kColumns) {
      set_column(header, 0, label);
      header += s_.line_end();
    } else {
      values_.front() = label, header.clear();
      append_integers(values_, s_.line_end(), header);
    }
    std::string& text = into.made();
    text += header;
    if (moved != nullptr) {
      append_point(moved->to, exponent_, s_.line_end(), text);
    } else {
      text += d.lines.view(second);
      text += s_.line_end();
    }
  }

  void add_in_other_form(const Document& d, std::size_t begin, const Dataset& dataset, std::int64_t label,
                         const Graft::MovedNode* moved) {
    const auto record = node_record(d.lines, begin, dataset.body_end, node_layout_of(dataset.number), values_);
    add(label, record->fields, moved != nullptr ? moved->to : record->position);
  }

  void add(std::int64_t label, const std::array<std::int64_t, 3>& fields, Vec3 position) {
    std::string& text = text_.made();
    append_integers(std::array{label, fields[0], fields[1], fields[2]}, s_.line_end(), text);
    append_point(position, exponent_, s_.line_end(), text);
  }

  void add_new() {
    std::int64_t label = s_.labels.first_new_node;
    for (const NewNode& node : s_.graft.new_nodes) add(label++, fields_of(node.like), node.position);
  }

  [[nodiscard]] std::array<std::int64_t, 3> fields_of(NodeRef like) {
    if (!like.valid() || like.input >= s_.n_inputs()) return kDefaultFields;
    const Document& d = *s_.documents[like.input];
    const std::size_t begin = s_.models[like.input]->node_place[like.node.value];
    const Dataset& dataset = d.datasets[d.dataset_at(begin)];
    const auto record = node_record(d.lines, begin, dataset.body_end, node_layout_of(dataset.number), values_);
    return record ? record->fields : kDefaultFields;
  }

  [[nodiscard]] const Graft::MovedNode* moved_node(NodeRef node) const {
    const auto at = std::ranges::lower_bound(s_.graft.moved_nodes, node, {}, &Graft::MovedNode::node);
    return at != s_.graft.moved_nodes.end() && at->node == node ? &*at : nullptr;
  }

  Splice& s_;
  char exponent_;
  TextPieces text_;
  std::vector<std::int64_t> values_;
};

}  // namespace

void splice_nodes(Splice& splice) { NodeSplicer(splice).run(); }

}  // namespace meshgraft::unv
