// Cleaning and remeshing, with a zone that grows where the quality asked for is not reached.
#pragma once

#include <optional>
#include <vector>

#include "core/complex.hpp"
#include "intersect/corefine.hpp"
#include "meshgraft/options.hpp"
#include "patch/paper_method.hpp"
#include "remesh/remesh.hpp"

namespace meshgraft {

struct WidenLimits {
  int max_neighbourhoods = 6;  // from the junction; or, where sizes grade over more than that,
  int beyond = 3;              // beyond the automatic zone
  int max_rounds = 6;
  int max_in_vain = 2;  // of those, one after the other, that make nothing better
  /// An automatic zone grows by `more` neighbourhoods if the mean Q of its faces is below this, where
  /// the edge lengths of the meshes differ by less than `alike`, or grade by more. In one step, because
  /// each step costs a remeshing of the whole zone.
  double mean_alike = 0.9, mean_graded = 0.85;
  double alike = 1.6;
  int more = 2;
  /// Where the meshes are alike and the mean Q of the input faces in the zone is below `regular_input`, it is
  /// `more_at_once` neighbourhoods wider from the start: poor faces at its rim spoil the rows next to them, and with
  /// 3 neighbourhoods no scene of that kind reached `mean_alike`.
  double regular_input = 0.85;
  int more_at_once = 1;
};

struct RemeshedZone {
  Remeshed remeshed;
  std::vector<int> bandwidth;           // by component
  int widened = 0;                      // times the zone was grown
  std::vector<Unfilled> unfilled = {};  // Method::kPaper
};

/// Paper 5.3 to 5.6: curves and sheets are read, sizes set, neighbourhoods chosen and remeshed;
/// beyond the paper, the zone is widened around poor faces that no input angle explains, and the
/// best of the results is taken. Faults: kDegenerateFace if a face of the zone uses a vertex twice; where only a wider
/// one holds such a face, it is not taken.
[[nodiscard]] tl::expected<RemeshedZone, JunctionFault> remesh_zone(const Complex& original, const Corefined& corefined,
                                                                    GroupSets& groups, const MergeOptions& options,
                                                                    const WidenLimits& limits = {});

}  // namespace meshgraft
