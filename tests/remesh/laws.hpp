// What must hold of every remeshed zone.
#pragma once

#include <string>
#include <vector>

#include "cut.hpp"
#include "remesh/remesh.hpp"

namespace meshgraft::cut {

/// A scene, its zone, and what remeshing made of it.
struct Trial {
  Scene scene;
  Brep brep;
  std::vector<std::uint8_t> in_zone;
  Remeshed result;
};

/// Remeshes `rings` neighbourhoods around the cut with the size field of the product.
Trial trial(Scene scene, int rings);

/// The broken laws, in words; empty if all hold:
/// - a face outside the zone is there with the same vertices (by place and node), parent and groups;
/// - a vertex with a node stands where the node stood;
/// - no two faces have the same corners; edges off the curves have one or two faces;
/// - every edge of the result with other than two faces, or between parents of different sheets,
///   lies on a curve, and has as many faces as the curve had there;
/// - each part of the sheets keeps its area, up to `area_share`, and faces like its parent.
std::vector<std::string> broken_laws(const Trial& trial, double area_share = 1e-9);

/// Q of the faces in the zone that are not as in the input, ascending.
std::vector<double> new_qualities(const Trial& trial);
double mean(const std::vector<double>& values);

}  // namespace meshgraft::cut
