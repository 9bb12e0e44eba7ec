// 1D elements in a hole, which its filling follows.
#pragma once

#include <map>
#include <vector>

#include "fill/patched.hpp"
#include "zone/edge_table.hpp"

namespace meshgraft {

/// A piece of a hole that is filled by itself.
using Region = std::vector<std::vector<VertexId>>;  // closed chains with what is open on the left, as in Opening

struct FollowedBeams {
  std::vector<Region> regions;
  std::set<NodePair> beams;
  std::map<VertexId, Vec3> normal;  // unit, of the surface to be, at nodes of beams that are not of the rims
};

/// Cuts a hole along the 1D elements in it. A beam counts if its nodes are of a rim or of no face, if it lies within
/// the hole (seen along its area vector) and within 20 degrees of the surface, is no longer
/// than two sides of the rims, and hangs together with a rim through
/// others like it. One that leads nowhere is followed there and back. Without such beams, and where they do not tell
/// what is one piece (a ring of beams around an island of its own), the rims are the only region.
///
///   normals   unit, by vertex of the rims
[[nodiscard]] FollowedBeams follow_beams(const Complex& complex, const VertexFaces& faces_at, const EdgeTable& edges,
                                         const Hole& hole, const std::map<VertexId, Vec3>& normals);

}  // namespace meshgraft
