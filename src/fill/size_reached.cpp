#include "fill/size_reached.hpp"

#include <algorithm>
#include <limits>

#include "core/text.hpp"
#include "zone/edge_table.hpp"

namespace meshgraft {
namespace {

constexpr double kNoticed = 1.5;  // of an edge length to that asked for

}  // namespace

std::optional<Warning> size_not_reached(const Complex& complex, std::size_t first, double size, Place place) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  const EdgeTable edges(complex);
  for (EdgeId e(0u); e.value < edges.size(); ++e.value) {
    if (std::ranges::any_of(edges.uses(e), [&](const EdgeUse& use) { return use.face.value < first; })) continue;
    const auto [a, b] = edges.ends(e);
    const double length = distance(complex.position[a.value], complex.position[b.value]);
    least = std::min(least, length), most = std::max(most, length);
  }
  const bool too_long = least > kNoticed * size, too_short = most * kNoticed < size;
  if (!too_long && !too_short) return std::nullopt;
  return Warning{"size-not-reached",
                 "the edges inside the filling are " + text_of(too_long ? least : most) +
                     (too_long ? " or more" : " or less") + " long, while " + text_of(size) +
                     " is asked for: they change gradually from the sides of the rim, which stay",
                 std::move(place)};
}

}  // namespace meshgraft
