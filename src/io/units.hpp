// Dataset 164: units.
#pragma once

#include <string>
#include <string_view>

#include "io/unv_document.hpp"
#include "meshgraft/model.hpp"

namespace meshgraft::unv {

/// Reads the records of dataset 164; kBadNumber or kMalformed if they are not those of units.
[[nodiscard]] tl::expected<Units, Fault> read_units(const LineScanner& lines, const Dataset& dataset);

/// The records of dataset 164, without delimiters, lines ending in LF.
[[nodiscard]] std::string units_text(const Units& units);

}  // namespace meshgraft::unv
