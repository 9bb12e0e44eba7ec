// Surfaces that are known by formula, with a hole that is filled: how far off the filling is.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "meshgraft/fill.hpp"

namespace meshgraft::scenes {

struct KnownSurface {
  std::string name;
  std::function<Model(double size)> model;  // irregular mesh with edges of about `size`
  Vec3 centre;                              // of the hole
  std::function<Vec3(Vec3)> nearest;        // point of the surface
};

/// Sphere cap, cylinder and torus with a radius of 1, and a saddle.
[[nodiscard]] std::vector<KnownSurface> known_surfaces();

inline constexpr std::array kRefillSizes{0.12, 0.06, 0.03};  // edge lengths, each half the one before

struct Refill {
  Model holed;
  Merged merged;
  double distance = 0;  // the largest, of new nodes from the surface
  double normal = 0;    // the largest, radians, of new faces from the same faces with their nodes on the surface
};

/// The surface without the faces within some edges of the centre, filled again.
[[nodiscard]] Result<Refill> refilled(const KnownSurface& surface, double size, Blend blend, double edges = 3);

/// The power of the edge length with which an error falls from the first to the last of kRefillSizes.
[[nodiscard]] double order_of(std::span<const Refill> refills, double Refill::*error);

}  // namespace meshgraft::scenes
