// Several plates on one base, over each other in any way.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "plate_pairs.hpp"

namespace meshgraft::checks {

/// The base of the first pair, and the plate of each.
[[nodiscard]] std::vector<Model> models(std::span<const PlatePair> stack);

/// What is wrong with base and plates after corefinement, up to what may be snapped:
///   no face turned over, no edge with a third face;
///   a face stands for exactly those that have it in their area, each once;
///   the group of each covers what it covered.
[[nodiscard]] std::vector<std::string> faults(std::span<const PlatePair> stack, const std::vector<Model>& models,
                                              const Corefined& after, const GroupSets& sets);

}  // namespace meshgraft::checks
