#include "search/region.hpp"

#include <algorithm>
#include <cmath>

namespace meshgraft {
namespace {

constexpr int kKeyBits = 21;  // per axis: three fit into 64 bits
constexpr int kCellsPerReach = 4;
constexpr double kMargin = 1.5;  // of the reach: cells may be sqrt 2 larger than asked for

}  // namespace

Region::Region(std::span<const Reach> reaches) {
  for (const Reach& r : reaches) bounds_.add(r.box.grown(kMargin * r.distance));
  const Vec3 extent = bounds_.high - bounds_.low;
  const double least_size =
      std::max({extent.x, extent.y, extent.z}) / double(1 << (kKeyBits - 1));  // bounds_ may double below
  for (const Reach& r : reaches) {
    Grid& grid = grid_for(r.distance / kCellsPerReach, least_size);
    const Cell low = cell_of(r.box.low, grid.size), high = cell_of(r.box.high, grid.size);
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z)
          if (const Cell c{x, y, z}; grid.keys.insert(key(c)).second) grid.cells.push_back(c);
  }
  const Vec3 origin = bounds_.low;
  for (Grid& grid : grids_) {
    for (std::size_t axis = 0; axis < 3; ++axis) grid.cells = spread(std::move(grid.cells), axis);
    for (const Cell& c : grid.cells) {
      grid.keys.insert(key(c));
      bounds_.add(origin + grid.size * Vec3{double(c[0] + 1), double(c[1] + 1), double(c[2] + 1)});
    }
  }
}

std::vector<Region::Cell> Region::spread(std::vector<Cell> cells, std::size_t axis) {
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  std::ranges::sort(cells, {}, [&](const Cell& c) { return Cell{c[i], c[j], c[axis]}; });
  std::vector<Cell> result;
  for (const Cell& c : cells) {
    std::int64_t first = std::max<std::int64_t>(c[axis] - kCellsPerReach, 0);
    if (!result.empty() && result.back()[i] == c[i] && result.back()[j] == c[j])
      first = std::max(first, result.back()[axis] + 1);
    for (Cell next = c; first <= c[axis] + kCellsPerReach; ++first) {
      next[axis] = first;
      result.push_back(next);
    }
  }
  return result;
}

Region::Grid& Region::grid_for(double least_cell, double least_size) {
  const double size = std::exp2(0.5 * std::ceil(2 * std::log2(std::max(least_cell, least_size))));
  auto at = grids_.begin();
  while (at != grids_.end() && at->size < size) ++at;
  if (at == grids_.end() || at->size != size) {
    at = grids_.insert(at, Grid{});
    at->size = size;
  }
  return *at;
}

Region::Cell Region::cell_of(Vec3 p, double size) const {
  const Vec3 q = (p - bounds_.low) / size;  // >= 0 inside the bounds
  return {std::int64_t(q.x), std::int64_t(q.y), std::int64_t(q.z)};
}

std::uint64_t Region::key(const Cell& c) {
  return std::uint64_t(c[0]) << (2 * kKeyBits) | std::uint64_t(c[1]) << kKeyBits | std::uint64_t(c[2]);
}

bool Region::contains(Vec3 p) const {
  if (!bounds_.contains(p)) return false;
  for (const Grid& grid : grids_)
    if (grid.keys.contains(key(cell_of(p, grid.size)))) return true;
  return false;
}

bool Region::meets(const Box& box) const {
  if (!bounds_.overlaps(box)) return false;
  for (const Grid& grid : grids_)
    if (meets(box, grid)) return true;
  return false;
}

bool Region::meets(const Box& box, const Grid& grid) const {
  Box inside = box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    inside.low[axis] = std::max(box.low[axis], bounds_.low[axis]);
    inside.high[axis] = std::min(box.high[axis], bounds_.high[axis]);
  }
  const Cell low = cell_of(inside.low, grid.size), high = cell_of(inside.high, grid.size);
  const auto in_range = [&](const Cell& c) {
    return low[0] <= c[0] && c[0] <= high[0] && low[1] <= c[1] && c[1] <= high[1] && low[2] <= c[2] && c[2] <= high[2];
  };
  // A box that covers more cells than there are marked ones is compared with those instead.
  const double covered = double(high[0] - low[0] + 1) * double(high[1] - low[1] + 1) * double(high[2] - low[2] + 1);
  if (covered > double(grid.cells.size())) return std::any_of(grid.cells.begin(), grid.cells.end(), in_range);
  for (std::int64_t x = low[0]; x <= high[0]; ++x)
    for (std::int64_t y = low[1]; y <= high[1]; ++y)
      for (std::int64_t z = low[2]; z <= high[2]; ++z)
        if (grid.keys.contains(key({x, y, z}))) return true;
  return false;
}

}  // namespace meshgraft
