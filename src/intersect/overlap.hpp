// Faces that lie on each other over an area, which this way of joining does not handle.
#pragma once

#include <optional>

#include "intersect/meeting.hpp"

namespace meshgraft {

/// True if points on both faces, `thickness` off a common line, mean that the faces share area.
/// Planes that cross at some angle are within the tolerance of each other on a strip, so only faces
/// nearly parallel to each other count.
bool is_area(const Meeting& meeting, const FacePair& faces, double thickness, const CorefineOptions& options);

/// The first pair of faces nearly parallel to each other and within the tolerance over more than a
/// strip.
std::optional<FacePair> find_overlap(const Meeting& meeting, const CorefineOptions& options);

JunctionFault overlap_fault(const Meeting& meeting, const FacePair& faces);

}  // namespace meshgraft
