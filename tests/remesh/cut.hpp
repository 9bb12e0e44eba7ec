// Scenes of the remesher without the rest of the pipeline: meshes cut and joined along straight lines.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/complex.hpp"
#include "meshgraft/model.hpp"
#include "remesh/remesh.hpp"
#include "zone/brep.hpp"

namespace meshgraft::cut {

struct Scene {
  Complex complex;
  Complex original;                                     // before anything was cut
  std::vector<std::array<VertexId, 2>> junction_edges;  // smaller vertex first, ascending
  std::vector<std::uint8_t> touched;                    // by face: made by a cut, or on the junction
  GroupSets groups;
};

/// The faces of a model as a component of their own; adds to `scene`.
void add(Scene& scene, const Model& model, std::uint32_t component);

/// Cuts the faces of a component where `side` changes its sign; an edge is cut where the linear
/// interpolation of `side` vanishes. The cut edges become junction edges.
void split(Scene& scene, std::uint32_t component, const std::function<double(Vec3)>& side);

/// Makes all components share vertices and edges on the segment from a to b: points of one are
/// inserted in the edges of the others there. REQUIRES: their edges cover it.
void join(Scene& scene, Vec3 a, Vec3 b);

/// 1 for all faces within `rings` neighbourhoods of the touched faces, which are the first.
std::vector<std::uint8_t> zone(const Scene& scene, int rings);

/// Two plates that cross at `degrees`: the base [0,2] x [0,2] with edges `size`, the part with
/// edges `part_size` on the line through (1, y0) turned by `turn` radians, from rim to rim of the base.
Scene crossing(double size, double part_size, double degrees, double y0, double turn, double jitter);

}  // namespace meshgraft::cut
