// Figures on the quality of the new faces.
#pragma once

#include <span>
#include <vector>

#include "merge/outcome.hpp"
#include "meshgraft/report.hpp"
#include "remesh/remesh.hpp"

namespace meshgraft {

struct QualityVerdict {
  QualitySummary summary;
  std::vector<Error> broken;      // poor faces that no input angle explains
  std::vector<Warning> warnings;  // poor faces that the input's own angles explain
};

/// `bad`: what the remesher says about poor faces.
[[nodiscard]] QualityVerdict quality_of(const Outcome& outcome, std::span<const BadFace> bad, double min_quality);

/// Whether a poor face is the fault of the inputs: no mesh could be better there.
[[nodiscard]] bool is_unavoidable(const BadFace& bad);
/// Whether it is, and is no worse than inputs may excuse: then it breaks no promise.
[[nodiscard]] bool is_excused(const BadFace& bad);

}  // namespace meshgraft
