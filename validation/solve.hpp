// Statics and natural modes of a structure by the project's own shell triangle.
#pragma once

#include <vector>

#include "structure.hpp"

namespace meshgraft::validation {

/// Of n nodes and m faces, whoever computed it. Units: mm, N/mm2, Hz.
struct Response {
  std::vector<Vec3> displacement;        // n, under the pressure
  std::vector<double> von_mises;         // m, the larger of both surfaces above the centroid
  std::vector<double> frequency;         // ascending
  std::vector<std::vector<Vec3>> shape;  // by mode, n displacements each, of any scale
};

/// Error kMalformed if the stiffness is not positive definite: something is not held.
[[nodiscard]] Result<Response> solve(const Structure& structure, const Study& study);

}  // namespace meshgraft::validation
