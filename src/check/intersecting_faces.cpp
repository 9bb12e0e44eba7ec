#include <algorithm>
#include <optional>

#include "check/face_pairs.hpp"
#include "core/blocks.hpp"
#include "geometry/box_tree.hpp"

namespace meshgraft {
namespace {

using Corners = std::array<std::uint32_t, 3>;
using Pair = std::array<std::uint32_t, 2>;

constexpr std::size_t kFaceBlock = 1024;  // faces compared with the tree in one go

Box box_of(const Triangle& t) {
  Box box;
  for (const Vec3 p : t) box.add(p);
  return box;
}

}  // namespace

std::vector<Pair> intersecting_pairs(std::span<const Vec3> position, std::span<const Corners> faces,
                                     std::span<const std::uint8_t> fresh) {
  const auto triangle = [&](std::size_t f) {
    const Corners& v = faces[f];
    return Triangle{position[v[0]], position[v[1]], position[v[2]]};
  };
  const auto is_fresh = [&](std::size_t f) { return fresh.empty() || fresh[f] != 0; };
  const auto box = [&](std::size_t f) { return box_of(triangle(f)); };

  // Only fresh faces are in the tree: one of each pair is.
  const auto in_tree = collected<std::uint32_t>(faces.size(), [&](std::size_t f, std::vector<std::uint32_t>& out) {
    if (is_fresh(f) && !is_degenerate(faces[f], triangle(f))) out.push_back(static_cast<std::uint32_t>(f));
  });
  std::vector<Box> boxes(in_tree.size());
  for_blocks(boxes.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) boxes[k] = box(in_tree[k]);
  });
  const BoxTree tree(boxes);
  std::vector<Pair> result = collected_near<Pair>(
      faces.size(), box, [&](std::size_t, std::size_t, const Box& run) { return tree.meets(run); },
      [&](std::size_t i, std::vector<Pair>& out) {
        const auto f = static_cast<std::uint32_t>(i);
        const Triangle t = triangle(f);
        std::optional<bool> has_area;  // asked for if there is anything near
        tree.overlapping(box_of(t), [&](std::uint32_t k) {
          const std::uint32_t g = in_tree[k];
          // A pair of fresh faces is met from both sides; it is taken from the smaller one.
          if (g == f || (g < f && is_fresh(f))) return;
          if (!has_area) has_area = !is_degenerate(faces[f], t);
          if (*has_area && meet_beyond_shared(faces[f], t, faces[g], triangle(g)))
            out.push_back({std::min(f, g), std::max(f, g)});
        });
      },
      kFaceBlock);
  std::ranges::sort(result);
  return result;
}

std::vector<std::array<FaceId, 2>> intersecting_faces(const Complex& complex, std::span<const std::uint8_t> fresh) {
  std::vector<Corners> faces;
  faces.reserve(complex.n_faces());
  for (const auto& v : complex.face) faces.push_back({v[0].value, v[1].value, v[2].value});
  std::vector<std::array<FaceId, 2>> result;
  for (const auto& [i, j] : intersecting_pairs(complex.position, faces, fresh))
    result.push_back({FaceId(std::size_t{i}), FaceId(std::size_t{j})});
  return result;
}

}  // namespace meshgraft
