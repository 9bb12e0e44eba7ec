// Labels of the merged model: the base keeps all of its own, parts give way where they clash.
#pragma once

#include "merge/inputs.hpp"
#include "meshgraft/graft.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

/// The largest label that every reader of universal files takes.
inline constexpr std::int64_t kLargestLabel = 9'999'999'999;

/// Labels by the rules of struct Labels. The shift of an input is the next power of ten above all
/// labels used by it and the inputs before, or where that does not fit the least power of ten that
/// clears them; labels that were removed count as used.
///
/// Error kLabelOverflow if a shifted or new label would exceed kLargestLabel.
/// Cost linear in the number of labels.
[[nodiscard]] Result<Labels> labels_of(Inputs inputs, const Graft& graft);

/// The label of a node or element in the merged model.
[[nodiscard]] std::int64_t label_of(Inputs inputs, const Labels& labels, NodeRef node);
[[nodiscard]] std::int64_t label_of(Inputs inputs, const Labels& labels, ElementRef element);

}  // namespace meshgraft
