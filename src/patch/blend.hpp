// Deformation of the filled areas of a working mesh.
#pragma once

#include "meshgraft/options.hpp"
#include "patch/deform.hpp"
#include "remesh/editor.hpp"

namespace meshgraft {

struct BlendOptions {
  Blend blend = Blend::kTangency;
  /// Curves whose sides are folded less than this are crossed: the surface goes on beyond them. Radians.
  double smooth_angle = BrepOptions{}.sharp_angle;
  /// Faces in the zone continue those beyond any curve whatever the angle between them.
  bool rim_is_smooth = false;
  DeformOptions deform;
};

/// As in Deformed, the most of all areas.
struct Blended {
  double moved = 0, left = 0;
  Vec3 left_at;
};

/// Moves the new vertices inside filled curved sheets to where they continue the surroundings (see deformed()): the
/// faces outside the zone, and vertices on curves, which stay. Sheets of one component that lie on either side of a
/// curve without a fold are one area.
///
///   filled   by sheet: whether its faces were filled anew
Blended blend_filled(Editor& editor, const Complex& complex, const std::vector<std::uint8_t>& filled,
                     const BlendOptions& options);

}  // namespace meshgraft
