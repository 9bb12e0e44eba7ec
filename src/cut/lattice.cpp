#include "cut/lattice.hpp"

#include <algorithm>
#include <cmath>

#include "merge/inputs.hpp"

namespace meshgraft {

std::vector<double> ticks(double low, double high, double near_low, double near_high, double step) {
  // The even part starts off the round numbers at which nodes like to stand.
  constexpr double kOff = 0.381966;
  const double from = std::max(low, near_low - kOff * step), to = std::min(high, near_high + step);
  std::vector<double> all{low};
  if (from < to) {
    const double wanted = std::ceil((to - from) / step);
    const auto n = static_cast<std::size_t>(std::clamp(wanted, 1.0, static_cast<double>(kMostSteps)));
    for (std::size_t k = from > low ? 0 : 1; k < n; ++k)
      all.push_back(from + (to - from) * static_cast<double>(k) / static_cast<double>(n));
    if (to < high) all.push_back(to);
  }
  all.push_back(high);
  return all;
}

NodeId LatticeBuilder::node(const Name& name, Vec3 p) {
  const auto [at, fresh] = nodes_.try_emplace(name);
  if (fresh) at->second = builder_.add_node(p);
  return at->second;
}

Model LatticeBuilder::build(const std::string& path) {
  Model model = builder_.build(path);
  std::ranges::fill(model.element_label, kNoLabel);
  return model;
}

}  // namespace meshgraft
