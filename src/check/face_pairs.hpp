// Faces that meet where they should not: the exact test of a pair, and the search for all pairs.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {

/// Whether two faces with corner ids `va`, `vb` have a point in common that is on none of their shared
/// nodes and edges. Exact. Faces that lie on one another meet; so do faces whose corners are equal in place
/// but not in id.
///
/// REQUIRES: no face has a repeated node or all corners on one line; the answer is then unspecified.
[[nodiscard]] bool meet_beyond_shared(const std::array<std::uint32_t, 3>& va, const Triangle& a,
                                      const std::array<std::uint32_t, 3>& vb, const Triangle& b);

/// Pairs (smaller, larger) of faces, ascending, that meet beyond shared vertices and edges and of which
/// at least one is marked in `fresh`. Faces without area are left out. Cost O(m + k log k + pairs of
/// overlapping boxes), k fresh faces; parallel, with the same answer for any number of threads.
[[nodiscard]] std::vector<std::array<FaceId, 2>> intersecting_faces(const Complex& complex,
                                                                    std::span<const std::uint8_t> fresh);

/// The same for faces given by corner ids into `position`; `fresh` empty: all faces.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> intersecting_pairs(
    std::span<const Vec3> position, std::span<const std::array<std::uint32_t, 3>> faces,
    std::span<const std::uint8_t> fresh = {});

/// A repeated node, or all three corners on one line. Exact.
[[nodiscard]] bool is_degenerate(const std::array<std::uint32_t, 3>& v, const Triangle& t);

}  // namespace meshgraft
