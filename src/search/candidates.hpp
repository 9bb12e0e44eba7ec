// Which faces can meet a face of another input (paper 5.1).
#pragma once

#include <span>
#include <vector>

#include "meshgraft/model.hpp"
#include "meshgraft/options.hpp"

namespace meshgraft {

struct SearchOptions {
  double box_scale = 1.05;  // growth of the box of each face, paper 5.1
  Tolerance tolerance;      // boxes grow by this instead, if larger
};

/// The faces of each input whose grown box meets the grown box of a face of another input,
/// ascending. One linear pass over every input, then a hierarchy over what is left; cost linear in
/// the faces plus n log n in the faces near another input's box.
[[nodiscard]] std::vector<std::vector<ElementId>> candidate_faces(std::span<const Model* const> inputs,
                                                                  const SearchOptions& options);

}  // namespace meshgraft
