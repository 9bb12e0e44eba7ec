// What the faces around a zone leave for those in it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/complex.hpp"
#include "remesh/sizing.hpp"
#include "zone/brep.hpp"
#include "zone/size_field.hpp"

namespace meshgraft {

/// The answers of a size field, but where edges at which the zone ends are much shorter than it asks for, as in meshes
/// of narrow faces that lie across the end: no longer than these there, and graded from them. Such edges stay, and
/// faces of the size asked for would be poor on them. Cost O(m log m) for m faces.
[[nodiscard]] Sizing sizing_in_zone(const Complex& complex, const Brep& brep, const SizeField& size,
                                    const std::vector<std::uint8_t>& in_zone);

}  // namespace meshgraft
