// Free edges of what lies on another mesh that end on a third: a pad on a wall, with a hole for a pipe that passes
// through both.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "intersect/component_pairs.hpp"
#include "intersect/extend.hpp"

namespace meshgraft {

/// Extensions of such edges of one component to others that it does not lie on, as of extensions(); none if the others
/// are of one component. `own`, `others`: ascending. Cost: that of find_contacts().
[[nodiscard]] Extensions rim_extensions(const Complex& complex, std::uint32_t component, std::span<const FaceId> own,
                                        std::span<const FaceId> others, std::span<const double> size,
                                        const SnapRule& snap, const CorefineOptions& options);

struct Rims {
  Extensions extensions;
  std::vector<std::array<std::uint32_t, 2>> ends;  // a component, one that free edges of it end on; ascending
};

/// The same for all components as they are given, and what all free edges end on. Rims have to be drawn before anything
/// is joined: what lies on another mesh becomes one with it, and its border is a free edge no longer. Those of the mesh
/// of component 0 stay.
///
///   near   by component, see near_faces()
///   size   by face of the complex: its mean edge length
///
/// Cost: that of find_contacts() for components that are near two others or more.
[[nodiscard]] Rims find_rims(const Complex& complex, std::span<const NearFaces> near, std::span<const double> size,
                             const SnapRule& snap, const CorefineOptions& options);

/// Ranks in which what a mesh ends on is joined before it: a corner between two such meshes is drawn to both at once,
/// and not to one, in which it is then held; and what lies on it is cut along a line that is there. Else ascending.
///
///   ends   as in Rims
[[nodiscard]] std::vector<std::uint32_t> ranks(std::size_t n_components,
                                               std::span<const std::array<std::uint32_t, 2>> ends);

}  // namespace meshgraft
