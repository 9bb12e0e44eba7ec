// Which contours of a model are filled.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "meshgraft/fill.hpp"

namespace meshgraft {

using Openings = std::vector<OpeningContours>;

/// "contour 2", "contours 2 and 5".
[[nodiscard]] std::string numbers_of(const OpeningContours& opening);
[[nodiscard]] Place place_of_contour(const Model& base, const Contour& c);

/// Names elements on the same nodes that hide free edges, as FreeEdges::doubled tells.
[[nodiscard]] std::optional<Warning> doubled_at_rims(const Model& base, const FreeEdges& edges);

/// The openings to fill: those that `options` name, or all holes. Adds warnings for islands, for what stays open and
/// for what is not seen.
/// Errors kUsage if one is named that there is not, or twice, or there is none; kUnsupportedElement.
[[nodiscard]] Result<Openings> chosen(const Model& base, const FreeEdges& edges, const FillOptions& options,
                                      std::vector<Warning>& warnings);

}  // namespace meshgraft
