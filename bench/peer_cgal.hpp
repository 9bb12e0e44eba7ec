// The peer: the same merge, arrays to arrays, done with what CGAL offers ready-made.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "meshgraft/vec3.hpp"

namespace meshgraft::bench {

struct Triangles {
  std::vector<Vec3> position;
  std::vector<std::array<std::uint32_t, 3>> faces;
};

struct PeerOptions {
  int neighbourhoods = 2;   // of faces around the junction, remeshed on both sides (paper 5.4)
  unsigned iterations = 3;  // of the isotropic remeshing
  double target_size = 0;   // edge length in the band
  /// Keeps each edge of the junction as corefinement left it, so that the meshes stay joined. Without,
  /// each mesh resamples the junction for itself: better shapes, but the nodes no longer meet.
  bool conforming = true;
};

struct PeerResult {
  Triangles merged;             // one mesh, nodes shared along the junction
  std::size_t first_new = 0;    // faces before it were not remeshed
  double build_seconds = 0;     // arrays to half-edge meshes
  double corefine_seconds = 0;  // Polygon_mesh_processing::corefine
  double remesh_seconds = 0;    // selection of the band and isotropic_remeshing
  double collect_seconds = 0;   // half-edge meshes to arrays
  [[nodiscard]] double seconds() const { return build_seconds + corefine_seconds + remesh_seconds + collect_seconds; }
};

/// Both inputs must be manifold: CGAL's half-edge mesh holds nothing else. Groups and labels do
/// not exist here.
[[nodiscard]] PeerResult merge_with_cgal(const Triangles& base, const Triangles& part, const PeerOptions& options);

}  // namespace meshgraft::bench
