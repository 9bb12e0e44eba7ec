// 1D elements in a hole, which its filling follows.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "fill/patched.hpp"
#include "zone/edge_table.hpp"

namespace meshgraft {

struct FollowedBeams {
  std::vector<Region> regions;
  std::set<NodePair> beams;
  std::map<VertexId, Vec3> normal;  // unit, of the surface to be, at nodes of beams that are not of the rims
  std::vector<UnfollowedBeam> unfollowed;
};

/// Cuts a hole along the 1D elements in it.
///
///  (1) A beam may be followed if its nodes are of a rim or of no face, and it hangs together with a rim through others
///      like it. It is, unless there is an Obstacle: it passes over faces around the hole (seen along its area vector),
///      makes more than 20 degrees with the surface at an end, is longer than two sides of the rims, has no length, or
///      leads to a node in whose place another is followed. One that leads nowhere is followed there and back.
///  (2) Where beams do not tell what is one piece (a ring of them around an island of its own), the rims are the only
///      region, as without beams.
///  (3) Of those with an obstacle, `unfollowed` names each that lies along the surface, and each on a way from a rim
///      to a rim, however it runs; not what only stands on the rim and leads elsewhere.
///
///   normals    unit, by vertex of the rims
///   left_out   not to be followed, and why
[[nodiscard]] FollowedBeams follow_beams(const Complex& complex, const VertexFaces& faces_at, const EdgeTable& edges,
                                         const Hole& hole, const std::map<VertexId, Vec3>& normals,
                                         const LeftOut& left_out);

}  // namespace meshgraft
