// How much of each mesh is remeshed (paper 5.4).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "intersect/corefine.hpp"
#include "zone/input_faces.hpp"
#include "zone/size_field.hpp"

namespace meshgraft {

/// Number of components; those of which no face is left, because all of theirs lay on others, count too.
[[nodiscard]] std::size_t n_components(const Corefined& corefined);

struct Zone {
  std::vector<std::uint8_t> in_zone;  // by face of the corefined complex
  std::vector<int> bandwidth;         // by component: neighbourhoods taken (0: not touched)
};

/// The faces to remesh: neighbourhoods 1..N of the touched faces, where the first neighbourhood is
/// the touched faces and the next one all faces of the same mesh with a node of the previous (across
/// T-lines too). N is `bandwidth`, or automatic, mesh by mesh:
///
///   N = round(max(l1a, l2a) / min(l1a, l2a)) on the finer mesh, 1 on the coarser (paper 5.4);
///   at least 3: departs from the second rounding rule of 5.4, which gives 1 or 2 where the meshes are alike
///   and leaves no row of nodes that is free on both sides;
///   and around each touched face so many that the change of size from l_a to its own, by `gradation`
///   per length, fits in, plus one (beyond the paper);
///   and `more` of them, but nothing farther than 5.5 edge lengths from the junction (N, if that is more; the faces'
///   own lengths, or those of the junction if they are longer).
///   Touched faces that were not cut count only if they are of the wrong size, or spoiled by nodes that were moved:
///   where meshes share their nodes already nothing needs to change (departs from 5.4, which starts from all that
///   meet).
///
/// Neighbourhoods are of input faces: a face is taken with all pieces that corefinement made of it,
/// and never if one of them has a kFrozen vertex or lies on the vertices of another face.
///
/// `inputs`: of the corefined complex.
[[nodiscard]] Zone neighbourhoods(const Corefined& corefined, const InputFaces& inputs, const SizeField& size,
                                  std::optional<int> bandwidth, int more = 0);

/// Grows the zone by one neighbourhood around each of `places`, where the zone ends nearest to it, at most
/// to `limit` neighbourhoods, and half an edge length less than as many, from the junction. Returns whether anything
/// was added.
bool widen(Zone& zone, const Corefined& corefined, const InputFaces& inputs, const SizeField& size,
           std::span<const Vec3> places, int limit);

}  // namespace meshgraft
