// What would lay two sides on each other that cross, as coarse pictures of one surface do.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "intersect/contact.hpp"

namespace meshgraft {

struct LayingAdvice {
  double tolerance = 0, contact_angle = 0;  // length; radians
  std::string text;
};

/// Advice: the options with which sides lie on each other where they have an area in common, one face over the other
/// within a quarter of the edge length and 60 degrees. Nothing if none have.
///   all   pairs of sides, ascending; the options serve all
[[nodiscard]] std::optional<LayingAdvice> laying_advice(const Complex& complex,
                                                        std::span<const std::array<std::vector<FaceId>, 2>> all,
                                                        std::span<const double> size, const SnapRule& snap,
                                                        const CorefineOptions& options);

}  // namespace meshgraft
