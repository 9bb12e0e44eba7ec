// Complexes made of whole models, and independent checks of what corefine makes of them.
#pragma once

#include <string>
#include <vector>

#include "intersect/corefine.hpp"
#include "meshgraft/model.hpp"

namespace meshgraft::checks {

/// All faces and lines of the models, one component each; every vertex open. Groups are named over
/// all inputs: group g of model k is 100 k + g.
[[nodiscard]] Complex complex_of(const std::vector<Model>& models, GroupSets& sets);

/// Everything that is wrong with the result, one line each; empty if it is sound.
///
///   conforming   no edge of a component passes through a face of another (exact); no vertex and no
///                edge is nearer to a face or edge of another than half the weld length, unless they
///                share vertices; faces on one edge do not lie on each other
///   faithful     every face turns the way of its parent; the pieces of each face of the first
///                component have its area and lie in it up to rounding
///   complete     edges that have one, two, three ... faces of a component have, taken together, the
///                length that they had (within `slack`)
///   joined       junction edges are the edges of several components; a junction curve ends only on
///                a free edge of a component (not asked if `may_end`)
///   bounded      no vertex of the first component moved, others at most by twice the tolerance
struct Check {
  double slack = 1e-9;   // relative, of lengths and areas of later components
  bool may_end = false;  // the parts may leave each other beyond the tolerance
};
[[nodiscard]] std::vector<std::string> faults(const Complex& before, const Corefined& after,
                                              const CorefineOptions& options, const Check& check = {});

[[nodiscard]] double junction_length(const Corefined& c);

/// Greatest distance of a junction vertex of `a` from the junction of `b`.
[[nodiscard]] double junction_distance(const Corefined& a, const Corefined& b);

}  // namespace meshgraft::checks
