// Gaps within the tolerance that were not closed after all.
#pragma once

#include <vector>

#include "intersect/meeting.hpp"

namespace meshgraft {

/// Places where a feature is within the tolerance of the other side but nothing joins them there or
/// beside it, each feature once, in order of their ids. Call it once all
/// symbols are known. Cost n log n in pairs and symbols.
[[nodiscard]] std::vector<Corefined::OpenGap> find_open_gaps(const Meeting& meeting);

}  // namespace meshgraft
