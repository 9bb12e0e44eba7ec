// Two meshes that meet anyhow, for laws: what nobody would think of drawing by hand.
#pragma once

#include <cstdint>
#include <functional>

#include "support/catalogue.hpp"

namespace meshgraft::scenes {

/// Uniform between two bounds.
using Draw = std::function<double(double low, double high)>;

/// The same numbers on every machine.
[[nodiscard]] Draw draw_from(std::uint32_t seed);

/// A plate, tube, cone, sphere or saddle, and another that meets it: anywhere, or on purpose so that the two nearly
/// touch along a curve. Edge lengths of the two differ by up to a factor of 3, meshes are regular or not.
/// Name: the two shapes. mean_q is 0.85 if the sizes grade.
[[nodiscard]] Merge random_shapes(const Draw& draw);

}  // namespace meshgraft::scenes
