// Joins one component of a complex to the earlier ones.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "intersect/imprint.hpp"

namespace meshgraft {

/// A complex under work and what was done to it.
struct Joining {
  Complex complex;
  FaceMarks marks;
  std::vector<std::pair<VertexId, Vec3>> moved{};   // vertex, where it was; ascending
  std::vector<std::array<VertexId, 2>> replaced{};  // vertex of the component, the one it became
  std::vector<Corefined::OpenGap> left_open{};
  std::vector<Corefined::HalfReached> half_reached{};
  std::vector<Corefined::JoinedSeam> joined_seams{};
  std::vector<std::array<Vec3, 2>> sewn{};  // see Corefined
  std::vector<Corefined::Covered> covered{};
  std::vector<Corefined::Traded> traded{};
  std::vector<VertexId> rims{};           // see Sides
  std::span<const std::uint32_t> rank{};  // by component: its place in the order in which they are joined
};

/// Imprints a component and those before it that it is joined to on each other; see corefine().
/// `largest`: the largest coordinate of the whole model, by magnitude; what rounding costs follows
/// from it. `advice`: what to say of surfaces that cross where they may be meant to be one; asked for at a fault. On a
/// fault the Joining is left half done.
[[nodiscard]] std::optional<JunctionFault> join(Joining& joining, std::uint32_t component, double largest,
                                                GroupSets& groups, const CorefineOptions& options,
                                                const std::function<std::optional<std::string>()>& advice);

}  // namespace meshgraft
