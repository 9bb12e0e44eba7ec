// What the merge of plates that lie on each other must give wherever they are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace meshgraft::scenes {

/// What is wrong with the merge of the random plates of a seed, in words: they are merged as they are drawn, and after
/// a rigid motion, for some seeds far from the origin, for some with noise of 1e-9 edge lengths on every coordinate.
///
///  (1) Both merge, with the same promises kept, or both are refused for the same reason.
///  (2) Both results are conforming by check(), and their area is that of all plates where they lie over each other
///      counted once (with Overlap::kProject: that of all), up to what the gaps that are closed may sweep.
///  (3) The lines in which the meshes meet are the same: their kind, whether they are closed, their corners, the inputs
///      that meet there.
///  (4) Each group keeps its Euler characteristic and its area, the latter up to a tenth of what may be swept: where
///  two
///      things are equally near, rounding tells to which of them a node goes, and a slope down to the other mesh that
///      is narrower than an edge is followed by the new faces or cut off, whichever gives the better ones.
///
/// Rounding decides in the remesher, too, between steps that are equally good: numbers of nodes and faces may differ,
/// and so may the worst Q, even whether it is enough.
[[nodiscard]] std::vector<std::string> faults_of_moved_plates(std::uint32_t seed);

}  // namespace meshgraft::scenes
