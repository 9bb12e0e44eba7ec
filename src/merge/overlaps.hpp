// What faces that lie on each other mean for elements, groups and the report (paper 4, face/face).
#pragma once

#include <vector>

#include "core/components.hpp"
#include "intersect/corefine.hpp"
#include "merge/dropped.hpp"
#include "merge/group_table.hpp"
#include "meshgraft/options.hpp"
#include "meshgraft/report.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

/// A complex in which each layer has faces of its own.
struct LaidOut {
  Complex complex;
  std::vector<FaceId> beneath;  // by added face: the one on the same nodes that was there
};

/// Overlap::kProject: each face with layers gets a face on the same nodes for each of them, with parent,
/// groups, attributes and orientation of the layer. New faces stand at the end.
[[nodiscard]] LaidOut with_layers(const Complex& complex, Inputs inputs, SetTranslation& translated);

/// Adds the area that groups lose although nothing is lost: of faces that went because others lie there, and of
/// groups that several faces were in and that count the one that stands for them once. Groups of the nodes of faces
/// that went are marked as touched.
void add_losses(Inputs inputs, const Corefined& corefined, const Complex& final_complex, bool all_layers,
                SetTranslation& translated, Graft& graft, Dropped& dropped);

/// For the report; `final_complex` before it is laid out in layers.
[[nodiscard]] std::vector<OverlapEntry> overlap_entries(Inputs inputs, const Components& components,
                                                        const Corefined& corefined, const Complex& final_complex,
                                                        bool all_layers);

/// Over how many gaps in a row what goes without an heir was drawn: of three meshes apart, the last of which is kept,
/// the first ends on the second and then, with it, on the third. At least 1.
[[nodiscard]] std::size_t gaps_in_a_row(const Corefined& corefined);

/// kOverlap if all faces of a component go.
[[nodiscard]] Result<void> check_something_left(Inputs inputs, const Components& components, const Complex& original,
                                                const Corefined& corefined);

/// Fused faces whose parents differ in attributes have those of the first: said once for each
/// pair of attributes.
[[nodiscard]] std::vector<Warning> attribute_warnings(Inputs inputs, const Complex& final_complex);

}  // namespace meshgraft
