// The edges of the remeshed base along which it was cut.
#pragma once

#include <span>

#include "merge/dropped.hpp"
#include "merge/junction_summary.hpp"

namespace meshgraft {

/// Free edges of the final complex whose ends lie on the segments of the cut, and whose middles are as
/// near to these as those of chords are.
[[nodiscard]] Junction cut_edges(const Complex& complex, std::span<const Dropped::Segment> border);

}  // namespace meshgraft
