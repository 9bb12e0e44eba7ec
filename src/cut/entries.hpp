// What the report tells of the pieces that a cut takes out.
#pragma once

#include <span>
#include <vector>

#include "cut/base_pieces.hpp"
#include "meshgraft/report.hpp"

namespace meshgraft {

/// One entry for each piece that goes, in their order.
///
///   complex    cut along the tool, `pieces` are its and the base's
///   position   of its vertices, where they are in the end
///   goes       by piece
[[nodiscard]] std::vector<DroppedEntry> entries_of(const Model& base, const Complex& complex,
                                                   std::span<const Vec3> position, const BasePieces& pieces,
                                                   std::span<const std::uint8_t> goes);

}  // namespace meshgraft
