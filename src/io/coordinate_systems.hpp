// Datasets 2420 and 18: coordinate systems.
#pragma once

#include <optional>
#include <vector>

#include "io/unv_document.hpp"
#include "meshgraft/model.hpp"

namespace meshgraft::unv {

[[nodiscard]] constexpr bool holds_systems(const Dataset& dataset) {
  return !dataset.binary && (dataset.number == 2420 || dataset.number == 18);
}

/// The systems of a dataset, in its order; nothing if the dataset cannot be understood.
[[nodiscard]] std::optional<std::vector<CoordinateSystem>> coordinate_systems(const LineScanner& lines,
                                                                              const Dataset& dataset);

}  // namespace meshgraft::unv
