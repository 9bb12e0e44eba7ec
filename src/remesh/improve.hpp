// The steps of the remesher that work on the inside of the sheets.
#pragma once

#include "remesh/editor.hpp"

namespace meshgraft {

/// A good face of the input as it was: what stands in a zone without need.
[[nodiscard]] bool is_settled(const Editor& editor, FaceId f);
/// The same for all faces at a vertex.
[[nodiscard]] bool is_settled(const Editor& editor, VertexId v);

/// Removes vertices that stand too close for the wanted size and splits edges too long for it.
void fit_to_size(Editor& editor);

/// Flips edges, then moves vertices, where that lowers the cost. Settled vertices are left alone.
void relax_all(Editor& editor);
/// The same without flips, for the vertices of curves only.
void relax_curves(Editor& editor);

/// Lets go of the vertices held at faces with Q < `target` and beside these.
///   returns   them, ascending
std::vector<VertexId> release_poor(Editor& editor, double target);

/// Whether a flip must bring vertices nearer to six faces (in squares), or only not farther from that.
enum class Irregularity : std::uint8_t { kLess, kNotMore };

/// Flips edges and removes vertices where that brings vertices nearer to six faces (or what the angle of their
/// sheet there has room for) and lowers the cost: irregular vertices are what keeps the mean Q down. Settled
/// vertices are left alone.
void regularise(Editor& editor, Irregularity wanted = Irregularity::kLess);

/// Mends faces with Q < `target` that are not settled, or too far from the reference, worst Q first, by whatever local
/// operation helps most; stops when none is left or nothing helps.
void mend(Editor& editor, double target);

}  // namespace meshgraft
