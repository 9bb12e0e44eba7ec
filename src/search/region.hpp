// A generous region around boxes, with a membership test of constant cost.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

#include "meshgraft/vec3.hpp"

namespace meshgraft {

/// A box and how far around it the region goes.
struct Reach {
  Box box;
  double distance = 0;  // > 0
};

/// Grid cells that hold every point within reach of a box, and points up to 0.8 times as far again.
/// Each reach goes into a grid with cells of about a quarter of its size (2^(k/2) for some k), so that
/// large and small faces side by side mark a few cells each. The cells at the boxes are marked first and
/// then spread axis by axis: many boxes next to each other cost no more than the cells they share.
class Region {
 public:
  explicit Region(std::span<const Reach> reaches);

  [[nodiscard]] bool contains(Vec3 p) const;
  /// True if the box meets a marked cell.
  [[nodiscard]] bool meets(const Box& box) const;

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Grid {
    double size = 0;                         // of a cell
    std::unordered_set<std::uint64_t> keys;  // asked for membership only, never iterated
    std::vector<Cell> cells;                 // the same
  };

  [[nodiscard]] Cell cell_of(Vec3 p, double size) const;
  [[nodiscard]] static std::uint64_t key(const Cell& c);
  [[nodiscard]] bool meets(const Box& box, const Grid& grid) const;
  /// The cells up to one reach before and after the given ones along an axis, each once.
  [[nodiscard]] static std::vector<Cell> spread(std::vector<Cell> cells, std::size_t axis);
  Grid& grid_for(double least_cell, double least_size);

  Box bounds_;               // of all marked cells
  std::vector<Grid> grids_;  // ascending by size
};

}  // namespace meshgraft
