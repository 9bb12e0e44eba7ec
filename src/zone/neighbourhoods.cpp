#include "zone/neighbourhoods.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/blocks.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"

namespace meshgraft {
namespace {

constexpr int kLeastAutomatic = 3;  // room for two rows of new nodes on each side of the line
constexpr double kReach = 5.5;      // edge lengths from the junction beyond which only the user widens a zone
constexpr double kRow = 0.866;      // width of a neighbourhood over the edge length: height of an equilateral triangle
constexpr int kSettled = 2;         // neighbourhoods for the change of size where there is next to none
constexpr std::size_t kInputBlock = 256;  // input faces looked at in one go

/// N of paper 5.4, by component.
std::vector<int> automatic(const Corefined& corefined, const InputFaces& inputs) {
  const std::size_t n = n_components(corefined);
  std::vector<double> sum(n, 0), count(n, 0);
  for (std::uint32_t i = 0; i < inputs.size(); ++i)
    if (inputs.touched(i)) sum[inputs.component(i)] += inputs.mean_edge_length(i), count[inputs.component(i)] += 1;
  std::vector<int> result(n, kLeastAutomatic);
  for (const auto& [a, b] : corefined.met) {
    if (count[a] == 0 || count[b] == 0) continue;
    const double la = sum[a] / count[a], lb = sum[b] / count[b];  // l1a and l2a
    const std::uint32_t finer = la <= lb ? a : b;
    result[finer] = std::max(result[finer], static_cast<int>(std::lround(std::max(la, lb) / std::min(la, lb))));
  }
  return result;
}

/// Neighbourhoods in which the size can change from l_a to the own size around a touched face.
int transition(const InputFaces& inputs, std::uint32_t i, const SizeField& size) {
  double sum = 0;
  int count = 0;
  inputs.each_neighbour(i, [&](std::uint32_t j) {
    if (!inputs.has_lost(j)) sum += inputs.mean_edge_length(j), ++count;
  });
  const double own = sum / count, junction = size.junction(inputs.centre(i)).size;
  if (count == 0 || !std::isfinite(junction)) return 1;
  return static_cast<int>(std::ceil(std::abs(junction - own) / size.gradation() / (kRow * own))) + 1;
}

/// Neighbourhoods of long faces reach farther than others.
bool is_far(const InputFaces& inputs, std::uint32_t i, const SizeField& size, double reach) {
  if (inputs.touched(i)) return false;
  const NearJunction junction = size.junction(inputs.centre(i));
  return std::isfinite(junction.distance) &&
         junction.distance > reach * std::max(inputs.mean_edge_length(i), junction.size);
}

/// Calls f(i) for each input face, at the same time.
template <class F>
void for_each(const InputFaces& inputs, F&& f) {
  for_blocks(
      inputs.size(),
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) f(static_cast<std::uint32_t>(i));
      },
      kInputBlock);
}

/// Spreads the neighbourhoods still to take from each input face to its neighbours, most first.
void spread(std::vector<int>& left, const InputFaces& inputs) {
  const int most = left.empty() ? 0 : *std::ranges::max_element(left);
  std::vector<std::vector<std::uint32_t>> by_left(static_cast<std::size_t>(most) + 1);
  for (std::uint32_t i = 0; i < left.size(); ++i) by_left[static_cast<std::size_t>(left[i])].push_back(i);
  for (int k = most; k > 1; --k)
    for (const std::uint32_t i : by_left[static_cast<std::size_t>(k)]) {
      if (left[i] != k) continue;
      inputs.each_neighbour(i, [&](std::uint32_t j) {
        if (left[j] < k - 1) left[j] = k - 1, by_left[static_cast<std::size_t>(k - 1)].push_back(j);
      });
    }
}

/// Nearest face of the zone, by component.
class ZoneFaces {
 public:
  ZoneFaces(const Corefined& corefined, const std::vector<std::uint8_t>& in_zone) : complex_(corefined.complex) {
    std::vector<std::vector<Box>> boxes(n_components(corefined));
    faces_.resize(boxes.size());
    for (std::size_t f = 0; f < complex_.n_faces(); ++f) {
      if (!in_zone[f]) continue;
      faces_[complex_.component[f]].emplace_back(f);
      Box& box = boxes[complex_.component[f]].emplace_back();
      for (const Vec3 p : complex_.corners(FaceId(f))) box.add(p);
    }
    for (const auto& b : boxes) trees_.emplace_back(b);
  }

  struct Nearest {
    FaceId face;
    double distance = 0;
  };
  [[nodiscard]] std::vector<Nearest> by_component(Vec3 p) const {
    std::vector<Nearest> result;
    for (std::size_t c = 0; c < trees_.size(); ++c) {
      const auto found = trees_[c].nearest(p, [&](std::uint32_t k) {
        return squared_norm(p - closest_on_triangle(p, complex_.corners(faces_[c][k])).point);
      });
      if (found.found()) result.push_back({faces_[c][found.item], std::sqrt(found.squared_distance)});
    }
    return result;
  }

