// Elements of the output: records of the base without the removed ones, then those of the parts,
// then new ones.
#include <algorithm>
#include <array>
#include <optional>

#include "io/splice_context.hpp"
#include "io/unv_element_columns.hpp"
#include "io/unv_format.hpp"
#include "io/unv_types.hpp"

namespace meshgraft::unv {
namespace {

constexpr std::int64_t kNewElementDataset = 2412;

class ElementSplicer {
 public:
  explicit ElementSplicer(Splice& splice)
      : s_(splice),
        last_(splice.last_dataset(DatasetKind::kElements)),
        layout_(element_layout_of(last_ != nullptr ? last_->number : kNewElementDataset)) {}

  void run() {
    cut_records(s_, s_.models.front()->element_place, s_.graft.removed_elements.front(), s_.base().double_elements);
    redirect_base();
    for (std::uint32_t k = 1; k < s_.n_inputs(); ++k) add_part(k);
    add_new();
    if (last_ != nullptr)
      s_.insert_records(*last_, std::move(text_));
    else
      s_.insert_dataset(s_.last_dataset(DatasetKind::kNodes), kNewElementDataset, std::move(text_));
  }

 private:
  /// Elements of the base that refer to a node which another one replaces.
  void redirect_base() {
    if (!s_.names.any_node_changes(0)) return;
    const Model& model = *s_.models.front();
    for_each_kept(model.n_elements(), s_.graft.removed_elements.front(), [&](std::size_t i) {
      const ElementRef e{0, ElementId(i)};
      if (!refers_to_changed(e)) return;
      TextPieces text;
      const ElementLayout layout = layout_at(e);
      add_changed(e, layout, text);
      s_.edits.replace(model.element_place[i], record_->end, std::move(text));
    });
  }

  void add_part(std::uint32_t k) {
    const Document& d = *s_.documents[k];
    const Model& model = *s_.models[k];
    for_each_kept(model.n_elements(), s_.graft.removed_elements[k], [&](std::size_t i) {
      const ElementRef e{k, ElementId(i)};
      const std::size_t begin = model.element_place[i];
      const std::string_view record =
          d.text().substr(begin, d.record_end(model.element_place, i, d.double_elements) - begin);
      if (layout_at(e) == layout_ && !s_.names.is_shifted(e) && !refers_to_changed(e) && d.line_end == s_.line_end() &&
          record.ends_with(s_.line_end()))
        text_.add_span(record);
      else
        add_changed(e, layout_, text_);
    });
  }

  [[nodiscard]] ElementLayout layout_at(ElementRef e) const {
    const Document& d = *s_.documents[e.input];
    return element_layout_of(d.datasets[d.dataset_at(s_.models[e.input]->element_place[e.element.value])].number);
  }

  [[nodiscard]] bool refers_to_changed(ElementRef e) const {
    if (!s_.names.any_node_changes(e.input)) return false;
    for (const NodeId n : s_.models[e.input]->nodes_of(e.element))
      if (n.valid() && s_.names.changes({e.input, n})) return true;
    const NodeRef orientation = orientation_node(e);
    return orientation.valid() && s_.names.changes(orientation);
  }

  [[nodiscard]] NodeRef orientation_node(ElementRef e) const {
    const auto& all = s_.models[e.input]->orientation_nodes;
    const auto at = std::ranges::lower_bound(all, e.element, {}, &OrientationNode::element);
    return at != all.end() && at->element == e.element ? NodeRef{e.input, at->node} : NodeRef{};
  }

  /// Makes record_ that of an element of an input.
  void read(ElementRef e) {
    const Document& d = *s_.documents[e.input];
    const std::size_t begin = s_.models[e.input]->element_place[e.element.value];
    const Dataset& dataset = d.datasets[d.dataset_at(begin)];
    const ElementLayout layout = element_layout_of(dataset.number);
    if (columns_of_ != &dataset) columns_.emplace(d, dataset.body_end, layout), columns_of_ = &dataset;
    record_ = columns_->at(begin);
    if (record_ != nullptr) return;
    (void)element_record(d.lines, begin, dataset.body_end, layout, unusual_);
    record_ = &unusual_;
  }

