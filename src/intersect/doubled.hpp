// Faces that lie twice in one place.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "intersect/meeting.hpp"

namespace meshgraft {

/// Two faces on the same vertices among the marked ones: kDuplicateFace in one component, kOverlap
/// in two. With the later of the two faces.
std::optional<std::pair<JunctionFault, FaceId>> find_doubled_face(const Complex& complex,
                                                                  std::span<const std::uint8_t> marked);

/// Why a face could not be cut, if this is the reason: on one of the sides two faces of an input lie
/// within the weld length of each other there, on the same vertices or on vertices of their own.
std::optional<JunctionFault> doubled_faces_at(const Meeting& meeting, FaceId uncut);

}  // namespace meshgraft
