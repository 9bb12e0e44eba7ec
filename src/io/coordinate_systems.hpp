// Datasets 2420 and 18: coordinate systems. Coordinates are never transformed; the systems are read
// to warn about those that are not the global one.
#pragma once

#include <cstdint>
#include <vector>

#include "io/unv_document.hpp"

namespace meshgraft::unv {

struct CoordinateSystem {
  std::int64_t label = 0;
  bool global = false;  // Cartesian, no rotation, no translation
};

/// The systems of a dataset; empty if the dataset cannot be understood.
[[nodiscard]] std::vector<CoordinateSystem> coordinate_systems(const LineScanner& lines, const Dataset& dataset);

}  // namespace meshgraft::unv
