// A mesh of the study with all that an analysis needs, taken from its groups.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "geometry/quality.hpp"
#include "meshgraft/model.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft::validation {

/// What the groups of a model mean. Units: mm, N, s, t.
struct Study {
  double young = 0;                         // N/mm2
  double poisson = 0;                       // 1
  double density = 0;                       // t/mm3
  std::map<std::string, double> thickness;  // by group of faces; a face has the sum over its groups
  std::string beams;                        // group of lines with a square section
  double beam_width = 0;
  Vec3 beam_normal;   // direction across all beams
  std::string clamp;  // group of nodes held in all six freedoms
  std::string pressed;
  double pressure = 0;                // N/mm2 along the normal of the faces in `pressed`
  std::vector<std::string> reported;  // groups of faces whose stresses are compared
  std::size_t n_modes = 0;            // compared
  std::size_t spare_modes = 0;        // computed beyond, in case the order differs
};

/// Error kCannotRead or kMalformed.
[[nodiscard]] Result<Study> read_study(const std::string& path);

/// n nodes, m faces. Nodes of the model without a face are left out.
struct Structure {
  std::vector<Vec3> position;                       // n
  std::vector<std::array<std::uint32_t, 3>> faces;  // m, counter-clockwise around the normal
  std::vector<double> thickness;                    // m
  std::vector<bool> pressed;                        // m
  std::vector<std::array<std::uint32_t, 2>> beams;
  std::vector<std::uint32_t> clamped;                      // nodes
  std::vector<std::vector<std::uint32_t>> reported_faces;  // by Study::reported

  [[nodiscard]] Triangle corners(std::size_t face) const {
    const auto& v = faces[face];
    return {position[v[0]], position[v[1]], position[v[2]]};
  }
};

/// Error kMalformed: a group of the study without members, a face without thickness, a beam or a held node without a
/// face, an element that is neither triangle nor line.
[[nodiscard]] Result<Structure> structure_of(const Model& model, const Study& study);

}  // namespace meshgraft::validation
