// First step of the remesher: the curves of the zone get their final nodes (paper 5.3).
#pragma once

#include "remesh/editor.hpp"

namespace meshgraft {

/// Resamples every curve of the zone between its fixed vertices.
///
///  (1) Stretches in which the nodes of the inputs already stand at the wanted spacing keep them.
///  (2) Elsewhere the ruler says where nodes stand; a vertex that is there already is used.
///  (3) Vertices that are too many and cannot be removed yet stay; later steps try again.
///  (4) Nodes of the inputs at which a curve turns are held (Editor::hold()), as far as the spacing allows.
///
///   loose   vertices that are not to be held, ascending
void resample_curves(Editor& editor, const Complex& complex, const Brep& brep, const Sizing& sizing,
                     std::span<const VertexId> loose = {});

}  // namespace meshgraft
