// Spots of a base that a tool only grazes.
#pragma once

#include <cstdint>
#include <vector>

#include "intersect/corefine.hpp"
#include "meshgraft/model.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

/// Takes the curves around pockets of base and tool (see find_pockets()) out of the junction: no face as large as those
/// around fits into such a spot, so it stays, or goes, with what is around it. One warning for those that the tool cuts
/// deeper than the tolerance.
///
///   tool   its component
[[nodiscard]] std::vector<Warning> leave_grazed(const Model& base, std::uint32_t tool, Tolerance tolerance,
                                                Corefined& corefined);

}  // namespace meshgraft
