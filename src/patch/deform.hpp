// Shape of a filled area that continues its surroundings (paper 5.6).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "meshgraft/options.hpp"
#include "meshgraft/vec3.hpp"

namespace meshgraft {

/// A smooth piece of mesh, some of whose nodes may move.
struct DeformProblem {
  std::vector<Vec3> position;                       // n
  std::vector<std::array<std::uint32_t, 3>> faces;  // of the area and of at least three rings around it
  std::vector<std::uint8_t> is_free;                // n
};

struct DeformOptions {
  int most_rounds = 12;         // each linear solve starts from the shape of the last one
  double settled = 1e-4;        // share of the mean edge length: moves across the surface below it end the rounds
  double least_quality = 0.05;  // Q that no face may fall below, unless it was there before
};

struct Deformed {
  std::vector<Vec3> position;  // n
  double moved = 0;            // the farthest across the surface, in mean edge lengths
  double left = 0;             // the same that a node still had to go, but would have spoilt its faces,
  Vec3 left_at;                // and where that is
};

/// The positions of all nodes with the free ones moved to where, with x the position as a function on the surface,
///
///   position    laplace x = 0              the membrane; its edge meets the surroundings
///   tangency    laplace^2 x = 0            with the tangent planes of the surroundings, too
///   curvature   laplace^3 x = 0            and with their curvatures
///
/// holds at each free node. After Pernot et al. 2006 in aim, a linear system over the new nodes with the surroundings
/// as data, not in the mechanical model.
///
/// The inner operator is the Laplacian of the cubic that fits two rings of nodes best, the outer ones have
/// cotangent weights: surfaces of third degree over any of their tangent planes are reproduced. Where a smooth surface
/// is cut out over a fixed number of edges of length h, the distance from it falls like h^2, h^3 or faster, h^4 or
/// faster, the deviation of the normals with one order less.
///
/// Next to an open border of the piece, which has no surroundings to continue, tangency stands for curvature.
///
/// Nodes may creep along the surface from round to round, which does not change it; the rounds end when moves across it
/// are small, or do not fall any more.
///
/// Cost: some sparse Cholesky factors of a symmetric operator, and a dozen products with them per round (PowerSolver).
/// Nodes of faces that would fold back on a neighbour or become flat go part of their way only. If a system is
/// singular, what has been reached by then is returned; Deformed::left is infinite if nothing was.
[[nodiscard]] Deformed deformed(const DeformProblem& problem, Blend blend, const DeformOptions& options = {});

}  // namespace meshgraft
