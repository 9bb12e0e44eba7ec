// What is within the tolerance of the other side and is yet no gap to be closed.
#pragma once

#include "intersect/meeting.hpp"

namespace meshgraft {

/// True if a face at the vertex would have all three corners on one face of the other side at `on`. A face thinner than
/// the tolerance (a piece left by an earlier component) would fold onto it.
[[nodiscard]] bool would_flatten(const Meeting& m, std::size_t s, VertexId v, const Carrier& on);

/// True if a line of the vertex's side, of free edges or such with more than two faces, comes from a symbol on the free
/// edge e of the other side and stands off that all the way to the vertex: the two have met, and what is between them
/// beyond that place is no gap.
[[nodiscard]] bool have_met(const Meeting& m, std::size_t s, VertexId v, LocalEdge e);

/// True if side s has the edge e of the other side, too, and there a face of the mesh that v is on, which stays between
/// the two: that mesh is joined to the other along the edge, and v is no gap away from it.
[[nodiscard]] bool is_beyond_own_face(const Meeting& m, std::size_t s, VertexId v, LocalEdge e);

}  // namespace meshgraft
