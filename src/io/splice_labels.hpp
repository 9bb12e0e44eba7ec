// Labels of the merged model, and which entities of the inputs change.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "io/label_index.hpp"
#include "meshgraft/graft.hpp"
#include "meshgraft/model.hpp"

namespace meshgraft::unv {

class OutputLabels {
 public:
  OutputLabels(std::span<const Model* const> inputs, const Graft& graft, const Labels& labels);

  /// Label in the output; a replaced node has the label of the node that replaces it.
  [[nodiscard]] std::int64_t of(NodeRef node) const;
  [[nodiscard]] std::int64_t of(ElementRef element) const;

  /// Whether references to nodes of an input change at all, and that to one node.
  [[nodiscard]] bool any_node_changes(std::uint32_t input) const { return !changed_[input].empty(); }
  [[nodiscard]] bool changes(NodeRef node) const {
    return any_node_changes(node.input) && changed_[node.input][node.node.value] != 0;
  }
  [[nodiscard]] bool is_shifted(ElementRef element) const;
  [[nodiscard]] bool is_removed(NodeRef node) const;
  [[nodiscard]] bool is_removed(ElementRef element) const;

  /// Whether `label` is free in `input` but used in the output: an entry of a group of that input
  /// that names nothing would name something then.
  [[nodiscard]] bool node_appears(std::uint32_t input, std::int64_t label);
  [[nodiscard]] bool element_appears(std::uint32_t input, std::int64_t label);

  /// The largest label given to anything that the base does not have.
  [[nodiscard]] std::int64_t largest_new() const;

 private:
  template <class Ref>
  bool appears(std::vector<std::optional<LabelIndex>>& indices, std::uint32_t input, std::int64_t label,
               std::int64_t first_new, std::size_t n_new, const std::vector<std::int64_t>& shift);
  const LabelIndex& index(std::vector<std::optional<LabelIndex>>& indices, std::uint32_t input, bool nodes);

  std::span<const Model* const> inputs_;
  const Graft& graft_;
  const Labels& labels_;
  std::vector<std::vector<std::uint8_t>> changed_;  // [input][node]; empty if nothing changes
  std::vector<std::optional<LabelIndex>> node_index_, element_index_;
};

}  // namespace meshgraft::unv
