// How much of each mesh is remeshed (paper 5.4).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "intersect/corefine.hpp"
#include "zone/brep.hpp"
#include "zone/size_field.hpp"

namespace meshgraft {

struct Zone {
  std::vector<std::uint8_t> in_zone;  // by face of the corefined complex
  std::vector<int> bandwidth;         // by component: neighbourhoods taken (0: not touched)
};

/// The faces to remesh: neighbourhoods 1..N of the touched faces, where the first neighbourhood is
/// the touched faces and the next one all faces with a node of the previous. N is `bandwidth`, or
/// the automatic rule of 5.4, enlarged so that the change of size fits in (beyond the paper).
/// No face with a kFrozen vertex is ever in the zone.
[[nodiscard]] Zone neighbourhoods(const Corefined& corefined, const Brep& brep, const SizeField& size,
                                  std::optional<int> bandwidth);

/// Grows the zone by one neighbourhood around each of `places`, at most to `limit` neighbourhoods from the
/// junction. Returns whether anything was added.
bool widen(Zone& zone, const Corefined& corefined, std::span<const Vec3> places, int limit);

}  // namespace meshgraft
