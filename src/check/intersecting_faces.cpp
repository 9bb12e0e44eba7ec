#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "check/face_pairs.hpp"
#include "geometry/box_tree.hpp"

namespace meshgraft {
namespace {

using Corners = std::array<std::uint32_t, 3>;
using Pair = std::array<std::uint32_t, 2>;

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

  std::vector<Box> boxes(faces.size());
  std::vector<std::uint8_t> degenerate(faces.size());
  std::vector<std::uint32_t> queries;
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    if (is_fresh(f)) queries.push_back(f);
  if (queries.empty()) return {};
  tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t f) {
    boxes[f] = box_of(triangle(f));
    degenerate[f] = is_degenerate(faces[f], triangle(f)) ? 1 : 0;
  });
  const BoxTree tree(boxes);

  tbb::enumerable_thread_specific<std::vector<Pair>> found;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, queries.size()), [&](const auto& range) {
    std::vector<Pair>& mine = found.local();
    for (std::size_t q = range.begin(); q != range.end(); ++q) {
      const std::uint32_t i = queries[q];
      if (degenerate[i]) continue;
      const Triangle t = triangle(i);
      tree.overlapping(boxes[i], [&](std::uint32_t j) {
        // A pair of fresh faces is met from both sides; it is taken from the smaller one.
        if (j == i || (j < i && is_fresh(j)) || degenerate[j]) return;
        if (meet_beyond_shared(faces[i], t, faces[j], triangle(j))) mine.push_back({std::min(i, j), std::max(i, j)});
      });
    }
  });
  std::vector<Pair> result;
  for (const auto& mine : found) result.insert(result.end(), mine.begin(), mine.end());
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
