#include "geometry/coincident_nodes.hpp"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace meshgraft {
namespace {

constexpr double kCell = 1000;  // cell size in tolerances: few nodes lie near a wall, few share a cell

struct Entry {
  std::array<std::int64_t, 3> cell{};
  std::uint32_t node = 0;
  friend auto operator<=>(const Entry&, const Entry&) = default;
};

/// One entry for every cell that comes within the tolerance of the node.
std::vector<Entry> entries(std::span<const Vec3> position, double tolerance) {
  Box box;
  for (const Vec3 p : position) box.add(p);
  const double size = kCell * tolerance;
  // Meshes like round coordinates; walls should not.
  constexpr double kOdd = 0.381966;
  const Vec3 origin = box.low - Vec3{kOdd * size, kOdd * size, kOdd * size};
  std::vector<Entry> result;
  result.reserve(position.size());
  for (std::uint32_t n = 0; n < position.size(); ++n) {
    const Vec3 p = position[n] - origin;
    std::array<std::array<std::int64_t, 2>, 3> span;
    for (std::size_t k = 0; k < 3; ++k)
      span[k] = {static_cast<std::int64_t>(std::floor((p[k] - tolerance) / size)),
                 static_cast<std::int64_t>(std::floor((p[k] + tolerance) / size))};
    for (std::int64_t x = span[0][0]; x <= span[0][1]; ++x)
      for (std::int64_t y = span[1][0]; y <= span[1][1]; ++y)
        for (std::int64_t z = span[2][0]; z <= span[2][1]; ++z) result.push_back({{x, y, z}, n});
  }
  return result;
}

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> coincident_nodes(std::span<const Vec3> position,
                                                                      double tolerance) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> result;
  if (!(tolerance > 0)) return result;
  std::vector<Entry> all = entries(position, tolerance);
  tbb::parallel_sort(all);
  std::vector<std::uint32_t> alone;  // of the current cell: nodes that coincide with no earlier one
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i == 0 || all[i].cell != all[i - 1].cell) alone.clear();
    const Vec3 p = position[all[i].node];
    const auto near = std::ranges::find_if(
        alone, [&](std::uint32_t n) { return squared_norm(p - position[n]) <= tolerance * tolerance; });
    if (near != alone.end())
      result.emplace_back(*near, all[i].node);
    else
      alone.push_back(all[i].node);
  }
  std::ranges::sort(result, {}, [](const auto& pair) { return std::tuple(pair.second, pair.first); });
  const auto repeated = std::ranges::unique(result, {}, [](const auto& pair) { return pair.second; });
  result.erase(repeated.begin(), repeated.end());
  return result;
}

}  // namespace meshgraft
