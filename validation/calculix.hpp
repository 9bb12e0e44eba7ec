// CalculiX: decks of quadratic shells, and the results that ccx 2.20 writes for them.
#pragma once

#include <iosfwd>
#include <string>

#include "solve.hpp"
#include "structure.hpp"

namespace meshgraft::validation {

/// A structure with a middle node on each edge. Corner nodes come first and keep their place.
struct QuadraticMesh {
  std::vector<Vec3> position;                       // n corners, then a middle for each edge
  std::vector<std::array<std::uint32_t, 6>> faces;  // corners, then the middles of edges 12, 23, 31
  std::vector<std::array<std::uint32_t, 3>> beams;  // end, middle, end
  std::vector<std::uint32_t> clamped;               // also the middles of edges with both ends held
};

/// Middles lie half way: the faces stay flat.
[[nodiscard]] QuadraticMesh quadratic(const Structure& structure);

/// Two steps: the lowest modes, then statics under the pressure. Shells are S6, beams B32, both joined by the rigid
/// knots of CalculiX. Numbers are positions + 1; beams follow the faces.
void write_deck(std::ostream& out, const Structure& structure, const Study& study);

/// Reads JOB.frd and JOB.dat of a deck that write_deck made of the same structure.
///
/// Error kCannotRead; kMalformed if steps, nodes or elements are missing: ccx stopped early.
[[nodiscard]] Result<Response> read_calculix(const std::string& job, const Structure& structure);

}  // namespace meshgraft::validation
