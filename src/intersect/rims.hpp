// Free edges of what lies on another mesh that end on a third: a pad on a wall, with a hole for a pipe that passes
// through both.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "intersect/component_pairs.hpp"
#include "intersect/extend.hpp"

namespace meshgraft {

struct Rims {
  Extensions extensions;
  std::vector<std::array<std::uint32_t, 2>> ends;  // component with the rim, the one that it ends on; ascending
};

/// Such edges, and their extensions to the third mesh, as of extensions(). They have to be made before anything is
/// joined: what lies on another mesh becomes one with it, and its border is a free edge no longer. Those of the mesh of
/// component 0 stay.
///
///   near   by component, see near_faces()
///   size   by face of the complex: its mean edge length
///
/// Cost: that of find_contacts() for components that are near two others or more.
[[nodiscard]] Rims find_rims(const Complex& complex, std::span<const NearFaces> near, std::span<const double> size,
                             const SnapRule& snap, const CorefineOptions& options);

/// Ranks in which what a rim ends on is joined before the mesh that has the rim: that mesh is cut along the line that
/// is there then. Else ascending.
[[nodiscard]] std::vector<std::uint32_t> ranks(std::size_t n_components,
                                               std::span<const std::array<std::uint32_t, 2>> ends);

}  // namespace meshgraft
