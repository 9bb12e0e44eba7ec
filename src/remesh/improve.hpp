// The steps of the remesher that work on the inside of the sheets.
#pragma once

#include "remesh/editor.hpp"

namespace meshgraft {

/// Removes vertices that stand too close for the wanted size and splits edges too long for it.
void fit_to_size(Editor& editor);

/// Flips edges, then moves vertices, where that lowers the cost. Vertices of the inputs whose faces are all as
/// they were, and good, are left alone.
void relax_all(Editor& editor);
/// The same without flips, for the vertices of curves only.
void relax_curves(Editor& editor);

/// Flips edges and removes vertices where that brings vertices nearer to six faces (or what the angle of their
/// sheet there has room for) and lowers the cost: irregular vertices are what keeps the mean Q down.
void regularise(Editor& editor);

/// Mends faces with Q < `target` or too far from the reference, worst Q first, by whatever local operation
/// helps most; stops when none is left or nothing helps.
void mend(Editor& editor, double target);

}  // namespace meshgraft