  /// The record of an input element with the labels of the output, in the given layout.
  void add_changed(ElementRef e, ElementLayout layout, TextPieces& text) {
    read(e);
    labels_.clear();
    for (const NodeId n : s_.models[e.input]->nodes_of(e.element))
      labels_.push_back(n.valid() ? s_.names.of(NodeRef{e.input, n}) : 0);
    add_header(e, s_.names.of(e), layout, text.made());
    if (layout_at(e) == layout && record_->columns)
      add_node_columns(*s_.documents[e.input], text.made());
    else
      append_integers(labels_, s_.line_end(), text.made());
  }

  /// Header and beam line of record_, which belongs to `e`, with another label.
  void add_header(ElementRef e, std::int64_t label, ElementLayout layout, std::string& text) {
    const LineScanner& lines = s_.documents[e.input]->lines;
    const bool same_form = layout_at(e) == layout && record_->columns;
    const std::size_t begin = s_.models[e.input]->element_place[e.element.value];
    if (same_form) {
      std::string header(lines.view(lines.at(begin)));
      set_column(header, 0, label);
      text += header;
      text += s_.line_end();
    } else {
      const auto& attributes = s_.models[e.input]->attributes_of(e.element);
      append_integers(header_of(attributes, label, record_->nodes.size(), layout), s_.line_end(), text);
    }
    add_beam(e, layout, same_form, text);
  }

  void add_beam(ElementRef e, ElementLayout layout, bool same_form, std::string& text) {
    const bool needed = has_beam_record(s_.models[e.input]->attributes_of(e.element).type);
    if (layout == ElementLayout::k71 || (record_->beam.empty() && (same_form || !needed))) return;
    const NodeRef orientation = orientation_node(e);
    if (same_form) {
      const LineScanner& lines = s_.documents[e.input]->lines;
      std::string beam(lines.view(lines.at(record_->beam_line)));
      if (orientation.valid()) set_column(beam, 0, s_.names.of(orientation));
      text += beam;
      text += s_.line_end();
      return;
    }
    constexpr std::size_t kFields = 3, kFields780 = 5;
    std::vector<std::int64_t> beam = record_->beam;
    if (layout == ElementLayout::k780)
      beam.resize(kFields780, 1);
    else
      beam.resize(kFields, 0);
    beam[0] = orientation.valid() ? s_.names.of(orientation) : record_->beam.empty() ? 0 : record_->beam[0];
    append_integers(beam, s_.line_end(), text);
  }

  /// The node lines of record_ with labels_ in their columns.
  void add_node_columns(const Document& d, std::string& text) {
    std::size_t at = record_->node_lines, next = 0;
    while (next < labels_.size()) {
      const Line line = d.lines.at(at, record_->end);
      std::string content(d.lines.view(line));
      const std::size_t n = (right_trimmed(content).size() + kIntegerWidth - 1) / kIntegerWidth;
      for (std::size_t k = 0; k < n; ++k, ++next)
        if (record_->nodes[next] != labels_[next]) set_column(content, k, labels_[next]);
      text += content;
      text += s_.line_end();
      at = line.next;
    }
  }

  void add_new() {
    std::int64_t label = s_.labels.first_new_element;
    for (const NewElement& e : s_.graft.new_elements) {
      read(e.parent);
      add_header(e.parent, label++, layout_, text_.made());
      labels_.clear();
      for (const NodeRef n : e.nodes)
        if (n.valid()) labels_.push_back(s_.names.of(n));
      append_integers(labels_, s_.line_end(), text_.made());
    }
  }

  Splice& s_;
  const Dataset* last_;
  ElementLayout layout_;
  TextPieces text_;
  std::optional<ElementColumns> columns_;
  const Dataset* columns_of_ = nullptr;
  ElementRecord unusual_;
  const ElementRecord* record_ = nullptr;  // the one read last
  std::vector<std::int64_t> labels_;
};

}  // namespace

void splice_elements(Splice& splice) { ElementSplicer(splice).run(); }

}  // namespace meshgraft::unv
