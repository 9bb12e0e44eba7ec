#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <set>

#include "calculix.hpp"

namespace meshgraft::validation {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge(std::uint32_t a, std::uint32_t b) { return std::minmax(a, b); }

/// A list of numbers, as many to a line as CalculiX takes.
template <class Numbers>
void write_list(std::ostream& out, const Numbers& numbers) {
  constexpr int kInLine = 16;
  int n = 0;
  for (const std::size_t number : numbers) out << number << (++n % kInLine ? "," : ",\n");
  if (n % kInLine) out << '\n';
}

template <class Nodes>
void write_element(std::ostream& out, std::size_t number, const Nodes& nodes) {
  out << number;
  for (const std::uint32_t n : nodes) out << ',' << n + 1;
  out << '\n';
}

}  // namespace

QuadraticMesh quadratic(const Structure& structure) {
  QuadraticMesh mesh;
  mesh.position = structure.position;
  std::map<Edge, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, is_new] = middles.try_emplace(edge(a, b), static_cast<std::uint32_t>(mesh.position.size()));
    if (is_new) mesh.position.push_back(midpoint(structure.position[a], structure.position[b]));
    return at->second;
  };
  for (const auto& [a, b, c] : structure.faces)
    mesh.faces.push_back({a, b, c, middle(a, b), middle(b, c), middle(c, a)});
  for (const auto& [a, b] : structure.beams) mesh.beams.push_back({a, middle(a, b), b});

  const std::set<std::uint32_t> held(structure.clamped.begin(), structure.clamped.end());
  mesh.clamped = structure.clamped;
  for (const auto& [ends, node] : middles)
    if (held.contains(ends.first) && held.contains(ends.second)) mesh.clamped.push_back(node);
  return mesh;
}

void write_deck(std::ostream& out, const Structure& structure, const Study& study) {
  const QuadraticMesh mesh = quadratic(structure);
  out << "*NODE, NSET=ALL_NODES\n";
  for (std::size_t n = 0; n < mesh.position.size(); ++n) {
    const Vec3 p = mesh.position[n];
    out << fmt::format("{},{:.12g},{:.12g},{:.12g}\n", n + 1, p.x, p.y, p.z);
  }
  out << "*ELEMENT, TYPE=S6, ELSET=SHELLS\n";
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) write_element(out, f + 1, mesh.faces[f]);
  if (!mesh.beams.empty()) out << "*ELEMENT, TYPE=B32, ELSET=BEAMS\n";
  for (std::size_t b = 0; b < mesh.beams.size(); ++b) write_element(out, mesh.faces.size() + b + 1, mesh.beams[b]);

  out << fmt::format("*MATERIAL, NAME=STEEL\n*ELASTIC\n{},{}\n*DENSITY\n{}\n", study.young, study.poisson,
                     study.density);
  std::map<double, std::vector<std::size_t>> by_thickness;
  std::vector<std::size_t> pressed;
  for (std::size_t f = 0; f < structure.faces.size(); ++f) {
    by_thickness[structure.thickness[f]].push_back(f + 1);
    if (structure.pressed[f]) pressed.push_back(f + 1);
  }
  std::size_t section = 0;
  for (const auto& [thickness, faces] : by_thickness) {
    out << "*ELSET, ELSET=SECTION_" << ++section << '\n';
    write_list(out, faces);
    out << fmt::format("*SHELL SECTION, ELSET=SECTION_{}, MATERIAL=STEEL\n{}\n", section, thickness);
  }
  if (!mesh.beams.empty())
    out << fmt::format("*BEAM SECTION, ELSET=BEAMS, MATERIAL=STEEL, SECTION=RECT\n{0},{0}\n{1},{2},{3}\n",
                       study.beam_width, study.beam_normal.x, study.beam_normal.y, study.beam_normal.z);
  out << "*NSET, NSET=CLAMPED\n";
  std::vector<std::size_t> clamped;
  for (const std::uint32_t n : mesh.clamped) clamped.push_back(n + 1);
  write_list(out, clamped);
  out << "*BOUNDARY\nCLAMPED,1,6\n*ELSET, ELSET=PRESSED\n";
  write_list(out, pressed);

  // Modes first: what a step prints, the next prints again.
  out << fmt::format("*STEP\n*FREQUENCY\n{}\n*NODE FILE, OUTPUT=2D\nU\n*END STEP\n", study.n_modes + study.spare_modes);
  out << fmt::format("*STEP\n*STATIC\n*DLOAD\nPRESSED,P,{}\n", study.pressure);
  out << "*EL PRINT, ELSET=SHELLS\nS\n*END STEP\n";
}

}  // namespace meshgraft::validation
