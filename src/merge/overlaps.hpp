// What faces that lie on each other mean for elements, groups and the report (paper 4, face/face).
#pragma once

#include <vector>

#include "intersect/corefine.hpp"
#include "merge/dropped.hpp"
#include "merge/group_table.hpp"
#include "meshgraft/options.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

/// Overlap::kProject: each face with a layer becomes two faces on the same nodes, the second with
/// parent, groups, attributes and orientation of the layer. New faces stand at the end.
[[nodiscard]] Complex both_layers(const Complex& complex, Inputs inputs, SetTranslation& translated);

/// Adds the area that groups lose although nothing is lost: of faces that went because others lie there, and of
/// groups that both faces were in and that count the one that stands for both once.
void add_losses(const Corefined& corefined, const Complex& final_complex, bool two_layers, SetTranslation& translated,
                Graft& graft, Dropped& dropped);

/// kOverlap if all faces of an input go.
[[nodiscard]] Result<void> check_something_left(Inputs inputs, const Complex& original, const Corefined& corefined);

/// Fused faces whose two parents differ in attributes have those of the first: said once for each
/// pair of attributes.
[[nodiscard]] std::vector<Warning> attribute_warnings(Inputs inputs, const Complex& final_complex);

}  // namespace meshgraft
