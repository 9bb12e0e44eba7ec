// Which faces can meet a face of another component (paper 5.1).
#pragma once

#include <span>
#include <vector>

#include "core/components.hpp"
#include "meshgraft/model.hpp"
#include "meshgraft/options.hpp"
#include "search/face_runs.hpp"

namespace meshgraft {

struct SearchOptions {
  double box_scale = 1.05;  // growth of the box of each face, paper 5.1
  Tolerance tolerance;      // boxes grow by this instead, if larger
};

/// By input the faces whose grown box meets the grown box of a face of a component that theirs is
/// joined to, ascending. `runs`: of these inputs. One linear pass over every input, then a hierarchy over what is left;
/// cost linear in the faces plus n log n in the faces near another component's box.
[[nodiscard]] std::vector<std::vector<ElementId>> candidate_faces(std::span<const Model* const> inputs,
                                                                  const FaceRuns& runs, const Components& components,
                                                                  const SearchOptions& options);

}  // namespace meshgraft
