// What must hold before a merge is tried: sensible options, faces, one system of units, one scale.
#pragma once

#include <vector>

#include "core/components.hpp"
#include "merge/inputs.hpp"
#include "meshgraft/options.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

struct CompatibilityLimits {
  /// Two models whose boxes and edges are both this many times apart in size do not belong
  /// together, nor do two meshes whose edges are where they meet: no grading joins those.
  double max_size_ratio = 200;
  /// Faces looked at to learn the size of a model; evenly spread over it.
  std::size_t sample = 4096;
};

/// Checks options and inputs. Errors: kUsage, kNoFaces, kBadNumber, kUnitsDiffer,
/// kCoordinateSystem, kScaleMismatch. Cost: one look at every node.
[[nodiscard]] Result<void> check_compatible(Inputs inputs, const MergeOptions& options,
                                            const CompatibilityLimits& limits = {});

/// kScaleMismatch if the meshes differ too much where they meet, kUsage if a wanted edge length differs
/// as much from those of each: a far smaller one would take all memory. `candidates`: faces by input.
[[nodiscard]] Result<void> check_local_scale(Inputs inputs, std::span<const std::vector<ElementId>> candidates,
                                             const MergeOptions& options, const CompatibilityLimits& limits = {});

/// kUsage if a tolerance or a length to be trimmed is above the size of a component of an input that is several, and
/// that comes near another. `candidates`: faces by input.
[[nodiscard]] Result<void> check_component_sizes(Inputs inputs, const Components& components,
                                                 std::span<const std::vector<ElementId>> candidates,
                                                 const MergeOptions& options);

}  // namespace meshgraft
