// Plates that lie on a plate anyhow, for laws of contact.
#pragma once

#include "support/random_scenes.hpp"

namespace meshgraft::scenes {

/// A flat plate of edges of 1 in the plane z = 0, and one or two that lie on it or on each other: at random or with
/// nodes and edges in common on purpose, within its border or over it, of edges 1/8 to 8 times as long, in its plane or
/// at a distance that the tolerance closes, some with a leg that stands on one side.
struct RandomPlates {
  Merge merge;
  double outline = 0;  // length of the outlines of all parts
  double reach = 0;    // distance that is closed: of borders along the plates, of plates to each other
  double layers = 0;   // area of all
  double layer = 0;    // the same, where they lie over each other counted once
};
[[nodiscard]] RandomPlates random_plates(const Draw& draw);

/// A rigid motion, the same for all models of a scene: about any axis, by up to `far`, and then each coordinate of each
/// node off by up to the noise.
[[nodiscard]] std::function<Vec3(Vec3)> any_motion(const Draw& draw, double far, double noise);

}  // namespace meshgraft::scenes
