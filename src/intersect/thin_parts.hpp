// Two sides of one mesh that the tolerance would make one.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "intersect/contact.hpp"

namespace meshgraft {

/// The fault, with their distance, if faces of one component lie on each other over most of their common area,
/// farther apart than rounding and nearer than the tolerance: a part that ends on both would have its two
/// sides welded together. The nearest such pair, ties by id. Faces with a common vertex do not count.
///
///   faces   of one component, ascending: those near another one
///   size    by face of the complex
///
/// Cost n log n, and that of find_contacts() for faces that are near others without being their neighbours.
[[nodiscard]] std::optional<JunctionFault> find_thin_part(const Complex& complex, std::span<const FaceId> faces,
                                                          std::span<const double> size, const ContactRule& rule);

}  // namespace meshgraft
