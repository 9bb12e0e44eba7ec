// Labels of the merged model: the base keeps all of its own, parts give way where they clash.
#pragma once

#include "merge/inputs.hpp"
#include "meshgraft/graft.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

/// The largest label that every reader of universal files takes.
inline constexpr std::int64_t kLargestLabel = 9'999'999'999;

/// Labels by the rules of struct Labels. The shift of an input is the least multiple of a power of ten that
/// clears all labels used by it and the inputs before; labels that were removed count as used. That power of
/// ten is the one above all labels of these inputs, so that element 57 becomes 10057 or 20057, or where that
/// leads beyond eight digits, which the columns of some formats end at (or else beyond 32 bits, or kLargestLabel),
/// the one above the range of the labels that clash.
///
/// Cost linear in the number of labels, and those of parts times the number of inputs.
[[nodiscard]] Labels labels_of(Inputs inputs);

/// Error kLabelOverflow if a shifted label, or one of what is new, would exceed kLargestLabel.
[[nodiscard]] Result<void> check_room(const Labels& labels, const Graft& graft);

/// The label of a node or element in the merged model.
[[nodiscard]] std::int64_t label_of(Inputs inputs, const Labels& labels, NodeRef node);
[[nodiscard]] std::int64_t label_of(Inputs inputs, const Labels& labels, ElementRef element);

}  // namespace meshgraft
