// Remeshing of the zone as the paper does it (5.3, 5.5, 5.6; method "paper").
#pragma once

#include <string>
#include <vector>

#include "meshgraft/options.hpp"
#include "remesh/remesh.hpp"

namespace meshgraft {

/// An area between curves that could not be filled and stays as it was cut.
struct Unfilled {
  Vec3 at;  // the centroid of its largest face
  std::string why;
};

struct RemeshedByPaper {
  Remeshed remeshed;
  std::vector<Unfilled> unfilled;
};

/// Deletes the faces of each sheet in the zone, fills what is left open between its curves by fill_opening, inserts
/// nodes and swaps edges by refine, and deforms curved areas to meet their surroundings with the continuity `blend`.
///
/// Parameters and laws (1), (2), (4), (5), (7) are those of remesh(). New vertices inside a sheet lie where the
/// deformation puts them, not on the surface that was there; Remeshed::max_deviation tells how far off. An area that
/// cannot be filled stays as it was cut, and is named.
[[nodiscard]] RemeshedByPaper remesh_by_paper(const Complex& complex, const Brep& brep, const SizeField& size,
                                              const std::vector<std::uint8_t>& in_zone, GroupSets& groups, Blend blend,
                                              const RemeshOptions& options = {});

}  // namespace meshgraft
