// The shape of what closes the holes of a complex.
#pragma once

#include "fill/patched.hpp"
#include "fill/rim_sizes.hpp"
#include "patch/blend.hpp"

namespace meshgraft {

struct Shaped {
  Remeshed remeshed;
  Blended blended;  // the last time
};

/// Gives patches the density of `sizing` and the shape that continues what is around (paper 5.6). With
/// Method::kAdaptive the mesh is improved on that surface, and shaped again, until that moves little: first a mesh that
/// is coarse inside, which tells the shape, then on that surface the one that is wanted.
[[nodiscard]] Shaped shaped(const Patched& coarse, const RimSizing& sizing, GroupSets& groups,
                            const MergeOptions& options);

}  // namespace meshgraft
