// Named merges: the situations a user meets, and what must come out of each.
#pragma once

#include <string>
#include <vector>

#include "meshgraft/model.hpp"
#include "meshgraft/options.hpp"

namespace meshgraft::scenes {

struct Merge {
  std::string name;
  Model base;
  std::vector<Model> parts;
  double min_q = 0.5;        // the least Q that the input angles allow
  double mean_q = 0.9;       // 0.85 where sizes grade
  bool apart = false;        // the part misses the base
  double max_off = 0.1;      // edge lengths by which new faces may be off the surface
  double joined_length = 0;  // of the junction; 0: not said
  MergeOptions options;
};

/// All of them; names are stable and usable as file names.
[[nodiscard]] std::vector<Merge> catalogue();

/// Merges of meshes that lie on each other (face/face mode).
[[nodiscard]] std::vector<Merge> contact_catalogue();

/// Merges over gaps of a share of the edge length or more.
[[nodiscard]] std::vector<Merge> gap_catalogue();

}  // namespace meshgraft::scenes
