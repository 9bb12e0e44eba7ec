// The pieces of sheets that are deleted and filled again, and what bounds them.
#pragma once

#include <vector>

#include "remesh/local_mesh.hpp"

namespace meshgraft {

/// Faces of the zone that hang together inside one sheet.
struct Region {
  SheetId sheet;
  std::vector<FaceId> faces;                    // ascending
  std::vector<std::vector<VertexId>> contours;  // as in Opening; fixed vertices inside are contours of one vertex
  std::vector<std::vector<CurveId>> sides;      // by contour and corner: the curve of the edge to the next one
  std::vector<VertexId> inside;                 // vertices that go
};

/// All regions, by their smallest face. A contour goes along curves and along the faces that stay.
[[nodiscard]] std::vector<Region> regions_of(const LocalMesh& mesh);

}  // namespace meshgraft
