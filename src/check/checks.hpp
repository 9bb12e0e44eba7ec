// The parts of check(), each filling its fields of the result.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "meshgraft/check.hpp"

namespace meshgraft {

/// The faces of a model that have all their nodes, as arrays.
struct Faces {
  std::vector<ElementId> element;                    // m, ascending
  std::vector<std::array<std::uint32_t, 3>> corner;  // m, node positions
};

void check_edges(const Model& model, const Faces& faces, const CheckOptions& options, CheckResult& result);
void check_quality(const Model& model, const Faces& faces, const CheckOptions& options, CheckResult& result);
void check_duplicates(const Faces& faces, const CheckOptions& options, CheckResult& result);
void check_lines(const Model& model, const CheckOptions& options, CheckResult& result);
/// Nodes at one place count as one, or every face beside a doubled node would be an intersection.
void check_places(const Model& model, const Faces& faces, const CheckOptions& options, CheckResult& result);
void check_orphans(const Model& model, const CheckOptions& options, CheckResult& result);
void check_groups(const Model& model, CheckResult& result);

}  // namespace meshgraft
