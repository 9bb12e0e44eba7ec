// What components share once they are conforming.
#pragma once

#include "intersect/corefine.hpp"

namespace meshgraft {

/// Fills junction_edges, junction_points and met from the complex.
void find_shared(Corefined& corefined);

}  // namespace meshgraft