 private:
  const Complex& complex_;
  std::vector<std::vector<FaceId>> faces_;  // by component
  std::vector<BoxTree> trees_;
};

/// Input faces of the first neighbourhood around `start` that has one that may be added.
std::vector<std::uint32_t> addable_around(std::uint32_t start, const InputFaces& inputs, const SizeField& size,
                                          const std::vector<int>& ring, const std::vector<std::uint8_t>& taken,
                                          int limit) {
  std::vector<std::uint8_t> seen(inputs.size(), 0);
  std::vector<std::uint32_t> front{start}, next, result;
  seen[start] = 1;
  for (int k = 0; k < limit && result.empty() && !front.empty(); ++k) {
    for (const std::uint32_t i : front)
      inputs.each_neighbour_of_layers(i, [&](std::uint32_t j) {
        if (std::exchange(seen[j], 1)) return;
        if (taken[j])
          next.push_back(j);
        else if (ring[j] > 0 && !inputs.frozen(j) && !inputs.kept(j) && !is_far(inputs, j, size, limit - 0.5))
          result.push_back(j);
      });
    front = std::exchange(next, {});
  }
  return result;
}

}  // namespace

std::size_t n_components(const Corefined& corefined) {
  std::size_t n = 0;
  for (const std::uint32_t c : corefined.complex.component) n = std::max(n, std::size_t{c} + 1);
  for (const auto& [a, b] : corefined.met) n = std::max(n, std::size_t{std::max(a, b)} + 1);
  return n;
}

Zone neighbourhoods(const Corefined& corefined, const InputFaces& inputs, const SizeField& size,
                    std::optional<int> bandwidth, int more) {
  std::vector<int> least;
  if (!bandwidth) least = automatic(corefined, inputs);
  Zone zone;
  zone.bandwidth.assign(n_components(corefined), 0);
  std::vector<int> left(inputs.size(), 0);  // by input face: neighbourhoods to take, itself counted
  for_each(inputs, [&](std::uint32_t i) {
    if (!inputs.touched(i) && !inputs.is_spoiled(i)) return;
    if (bandwidth)
      left[i] = *bandwidth;
    else if (const int room = transition(inputs, i, size);
             !inputs.is_whole(i) || inputs.is_spoiled(i) || room > kSettled)
      left[i] = std::max(least[inputs.component(i)], room) + more;
  });
  for (std::uint32_t i = 0; i < inputs.size(); ++i) {
    int& widest = zone.bandwidth[inputs.component(i)];
    widest = std::max(widest, left[i]);
  }
  spread(left, inputs);
  if (!bandwidth)
    for_each(inputs, [&](std::uint32_t i) {
      const int needed = zone.bandwidth[inputs.component(i)] - more;
      if (left[i] > 0 && is_far(inputs, i, size, std::max<double>(kReach, needed))) left[i] = 0;
    });
  zone.in_zone.assign(corefined.complex.n_faces(), 0);
  for (std::size_t f = 0; f < zone.in_zone.size(); ++f) {
    const std::uint32_t i = inputs.of(FaceId(f));
    zone.in_zone[f] = left[i] > 0 && !inputs.frozen(i) && !inputs.kept(i) ? 1 : 0;
  }
  return zone;
}

bool widen(Zone& zone, const Corefined& corefined, const InputFaces& inputs, const SizeField& size,
           std::span<const Vec3> places, int limit) {
  const std::vector<int> ring = inputs.rings(limit);
  const ZoneFaces zone_faces(corefined, zone.in_zone);
  std::vector<std::uint8_t> taken(inputs.size(), 0);
  for (std::size_t f = 0; f < zone.in_zone.size(); ++f)
    if (zone.in_zone[f]) taken[inputs.of(FaceId(f))] = 1;

  std::vector<std::uint32_t> more;
  for (const Vec3 p : places) {
    const auto nearest = zone_faces.by_component(p);
    double least = std::numeric_limits<double>::infinity();
    for (const auto& near : nearest) least = std::min(least, near.distance);
    for (const auto& near : nearest) {
      // A place on the junction concerns all meshes there.
      const std::uint32_t i = inputs.of(near.face);
      if (near.distance > least + 0.5 * inputs.mean_edge_length(i)) continue;
      const auto around = addable_around(i, inputs, size, ring, taken, limit);
      more.insert(more.end(), around.begin(), around.end());
    }
  }
  for (const std::uint32_t i : more) {
    for (const FaceId f : inputs.pieces(i)) zone.in_zone[f.value] = 1;
    int& bandwidth = zone.bandwidth[inputs.component(i)];
    bandwidth = std::max(bandwidth, ring[i]);
  }
  return !more.empty();
}

}  // namespace meshgraft
