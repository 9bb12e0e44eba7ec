#include "intersect/component_pairs.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "core/blocks.hpp"
#include "core/distinct.hpp"
#include "geometry/box_tree.hpp"

namespace meshgraft {
namespace {

constexpr double kReach = 3;              // snap lengths: two that count as near, and one by which a vertex may move
constexpr std::size_t kFaceBlock = 1024;  // faces compared with the tree in one go

std::size_t n_components(const Complex& complex) {
  const auto last = std::max_element(complex.component.begin(), complex.component.end());
  return last == complex.component.end() ? 0 : *last + std::size_t{1};
}

std::uint32_t largest_component(const Complex& complex) {
  std::vector<std::size_t> count(n_components(complex));
  for (const std::uint32_t c : complex.component) ++count[c];
  return static_cast<std::uint32_t>(std::max_element(count.begin(), count.end()) - count.begin());
}

}  // namespace

std::vector<std::uint32_t> ranks_by_id(const Complex& complex) {
  std::vector<std::uint32_t> rank(n_components(complex));
  std::iota(rank.begin(), rank.end(), 0u);
  return rank;
}

std::vector<NearFaces> near_faces(const Complex& complex, std::span<const double> size, const SnapRule& rule,
                                  std::span<const std::uint32_t> rank) {
  std::vector<NearFaces> near(n_components(complex));
  if (near.size() < 2) return near;
  std::vector<Box> boxes(complex.n_faces()), in_tree;
  std::vector<FaceId> tree_face;
  const std::uint32_t largest = largest_component(complex);  // not in the tree: it meets nothing of itself
  for_blocks(boxes.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) {
      for (const Vec3 p : complex.corners(FaceId(f))) boxes[f].add(p);
      boxes[f] = boxes[f].grown(kReach * rule.at(size[f]).asked);
    }
  });
  for (std::size_t f = 0; f < boxes.size(); ++f)
    if (complex.component[f] != largest) in_tree.push_back(boxes[f]), tree_face.emplace_back(f);
  const BoxTree tree(in_tree);
  const auto pairs = collected_near<std::array<FaceId, 2>>(
      boxes.size(), [&](std::size_t f) { return boxes[f]; },
      [&](std::size_t, std::size_t, const Box& run) { return tree.meets(run); },
      [&](std::size_t f, auto& out) {
        const std::uint32_t c = complex.component[f];
        tree.overlapping(boxes[f], [&](std::uint32_t i) {
          const std::uint32_t d = complex.component[tree_face[i].value];
          if (c != d && complex.joins.are_joined(c, d)) out.push_back({FaceId(f), tree_face[i]});
        });
      },
      kFaceBlock);
  for (const auto& [f, g] : pairs) {
    const bool first_is_later = rank[complex.component[f.value]] > rank[complex.component[g.value]];
    const auto [own, earlier] = first_is_later ? std::pair{f, g} : std::pair{g, f};
    NearFaces& of_later = near[complex.component[own.value]];
    of_later.own.push_back(own), of_later.earlier.push_back(earlier);
  }
  for (NearFaces& n : near) make_distinct(n.earlier), make_distinct(n.own);
  return near;
}

}  // namespace meshgraft
