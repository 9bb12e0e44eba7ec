#include "plate_stacks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "geometry/quality.hpp"

namespace meshgraft::checks {
namespace {

double area_of(const Model& m) {
  double sum = 0;
  for (std::size_t e = 0; e < m.n_elements(); ++e) sum += area(m.corners(ElementId(e)));
  return sum;
}

/// What a border may be off by: it is snapped to each of the others, by the tolerance of the coarser at most.
double snapped(std::span<const PlatePair> stack) {
  constexpr double kLonger = 1.5;  // edges than asked for
  double most = 0;
  for (const PlatePair& pair : stack) most = std::max(most, kLonger * tolerance(pair) + pair.noise);
  return most * static_cast<double>(stack.size());
}

}  // namespace

std::vector<Model> models(std::span<const PlatePair> stack) {
  std::vector<Model> all;
  for (const PlatePair& pair : stack) {
    std::vector<Model> both = models(pair);
    if (all.empty()) all.push_back(std::move(both[0]));
    all.push_back(std::move(both[1]));
  }
  return all;
}

std::vector<std::string> faults(std::span<const PlatePair> stack, const std::vector<Model>& models,
                                const Corefined& after, const GroupSets& sets) {
  std::vector<std::string> faults;
  const auto fault = [&](auto&&... words) {
    std::ostringstream text;
    (text << ... << words);
    faults.push_back(text.str());
  };
  const Complex& complex = after.complex;
  const double snap = snapped(stack);
  std::vector<double> of_group(models.size());
  std::map<std::array<VertexId, 2>, int> uses;
  for (std::size_t f = 0; f < complex.n_faces(); ++f) {
    const Triangle t = complex.corners(FaceId(f));
    if (dot(area_vector(t), area_vector(models[complex.parent[f].input].corners(complex.parent[f].element))) <= 0)
      fault("face ", f, " is turned over");
    std::vector<double> inside{depths(stack[0], centroid(t))[0]};
    for (const PlatePair& pair : stack) inside.push_back(depths(pair, centroid(t))[1]);
    const std::vector<std::uint32_t> stands_for = complex.components_of(FaceId(f));
    for (std::uint32_t k = 0; k < models.size(); ++k) {
      const auto n = std::ranges::count(stands_for, k);
      if (n > 1) fault("face ", f, " stands for ", k, " twice");
      if (n > 0 && inside[k] < -snap) fault("face ", f, " stands for ", k, " in vain");
      if (n == 0 && inside[k] > snap) fault("face ", f, " does not stand for ", k);
      const bool in_group = sets.contains(complex.face_groups[f], GroupId(100 * k));
      if (in_group != (n > 0)) fault("face ", f, in_group ? " is in" : " is not in", " the group of ", k);
      if (in_group) of_group[k] += area(t);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(complex.face[f][k], complex.face[f][(k + 1) % 3]);
      if (++uses[{low, high}] == 3) fault("edge ", low.value, "-", high.value, " has a third face");
    }
  }
  for (std::size_t k = 0; k < models.size(); ++k) {
    const double was = area_of(models[k]);
    const double slack = k == 0 ? 1e-6 * was : snap * 2 * (stack[k - 1].length + stack[k - 1].width);
    if (std::abs(of_group[k] - was) > slack) fault("group ", k, " has area ", of_group[k], " instead of ", was);
  }
  return faults;
}

}  // namespace meshgraft::checks
